#include "drivers/glfw/glfw_context.h"

#include "drivers/glfw/glfw_input.h"

#include <GLFW/glfw3.h>
#include <fmt/core.h>

#include <string>
#include <utility>

namespace cl::glfw {

namespace {

/// GLFW's state is global: it is initialised while there is a window.
bool window_exists = false;

/// Takes GLFW's last error.
Error glfw_error(std::string_view what) {
    const char* description = nullptr;
    const int code = glfwGetError(&description);
    return {ErrorCode::Unsupported, fmt::format("window: {} ({}, error 0x{:05x})", what,
                                                description ? description : "no reason given", code)};
}

class GlfwContext final : public drivers::GLContext, public drivers::Window {
public:
    explicit GlfwContext(GLFWwindow* window) : window_(window) { input_.attach(window); }
    GlfwContext(const GlfwContext&) = delete;
    GlfwContext& operator=(const GlfwContext&) = delete;
    ~GlfwContext() override {
        glfwDestroyWindow(window_);
        glfwTerminate();
        window_exists = false;
    }

    [[nodiscard]] drivers::DriverKind kind() const noexcept override { return drivers::DriverKind::Window; }
    [[nodiscard]] glm::ivec2 size() const override {
        glm::ivec2 pixels(0);
        glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
        return pixels;
    }
    void swap() override { glfwSwapBuffers(window_); }
    [[nodiscard]] drivers::Window* window() noexcept override { return this; }

    const drivers::InputState& poll(double longest_wait_s) override {
        return input_.poll(window_, longest_wait_s);
    }
    void set_mouse_mode(drivers::MouseMode mode) override {
        const bool captured = mode == drivers::MouseMode::Captured;
        glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
        input_.restart_motion();
    }
    void set_title(std::string_view title) override {
        glfwSetWindowTitle(window_, std::string(title).c_str());
    }

protected:
    Status make_current_raw() override {
        glfwMakeContextCurrent(window_);
        if (glfwGetCurrentContext() != window_) {
            return glfw_error("the context could not be made current");
        }
        return {};
    }
    void release_current_raw() override { glfwMakeContextCurrent(nullptr); }
    Proc proc_address(const char* name) const override { return glfwGetProcAddress(name); }

private:
    GLFWwindow* window_;
    InputGatherer input_;
};

GLFWwindow* open_window(const drivers::WindowDesc& desc) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    // Scenes have their own depth; the window only receives the tone-mapped picture, already sRGB-encoded.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    return glfwCreateWindow(desc.size.x, desc.size.y, desc.title.c_str(), nullptr, nullptr);
}

} // namespace

Expected<std::unique_ptr<drivers::GLContext>> create_context(const drivers::WindowDesc& desc) {
    if (window_exists) {
        return Error{ErrorCode::Unsupported, "window: there is a window already"};
    }
    if (desc.size.x < 1 || desc.size.y < 1) {
        return Error{
            ErrorCode::InvalidArgument,
            fmt::format("window: expected a size of at least 1x1, found {}x{}", desc.size.x, desc.size.y)};
    }
    if (!glfwInit()) {
        return glfw_error("no display");
    }
    GLFWwindow* window = open_window(desc);
    if (!window) {
        Error error = glfw_error("no OpenGL ES 3 window");
        glfwTerminate();
        return error;
    }
    window_exists = true;
    auto context = std::make_unique<GlfwContext>(window);
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    return std::unique_ptr<drivers::GLContext>(std::move(context));
}

} // namespace cl::glfw
