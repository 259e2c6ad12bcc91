#include "tests/drivers/gl_test.h"

#include "drivers/gl_api.h"
#include "drivers/gl_context.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

using namespace cl;
using namespace cl::drivers;

TEST_SUITE("drivers/gl_context") {
    TEST_CASE("driver names are those of the command line and read back to their driver") {
        for (const DriverKind kind : {DriverKind::Egl, DriverKind::Osmesa, DriverKind::Window}) {
            const Expected<DriverKind> read = driver_from_name(driver_name(kind));
            REQUIRE(read);
            CHECK(*read == kind);
        }
        const Expected<DriverKind> unknown = driver_from_name("vulkan");
        REQUIRE_FALSE(unknown);
        CHECK(unknown.error().message == "expected a driver, egl, osmesa or window, found \"vulkan\"");
    }

    TEST_CASE("[gl] every off-screen context offers the GLES 3.0 entry points and no window") {
        tests::on_each_gl([](tests::GLTest& gl) {
            CHECK(GLAD_GL_ES_VERSION_3_0);
            CHECK_FALSE(gl.context().renderer().empty());
            CHECK_FALSE(gl.context().api_version().empty());
            CHECK(gl.context().window() == nullptr);
            CHECK(gl.context().size() == glm::ivec2(0));
        });
    }

    TEST_CASE("[gl] a wrong call is counted once and a right one not at all") {
        tests::on_each_gl([](tests::GLTest& gl) {
            GLuint buffer = 0;
            CHECK(gl.provoke([&] { glGenBuffers(1, &buffer); }) == 0);
            CHECK(gl.provoke([&] { glBindBuffer(GL_TEXTURE_2D, buffer); }) == 1);
            CHECK(gl.provoke([] {}) == 0);
            glDeleteBuffers(1, &buffer);
            glGetError();
        });
    }

    TEST_CASE("[gl] contexts of two drivers take turns in one process") {
        tests::on_each_gl([](tests::GLTest&) {});
        int drawn = 0;
        tests::on_each_gl([&](tests::GLTest& gl) {
            // Entry points of the other driver would crash or answer with its version.
            const std::string version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
            CHECK(version == gl.context().api_version());
            ++drawn;
        });
        CHECK(drawn <= 2);
    }

    TEST_CASE("[gl] the first context that works is never a window") {
        const Expected<std::unique_ptr<GLContext>> context = create_offscreen_context();
        if (!context) {
            MESSAGE("skipped: " << context.error().message);
            return;
        }
        CHECK((*context)->kind() != DriverKind::Window);
        CHECK((*context)->window() == nullptr);
    }

    TEST_CASE("[gl] fifty contexts come and go") {
        for (const DriverKind kind : {DriverKind::Egl, DriverKind::Osmesa}) {
            for (int i = 0; i < 25; ++i) {
                const Expected<std::unique_ptr<GLContext>> context = create_context(kind);
                if (!context) {
                    MESSAGE("skipped: " << context.error().message);
                    break;
                }
                CHECK((*context)->error_count() == 0);
            }
        }
    }

    TEST_CASE("without a display a window is refused in one line") {
        if (std::getenv("DISPLAY")) {
            MESSAGE("skipped: there is a display");
            return;
        }
        const Expected<std::unique_ptr<GLContext>> context = create_context(DriverKind::Window);
        REQUIRE_FALSE(context);
        CHECK(context.error().code == ErrorCode::Unsupported);
        CHECK(context.error().message.starts_with("window: no display ("));
        CHECK(context.error().message.find('\n') == std::string::npos);
    }
}
