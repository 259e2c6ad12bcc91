#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"

#include "drivers/gles3/block_stream.h"
#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/shaders.h"

#include <doctest/doctest.h>

#include <array>
#include <set>
#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

namespace {

constexpr std::string_view kFiles[] = {"test.glsl"};
constexpr std::string_view kFullscreen = "void main() { gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - "
                                         "1.0, float(gl_VertexID & 2) * 2.0 - 1.0, 0.0, "
                                         "1.0); }\n";

/// A block as shader_table.py writes one: std140 layout by alignas.
struct alignas(16) LampBlock {
    static constexpr std::string_view kName = "Lamp";
    static constexpr int kBinding = 3;
    alignas(16) glm::vec3 color{};
    alignas(4) float range{};
    alignas(16) std::array<glm::vec4, 2> planes{};
    alignas(8) glm::vec2 size{};
};

/// Draws one pixel and gives its colour.
glm::vec4 draw_pixel(const gl::Program& program) {
    Expected<gl::Texture2D> color = gl::Texture2D::create({.size = {1, 1}, .format = gl::Format::RGBA32F});
    REQUIRE(color);
    const Expected<gl::Framebuffer> target = gl::Framebuffer::create({.colors = {{{&*color}}}});
    REQUIRE(target);
    const gl::VertexArray empty = gl::VertexArray::create_empty();
    {
        gl::Pass pass({.label = "pixel", .target = &*target});
        pass.draw_fullscreen(program, empty);
    }
    const std::vector<float> p = target->read_rgba32f({{0, 0}, {1, 1}});
    return {p[0], p[1], p[2], p[3]};
}

} // namespace

