#include "tests/drivers/gl_test.h"

#include "drivers/gles3/gl/buffer.h"
#include "drivers/gles3/gl/state.h"

#include <doctest/doctest.h>

#include <array>
#include <utility>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

TEST_SUITE("drivers/gles3/gl/buffer") {
    TEST_CASE("[gl] bytes beyond a buffer's end are refused, up to the end they are not") {
        on_each_gl([](GLTest&) {
            Expected<gl::Buffer> buffer = gl::Buffer::create({}, size_t{8});
            REQUIRE(buffer);
            const std::array<std::byte, 4> four{};
            CHECK(buffer->update(4, four));
            CHECK(buffer->update(5, four).error().message ==
                  "expected bytes within a buffer of 8, found 4 at 5");
            CHECK(buffer->update(static_cast<size_t>(-2), four).error().code == ErrorCode::InvalidArgument);
            const std::array<std::byte, 16> more{};
            buffer->replace(more);
            CHECK(buffer->size() == 16);
            CHECK(buffer->update(12, four));
        });
    }

    TEST_CASE("[gl] a moved buffer is deleted once, by its last owner") {
        on_each_gl([](GLTest& gl_test) {
            {
                Expected<gl::Buffer> made = gl::Buffer::create({}, size_t{4});
                REQUIRE(made);
                gl::Buffer a = *std::move(made);
                gl::Buffer b = std::move(a);
                CHECK(gl_test.state().live(gl::ObjectKind::Buffer) == 1);
            }
            CHECK(gl_test.state().live(gl::ObjectKind::Buffer) == 0);
        });
    }
}

TEST_SUITE("drivers/gles3/gl/state") {
    TEST_CASE("[gl] a new State does not trust what was there before it") {
        on_each_gl([](GLTest& gl_test) {
            glActiveTexture(GL_TEXTURE7);
            glEnable(GL_SCISSOR_TEST);
            {
                const gl::State fresh;
                CHECK_FALSE(glIsEnabled(GL_SCISSOR_TEST));
                GLint unit = 0;
                glGetIntegerv(GL_ACTIVE_TEXTURE, &unit);
                CHECK(unit == GL_TEXTURE0);
            }
            gl_test.state().make_current();
        });
    }

    TEST_CASE("[gl] the mirror agrees with GL after objects in use were deleted") {
        on_each_gl([](GLTest& gl_test) {
            gl::State& state = gl_test.state();
            const auto bound = [](GLenum name) {
                GLint value = 0;
                glGetIntegerv(name, &value);
                return static_cast<GLuint>(value);
            };
            const GLuint framebuffer = state.create(gl::ObjectKind::Framebuffer);
            state.bind_draw_framebuffer(framebuffer);
            CHECK(bound(GL_DRAW_FRAMEBUFFER_BINDING) == framebuffer);
            state.destroy(gl::ObjectKind::Framebuffer, framebuffer);
            CHECK(bound(GL_DRAW_FRAMEBUFFER_BINDING) == 0);
            const GLuint again = state.create(gl::ObjectKind::Framebuffer);
            state.bind_draw_framebuffer(again);
            CHECK(bound(GL_DRAW_FRAMEBUFFER_BINDING) == again);
            state.destroy(gl::ObjectKind::Framebuffer, again);

            const GLuint texture = state.create(gl::ObjectKind::Texture);
            state.bind_texture(3, GL_TEXTURE_3D, texture);
            glActiveTexture(GL_TEXTURE3); // the unit the State has just made active
            CHECK(bound(GL_TEXTURE_BINDING_3D) == texture);
            state.destroy(gl::ObjectKind::Texture, texture);
            CHECK(bound(GL_TEXTURE_BINDING_3D) == 0);
            const GLuint other = state.create(gl::ObjectKind::Texture);
            state.bind_texture(3, GL_TEXTURE_3D, other);
            CHECK(bound(GL_TEXTURE_BINDING_3D) == other);
            state.destroy(gl::ObjectKind::Texture, other);

            const GLuint array = state.create(gl::ObjectKind::VertexArray);
            state.bind_vertex_array(array);
            state.destroy(gl::ObjectKind::VertexArray, array);
            state.bind_vertex_array(0);
            CHECK(bound(GL_VERTEX_ARRAY_BINDING) != 0); // desktop core needs one: the State's own
        });
    }
}
