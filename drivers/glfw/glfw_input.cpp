#include "drivers/glfw/glfw_input.h"

#include <array>
#include <utility>

namespace cl::glfw {

using drivers::Key;

std::optional<Key> key_from_glfw(int glfw_key) noexcept {
    static constexpr std::array kKeys{
        std::pair{GLFW_KEY_W, Key::W},
        std::pair{GLFW_KEY_A, Key::A},
        std::pair{GLFW_KEY_S, Key::S},
        std::pair{GLFW_KEY_D, Key::D},
        std::pair{GLFW_KEY_Q, Key::Q},
        std::pair{GLFW_KEY_E, Key::E},
        std::pair{GLFW_KEY_UP, Key::Up},
        std::pair{GLFW_KEY_DOWN, Key::Down},
        std::pair{GLFW_KEY_LEFT, Key::Left},
        std::pair{GLFW_KEY_RIGHT, Key::Right},
        std::pair{GLFW_KEY_SPACE, Key::Space},
        std::pair{GLFW_KEY_LEFT_SHIFT, Key::Shift},
        std::pair{GLFW_KEY_RIGHT_SHIFT, Key::Shift},
        std::pair{GLFW_KEY_LEFT_CONTROL, Key::Control},
        std::pair{GLFW_KEY_RIGHT_CONTROL, Key::Control},
        std::pair{GLFW_KEY_ESCAPE, Key::Escape},
        std::pair{GLFW_KEY_TAB, Key::Tab},
        std::pair{GLFW_KEY_R, Key::R},
        std::pair{GLFW_KEY_F, Key::F},
        std::pair{GLFW_KEY_P, Key::P},
    };
    for (const auto& [code, key] : kKeys) {
        if (code == glfw_key) {
            return key;
        }
    }
    return std::nullopt;
}

InputGatherer& InputGatherer::of(GLFWwindow* window) {
    return *static_cast<InputGatherer*>(glfwGetWindowUserPointer(window));
}

void InputGatherer::attach(GLFWwindow* window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window,
                       [](GLFWwindow* w, int key, int, int action, int) { of(w).on_key(key, action); });
    glfwSetCursorPosCallback(window,
                             [](GLFWwindow* w, double x, double y) { of(w).on_cursor(glm::vec2(x, y)); });
    glfwSetScrollCallback(
        window, [](GLFWwindow* w, double, double y) { of(w).state_.scroll += static_cast<float>(y); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).state_.resized = true; });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).state_.uncovered = true; });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
        // GLFW counts left, right, middle, as MouseButton does.
        if (button >= 0 && button < 3) {
            of(w).state_.buttons[static_cast<size_t>(button)] = action == GLFW_PRESS;
        }
    });
}

void InputGatherer::on_key(int key, int action) {
    const std::optional<Key> known = key_from_glfw(key);
    if (!known || action == GLFW_REPEAT) {
        return;
    }
    const auto bit = static_cast<size_t>(*known);
    state_.down[bit] = action == GLFW_PRESS;
    if (action == GLFW_PRESS) {
        state_.pressed[bit] = true;
    }
}

void InputGatherer::on_cursor(glm::vec2 position_px) {
    if (last_cursor_) {
        state_.mouse_motion_px += position_px - *last_cursor_;
    }
    last_cursor_ = position_px;
}

const drivers::InputState& InputGatherer::poll(GLFWwindow* window, double longest_wait_s) {
    state_.pressed.reset();
    state_.mouse_motion_px = glm::vec2(0.0f);
    state_.scroll = 0.0f;
    state_.resized = false;
    state_.uncovered = false;
    if (longest_wait_s > 0.0) {
        glfwWaitEventsTimeout(longest_wait_s);
    } else {
        glfwPollEvents();
    }
    state_.close_requested = glfwWindowShouldClose(window) == GLFW_TRUE;
    return state_;
}

} // namespace cl::glfw