TEST_SUITE("drivers/gles3/gl/program") {
    TEST_CASE("[gl] an error of a stage names file and line") {
        on_each_gl([](GLTest& gl_test) {
            const gl::ShaderSource source{.name = "bad",
                                          .vertex = kFullscreen,
                                          .fragment =
                                              "#line 40 0\nout vec4 c;\nvoid main() { c = nothing; }\n",
                                          .files = kFiles};
            gl_test.provoke([&] {
                const Expected<gl::Program> program = gl::Program::create(source);
                REQUIRE_FALSE(program);
                CHECK(program.error().code == ErrorCode::ParseError);
                CHECK(program.error().where.file == "test.glsl");
                CHECK(program.error().where.line == 41);
                CHECK(program.error().message.find("nothing") != std::string::npos);
            });
        });
    }

    TEST_CASE("[gl] stages that do not fit together are refused with a reason") {
        on_each_gl([](GLTest& gl_test) {
            const gl::ShaderSource source{
                .name = "unlinkable",
                .vertex = kFullscreen,
                .fragment = "in vec3 v_missing;\nout vec4 c;\nvoid main() { c = vec4(v_missing, 1.0); }\n",
                .files = kFiles};
            gl_test.provoke([&] {
                const Expected<gl::Program> program = gl::Program::create(source);
                REQUIRE_FALSE(program);
                CHECK(program.error().message.find("v_missing") != std::string::npos);
            });
        });
    }

    TEST_CASE("[gl] uniforms of every type arrive as they were set, and absent ones are no fault") {
        on_each_gl([](GLTest&) {
            static constexpr gl::UniformDecl kUniforms[] = {
                {"a", "float", 1},  {"b", "int", 1},   {"c", "uint", 1}, {"d", "vec2", 1},
                {"e", "vec3", 1},   {"f", "vec4", 1},  {"g", "mat3", 1}, {"h", "mat4", 1},
                {"i", "ivec2", 1},  {"j", "ivec3", 1}, {"k", "vec4", 3}, {"l", "float", 2},
                {"gone", "vec4", 1}};
            const gl::ShaderSource source{
                .name = "uniforms",
                .vertex = kFullscreen,
                .fragment =
                    "uniform float a; uniform int b; uniform uint c; uniform vec2 d; uniform vec3 e; uniform "
                    "vec4 f;\n"
                    "uniform mat3 g; uniform mat4 h; uniform ivec2 i; uniform ivec3 j; uniform vec4 k[3]; "
                    "uniform float l[2];\n"
                    "layout(location = 0) out vec4 o;\n"
                    "void main() { o = vec4(a + float(b) + float(c), d.y + e.z + f.w, g[2][0] + h[3][1],\n"
                    "  float(i.y + j.z) + k[2].x + l[1]); }\n",
                .files = kFiles,
                .uniforms = kUniforms};
            const Expected<gl::Program> program = gl::Program::create(source);
            REQUIRE(program);
            program->set_uniform(0, 0.5f);
            program->set_uniform(1, -2);
            program->set_uniform(2, 7u);
            program->set_uniform(3, glm::vec2(0, 1));
            program->set_uniform(4, glm::vec3(0, 0, 10));
            program->set_uniform(5, glm::vec4(0, 0, 0, 100));
            glm::mat3 g(0.0f);
            g[2][0] = 3.0f; // column 2, row 0
            program->set_uniform(6, g);
            glm::mat4 h(0.0f);
            h[3][1] = 20.0f;
            program->set_uniform(7, h);
            program->set_uniform(8, glm::ivec2(0, 1));
            program->set_uniform(9, glm::ivec3(0, 0, 10));
            const std::array k{glm::vec4(0), glm::vec4(0), glm::vec4(100, 0, 0, 0)};
            program->set_uniform(10, std::span<const glm::vec4>(k));
            const std::array l{0.0f, 1000.0f};
            program->set_uniform(11, std::span<const float>(l));
            program->set_uniform(12, glm::vec4(1));
            CHECK(draw_pixel(*program) == glm::vec4(5.5f, 111.0f, 23.0f, 1111.0f));
        });
    }

    TEST_CASE("[gl] each copy in a stream of blocks is seen as the block when it is bound") {
        on_each_gl([](GLTest&) {
            static constexpr gl::BlockDecl kBlocks[] = {{"Lamp", 3, sizeof(LampBlock)}};
            const gl::ShaderSource source{
                .name = "block",
                .vertex = kFullscreen,
                .fragment =
                    "layout(std140) uniform Lamp { vec3 color; float range; vec4 planes[2]; vec2 size; };\n"
                    "layout(location = 0) out vec4 o;\n"
                    "void main() { o = vec4(color.b, range, planes[1].z, size.y); }\n",
                .files = kFiles,
                .blocks = kBlocks};
            const Expected<gl::Program> program = gl::Program::create(source);
            REQUIRE(program);
            BlockStream<LampBlock> lamps;
            for (int i = 0; i < 3; ++i) {
                const auto v = static_cast<float>(i * 10);
                CHECK(lamps.push({{0, 0, v}, v + 1, {glm::vec4(0), glm::vec4(0, 0, v + 2, 0)}, {0, v + 3}}) ==
                      i);
            }
            REQUIRE(lamps.upload());
            for (int i = 2; i >= 0; --i) {
                lamps.bind(i);
                const auto v = static_cast<float>(i * 10);
                CHECK(draw_pixel(*program) == glm::vec4(v, v + 1, v + 2, v + 3));
            }
        });
    }

    TEST_CASE("[gl] flags choose what is compiled, and a variant is compiled once") {
        on_each_gl([](GLTest& gl_test) {
            using S = shaders::ToneMap;
            gl::ShaderVariants<S> programs;
            const auto linear = programs.get(0), reinhard = programs.get(S::kReinhard),
                       again = programs.get(0);
            REQUIRE(linear);
            REQUIRE(reinhard);
            CHECK(*linear == *again);
            CHECK(*linear != *reinhard);
            CHECK(gl_test.state().live(gl::ObjectKind::Program) == 2);

            Expected<gl::Texture2D> radiance =
                gl::Texture2D::create({.size = {1, 1}, .format = gl::Format::RGBA32F});
            REQUIRE(radiance);
            const glm::vec4 white(1.0f);
            REQUIRE(radiance->upload(0, {0, 0}, {1, 1}, std::as_bytes(std::span(&white, 1))));
            float shown[2] = {};
            for (int i = 0; i < 2; ++i) {
                const gl::ShaderProgram<S>& program = i == 0 ? **linear : **reinhard;
                program.set(S::exposure, 1.0f);
                program.set(S::white, 4.0f);
                program.bind(S::radiance, *radiance);
                shown[i] = draw_pixel(program).r;
            }
            CHECK(shown[0] > 0.99f); // white is 254 or 255: halves are truncated on the way
            CHECK(shown[1] < 0.9f);
        });
    }

    TEST_CASE("[gl] the driver takes every variant that the build has checked") {
        on_each_gl([](GLTest&) {
            for (const gl::ShaderSource* source : shaders::all()) {
                const std::string name(source->name);
                CAPTURE(name);
                for (const uint32_t flags : source->validated) {
                    CAPTURE(flags);
                    const Expected<gl::Program> program = gl::Program::create(*source, flags);
                    CHECK_MESSAGE(program, program.error().to_string());
                }
            }
        });
    }

    TEST_CASE("[gl] blocks have the size in C++ that they have in GL") {
        on_each_gl([](GLTest&) {
            std::set<std::string> seen;
            for (const gl::ShaderSource* source : shaders::all()) {
                const Expected<gl::Program> program = gl::Program::create(*source, source->validated.back());
                REQUIRE(program);
                for (const gl::BlockDecl& block : source->blocks) {
                    const std::string name(block.name);
                    const GLuint index = glGetUniformBlockIndex(program->id(), name.c_str());
                    if (index == GL_INVALID_INDEX) {
                        continue; // not in this variant
                    }
                    GLint bytes = 0, binding = 0;
                    glGetActiveUniformBlockiv(program->id(), index, GL_UNIFORM_BLOCK_DATA_SIZE, &bytes);
                    glGetActiveUniformBlockiv(program->id(), index, GL_UNIFORM_BLOCK_BINDING, &binding);
                    CAPTURE(name);
                    CHECK((bytes + 15) / 16 * 16 == block.bytes); // GL may leave the last rounding out
                    CHECK(binding == block.binding);
                    seen.insert(name);
                }
            }
            CHECK_FALSE(seen.empty());
        });
    }
}
