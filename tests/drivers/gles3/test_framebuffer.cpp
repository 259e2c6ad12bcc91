#include "tests/drivers/gl_test.h"

#include "drivers/gles3/gl/framebuffer.h"
#include "drivers/gles3/gl/pass.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

namespace {

gl::Texture2D make_color(glm::ivec2 size, gl::Format format = gl::Format::RGBA8) {
    Expected<gl::Texture2D> texture = gl::Texture2D::create({.size = size, .format = format});
    REQUIRE(texture);
    return *std::move(texture);
}

void clear(const gl::Framebuffer& target, glm::vec4 color, std::optional<gl::Rect> viewport = {}) {
    gl::PassDesc desc{.label = "clear", .target = &target, .viewport = viewport};
    desc.colors.fill(gl::Load::Clear);
    desc.clear_colors.fill(color);
    const gl::Pass pass(desc);
}

uint8_t red_at(const gl::Framebuffer& target, glm::ivec2 pixel) {
    return target.read_rgba8({pixel, {1, 1}})[0];
}

} // namespace

TEST_SUITE("drivers/gles3/gl/framebuffer") {
    TEST_CASE("[gl] four attachments of mixed formats are cleared and read each on its own") {
        on_each_gl([](GLTest&) {
            const gl::Texture2D a = make_color({3, 2}), b = make_color({3, 2}, gl::Format::RGBA16F),
                                c = make_color({3, 2}, gl::Format::RGBA32F),
                                d = make_color({3, 2}, gl::Format::RG8);
            const Expected<gl::Framebuffer> target =
                gl::Framebuffer::create({.colors = {{{&a}, {&b}, {&c}, {&d}}}});
            REQUIRE(target);
            CHECK(target->color_count() == 4);
            CHECK(target->size() == glm::ivec2(3, 2));
            gl::PassDesc desc{.label = "clear", .target = &*target};
            desc.colors.fill(gl::Load::Clear);
            desc.clear_colors = {glm::vec4(1), glm::vec4(2.5f), glm::vec4(-1e6f), glm::vec4(0.2f)};
            { const gl::Pass pass(desc); }
            CHECK(target->read_rgba8({{2, 1}, {1, 1}}, 0)[0] == 255);
            CHECK(target->read_rgba32f({{2, 1}, {1, 1}}, 1)[0] == 2.5f);
            CHECK(target->read_rgba32f({{2, 1}, {1, 1}}, 2)[3] == -1e6f);
            CHECK(target->read_rgba8({{2, 1}, {1, 1}}, 3)[1] == 51);
        });
    }

    TEST_CASE("[gl] one slice and mip of a volume is drawn to, and no other") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture3D> volume = gl::Texture3D::create({.size = {4, 4, 4}, .mips = 3});
            REQUIRE(volume);
            std::vector<gl::Framebuffer> slices;
            for (int mip = 0; mip < 3; ++mip) {
                for (int z = 0; z < volume->size(mip).z; ++z) {
                    Expected<gl::Framebuffer> f = gl::Framebuffer::create({.colors = {{{&*volume, mip, z}}}});
                    REQUIRE(f);
                    CHECK(f->size() == glm::ivec2(volume->size(mip)));
                    clear(*f, glm::vec4(0.0f));
                    slices.push_back(*std::move(f));
                }
            }
            clear(slices[5], glm::vec4(1.0f)); // mip 1, z 1
            for (size_t i = 0; i < slices.size(); ++i) {
                CAPTURE(i);
                CHECK(red_at(slices[i], {0, 0}) == (i == 5 ? 255 : 0));
            }
        });
    }

    TEST_CASE("[gl] one face of a cube map is drawn to, and no other") {
        on_each_gl([](GLTest&) {
            Expected<gl::TextureCube> cube = gl::TextureCube::create({.size = 2});
            REQUIRE(cube);
            std::vector<gl::Framebuffer> faces;
            for (int face = 0; face < 6; ++face) {
                Expected<gl::Framebuffer> f = gl::Framebuffer::create({.colors = {{{&*cube, 0, face}}}});
                REQUIRE(f);
                clear(*f, glm::vec4(0.0f));
                faces.push_back(*std::move(f));
            }
            clear(faces[3], glm::vec4(1.0f));
            for (size_t i = 0; i < 6; ++i) {
                CHECK(red_at(faces[i], {1, 1}) == (i == 3 ? 255 : 0));
            }
        });
    }

    TEST_CASE("[gl] a framebuffer of depth alone takes its size from it") {
        on_each_gl([](GLTest&) {
            for (const gl::Format format : {gl::Format::Depth16, gl::Format::Depth24, gl::Format::Depth32F,
                                            gl::Format::Depth24Stencil8}) {
                const gl::Texture2D depth = make_color({5, 7}, format);
                const Expected<gl::Framebuffer> target = gl::Framebuffer::create({.depth = {&depth}});
                REQUIRE(target);
                CHECK(target->size() == glm::ivec2(5, 7));
                CHECK(target->color_count() == 0);
                CHECK(target->has_depth());
            }
        });
    }

    TEST_CASE("[gl] what cannot be drawn to is refused and named") {
        on_each_gl([](GLTest& gl_test) {
            const gl::Texture2D depth = make_color({4, 4}, gl::Format::Depth24);
            std::optional<Expected<gl::Framebuffer>> wrong;
            gl_test.provoke(
                [&] { wrong = gl::Framebuffer::create({.colors = {{{&depth}}}, .label = "wrong"}); });
            REQUIRE_FALSE(*wrong);
            CHECK(wrong->error().code == ErrorCode::Unsupported);
            CHECK(wrong->error().message.starts_with(
                "framebuffer wrong: the driver cannot draw to Depth24 (status 0x"));
            const gl::Texture2D color = make_color({4, 4});
            CHECK(gl::Framebuffer::create({.colors = {{{&color, 1}}}}).error().message ==
                  "expected a mip below 1 and a layer of that mip, found mip 1, layer 0");
            CHECK(gl::Framebuffer::create({.colors = {{{&color, 0, 1}}}}).error().code ==
                  ErrorCode::InvalidArgument);
        });
    }
}

