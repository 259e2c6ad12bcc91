#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"

#include "drivers/gles3/gl/workarounds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

namespace {

/// A program that puts vertices where an array of positions says and draws white.
Expected<gl::Program> white_program() {
    static constexpr std::string_view kFiles[] = {"white"};
    static constexpr gl::ShaderSource kSource{
        .name = "white",
        .vertex = "layout(location = 0) in vec2 a_position;\n"
                  "void main() { gl_Position = vec4(a_position, 0.0, 1.0); gl_PointSize = 4.0; }\n",
        .fragment = "layout(location = 0) out vec4 c;\nvoid main() { c = vec4(1.0); }\n",
        .files = kFiles};
    return gl::Program::create(kSource);
}

constexpr gl::AttributeDesc kPositions[] = {{gl::Attribute::Position, 2, GL_FLOAT, false, 0}};

/// How many of 16x16 pixels a draw covers.
int covered_pixels(std::span<const glm::vec2> positions, std::span<const uint16_t> indices,
                   PrimitiveType primitive) {
    Expected<gl::Texture2D> color = gl::Texture2D::create({.size = {16, 16}});
    REQUIRE(color);
    Expected<gl::Framebuffer> target = gl::Framebuffer::create({.colors = {{{&*color}}}});
    REQUIRE(target);
    Expected<gl::Program> program = white_program();
    REQUIRE(program);
    Expected<gl::Buffer> vertices = gl::Buffer::create({}, std::as_bytes(positions));
    Expected<gl::Buffer> elements =
        gl::Buffer::create({.kind = gl::BufferKind::Index}, std::as_bytes(indices));
    REQUIRE(vertices);
    REQUIRE(elements);
    const gl::VertexArray array = gl::VertexArray::create({.vertices = &*vertices,
                                                           .attributes = kPositions,
                                                           .stride = sizeof(glm::vec2),
                                                           .indices = &*elements,
                                                           .index_type = gl::IndexType::U16});
    {
        gl::PassDesc desc{.label = "cover", .target = &*target};
        desc.colors[0] = gl::Load::Clear;
        gl::Pass pass(desc);
        pass.draw(*program, array, gl::kFullscreenState, {primitive, 0, static_cast<int>(indices.size()), 1});
    }
    const std::vector<uint8_t> pixels = target->read_rgba8({{0, 0}, {16, 16}});
    int covered = 0;
    for (size_t i = 0; i < pixels.size(); i += 4) {
        covered += pixels[i] == 255;
    }
    return covered;
}

} // namespace

TEST_SUITE("drivers/gles3/gl/workarounds") {
    TEST_CASE("every workaround has its own name and a reason") {
        std::set<std::string_view> names;
        for (const gl::Workaround& w : gl::workarounds()) {
            CHECK(names.insert(w.name).second);
            CHECK_FALSE(w.reason.empty());
        }
    }

    TEST_CASE("[gl] seamless cube maps: on an edge both faces have half a share") {
        on_each_gl([](GLTest&) {
            Expected<gl::TextureCube> cube = gl::TextureCube::create({.size = 2});
            REQUIRE(cube);
            for (int face = 0; face < 6; ++face) {
                const auto value = static_cast<std::byte>(face == 0 ? 255 : 0);
                REQUIRE(cube->upload(static_cast<gl::CubeFace>(face), 0, std::vector<std::byte>(16, value)));
            }
            cube->bind(0);
            static constexpr gl::SamplerDecl kCube[] = {{"map", "samplerCube", 0, 1}};
            const auto got = tests::probe_fragments("uniform samplerCube map;\nvec4 probe(int i) { return "
                                                    "textureLod(map, vec3(1.0, 0.0, 1.0), 0.0); }",
                                                    1, kCube);
            CHECK(got[0].r == doctest::Approx(0.5f).epsilon(0.02));
        });
    }

    TEST_CASE("[gl] sRGB targets encode: linear 0.5 is stored as 188") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture2D> color =
                gl::Texture2D::create({.size = {1, 1}, .format = gl::Format::Srgb8Alpha8});
            REQUIRE(color);
            Expected<gl::Framebuffer> target = gl::Framebuffer::create({.colors = {{{&*color}}}});
            REQUIRE(target);
            gl::PassDesc desc{.label = "clear", .target = &*target};
            desc.colors[0] = gl::Load::Clear;
            desc.clear_colors[0] = glm::vec4(0.5f);
            { const gl::Pass pass(desc); }
            const std::vector<uint8_t> pixel = target->read_rgba8({{0, 0}, {1, 1}});
            CHECK(std::abs(pixel[0] - 188) <= 1);
            CHECK(std::abs(pixel[3] - 128) <= 1); // alpha is never encoded
        });
    }

    TEST_CASE("[gl] point size from the shader: a point of 4 covers 16 pixels") {
        on_each_gl([](GLTest&) {
            const std::array positions{glm::vec2(0.0f)};
            const std::array<uint16_t, 1> indices{0};
            CHECK(covered_pixels(positions, indices, PrimitiveType::Points) == 16);
        });
    }

    TEST_CASE("[gl] primitive restart: the highest index begins a new strip") {
        on_each_gl([](GLTest&) {
            // Two squares of 4x4 pixels in opposite corners; joined they would cover what lies between.
            const std::array positions{glm::vec2(-1.0f, -1.0f), glm::vec2(-0.5f, -1.0f),
                                       glm::vec2(-1.0f, -0.5f), glm::vec2(-0.5f, -0.5f),
                                       glm::vec2(0.5f, 0.5f),   glm::vec2(1.0f, 0.5f),
                                       glm::vec2(0.5f, 1.0f),   glm::vec2(1.0f, 1.0f)};
            const std::array<uint16_t, 9> indices{0, 1, 2, 3, 0xFFFF, 4, 5, 6, 7};
            CHECK(covered_pixels(positions, indices, PrimitiveType::TriangleStrip) == 32);
        });
    }
}
