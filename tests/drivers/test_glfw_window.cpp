#include "drivers/gl_api.h"
#include "drivers/gl_context.h"
#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/gl/state.h"
#include "drivers/glfw/glfw_input.h"

#include <doctest/doctest.h>

#include <memory>
#include <optional>

using namespace cl;
using namespace cl::drivers;

namespace {

/// A small window, or nothing (and said so) where there is no display.
std::unique_ptr<GLContext> open_window() {
    Expected<std::unique_ptr<GLContext>> context = create_context(DriverKind::Window, {{160, 120}, "test"});
    if (!context) {
        MESSAGE("skipped: " << context.error().message);
        return nullptr;
    }
    return *std::move(context);
}

} // namespace

TEST_SUITE("drivers/glfw") {
    TEST_CASE("both shift keys are one key, and keys we do not use are none") {
        CHECK(glfw::key_from_glfw(GLFW_KEY_LEFT_SHIFT) == Key::Shift);
        CHECK(glfw::key_from_glfw(GLFW_KEY_RIGHT_SHIFT) == Key::Shift);
        CHECK(glfw::key_from_glfw(GLFW_KEY_W) == Key::W);
        CHECK_FALSE(glfw::key_from_glfw(GLFW_KEY_F12).has_value());
        CHECK_FALSE(glfw::key_from_glfw(GLFW_KEY_UNKNOWN).has_value());
    }

    TEST_CASE("[gl] a window has the size asked for, input without events and no errors") {
        const std::unique_ptr<GLContext> context = open_window();
        if (!context) {
            return;
        }
        REQUIRE(context->window() != nullptr);
        CHECK(context->size() == glm::ivec2(160, 120));
        const InputState& input = context->window()->poll();
        CHECK(input.down.none());
        CHECK_FALSE(input.close_requested);
        CHECK(context->error_count() == 0);
    }

    TEST_CASE("[gl] a second window is refused, and after the first is gone it is not") {
        std::unique_ptr<GLContext> context = open_window();
        if (!context) {
            return;
        }
        const Expected<std::unique_ptr<GLContext>> second = create_context(DriverKind::Window, {});
        REQUIRE_FALSE(second);
        CHECK(second.error().message == "window: there is a window already");
        context.reset();
        CHECK(open_window() != nullptr);
    }

    TEST_CASE("[gl] what a pass draws to the window's framebuffer is read back from it") {
        const std::unique_ptr<GLContext> context = open_window();
        if (!context) {
            return;
        }
        gles3::gl::State state;
        const auto target = gles3::gl::Framebuffer::window(context->size());
        gles3::gl::PassDesc desc{.label = "clear", .target = &target};
        desc.colors[0] = gles3::gl::Load::Clear;
        desc.clear_colors[0] = glm::vec4(1.0f, 0.0f, 0.2f, 1.0f);
        { const gles3::gl::Pass pass(desc); }
        const std::vector<uint8_t> pixel = target.read_rgba8({{80, 60}, {1, 1}});
        CHECK(pixel[0] == 255);
        CHECK(pixel[1] == 0);
        CHECK(pixel[2] == 51);
        context->swap();
        CHECK(context->error_count() == 0);
    }
}