TEST_SUITE("drivers/gles3/gl/pass") {
    TEST_CASE("[gl] clearing a viewport leaves the rest of the target") {
        on_each_gl([](GLTest&) {
            const gl::Texture2D color = make_color({8, 8});
            const Expected<gl::Framebuffer> target = gl::Framebuffer::create({.colors = {{{&color}}}});
            REQUIRE(target);
            clear(*target, glm::vec4(0.0f));
            clear(*target, glm::vec4(1.0f), gl::Rect{{2, 4}, {3, 2}});
            const std::vector<uint8_t> pixels = target->read_rgba8({{0, 0}, {8, 8}});
            for (int y = 0; y < 8; ++y) {
                for (int x = 0; x < 8; ++x) {
                    const bool inside = x >= 2 && x < 5 && y >= 4 && y < 6;
                    CHECK(pixels[static_cast<size_t>((y * 8 + x) * 4)] == (inside ? 255 : 0));
                }
            }
            clear(*target, glm::vec4(1.0f)); // the next pass is whole again
            CHECK(red_at(*target, {7, 0}) == 255);
        });
    }

    TEST_CASE("[gl] what a pass keeps stays, what it clears goes") {
        on_each_gl([](GLTest&) {
            const gl::Texture2D a = make_color({2, 2}), b = make_color({2, 2});
            const Expected<gl::Framebuffer> target = gl::Framebuffer::create({.colors = {{{&a}, {&b}}}});
            REQUIRE(target);
            clear(*target, glm::vec4(1.0f));
            gl::PassDesc desc{.label = "half", .target = &*target};
            desc.colors[1] = gl::Load::Clear;
            { const gl::Pass pass(desc); }
            CHECK(target->read_rgba8({{0, 0}, {1, 1}}, 0)[0] == 255);
            CHECK(target->read_rgba8({{0, 0}, {1, 1}}, 1)[0] == 0);
        });
    }

    TEST_CASE("[gl] write masks of one pass's draws do not reach the next pass's clears") {
        on_each_gl([](GLTest& gl_test) {
            const gl::Texture2D color = make_color({2, 2});
            const Expected<gl::Framebuffer> target = gl::Framebuffer::create({.colors = {{{&color}}}});
            REQUIRE(target);
            clear(*target, glm::vec4(0.0f));
            gl_test.state().apply({.write = gl::WriteMask::None});
            clear(*target, glm::vec4(1.0f));
            CHECK(red_at(*target, {1, 1}) == 255);
        });
    }
}
