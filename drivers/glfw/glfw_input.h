#pragma once

#include "drivers/window.h"

#include <GLFW/glfw3.h>

#include <optional>

namespace cl::glfw {

/// Our name for a GLFW_KEY_*; left and right modifiers are one. nullopt: not a key that we know.
[[nodiscard]] std::optional<drivers::Key> key_from_glfw(int glfw_key) noexcept;

/// Gathers what GLFW's callbacks report into an InputState.
class InputGatherer {
public:
    /// Installs the callbacks; uses the window's user pointer.
    void attach(GLFWwindow* window);
    /// Handles events and gives what came since the last call; if nothing did, after a wait for it.
    const drivers::InputState& poll(GLFWwindow* window, double longest_wait_s);
    /// The next cursor position starts a new motion: it may lie far from the last one.
    void restart_motion() noexcept { last_cursor_.reset(); }

private:
    static InputGatherer& of(GLFWwindow* window);
    void on_key(int key, int action);
    void on_cursor(glm::vec2 position_px);

    drivers::InputState state_;
    std::optional<glm::vec2> last_cursor_; ///< [screen coordinates]
};

} // namespace cl::glfw
