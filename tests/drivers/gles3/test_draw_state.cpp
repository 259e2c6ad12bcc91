#include "tests/drivers/gl_test.h"

#include "drivers/gles3/gl/pass.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

namespace {

constexpr std::string_view kFiles[] = {"flat"};
constexpr gl::UniformDecl kUniforms[] = {{"color", "vec4", 1}, {"depth", "float", 1}, {"mirror", "float", 1}};
/// A counter-clockwise triangle over the target (clockwise with mirror = -1) at one depth [-1, 1].
constexpr gl::ShaderSource kFlat{
    .name = "flat",
    .vertex = "uniform float depth; uniform float mirror;\n"
              "void main() { vec2 p = vec2(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID & 2) * 2.0 "
              "- 1.0);\n"
              "  gl_Position = vec4(p.x, p.y * mirror, depth, 1.0); }\n",
    .fragment = "uniform vec4 color;\nlayout(location = 0) out vec4 c;\nvoid main() { c = color; }\n",
    .files = kFiles,
    .uniforms = kUniforms};

/// A 1-pixel target with depth, and the flat program.
struct Bench {
    gl::Texture2D color, depth;
    gl::Framebuffer target;
    gl::Program program;
    gl::VertexArray empty;

    static Bench make() {
        Expected<gl::Texture2D> color =
            gl::Texture2D::create({.size = {1, 1}, .format = gl::Format::RGBA16F});
        Expected<gl::Texture2D> depth =
            gl::Texture2D::create({.size = {1, 1}, .format = gl::Format::Depth24});
        REQUIRE(color);
        REQUIRE(depth);
        Expected<gl::Framebuffer> target =
            gl::Framebuffer::create({.colors = {{{&*color}}}, .depth = {&*depth}});
        Expected<gl::Program> program = gl::Program::create(kFlat);
        REQUIRE(target);
        REQUIRE(program);
        return {*std::move(color), *std::move(depth), *std::move(target), *std::move(program),
                gl::VertexArray::create_empty()};
    }
    [[nodiscard]] gl::PassDesc cleared_to(glm::vec4 value, float far = 1.0f) const {
        gl::PassDesc desc{.label = "bench", .target = &target};
        desc.colors[0] = gl::Load::Clear;
        desc.clear_colors[0] = value;
        desc.depth = gl::Load::Clear;
        desc.clear_depth = far;
        return desc;
    }
    void draw(gl::Pass& pass, glm::vec4 value, const gl::DrawState& state, float z = 0.0f,
              float mirror = 1.0f) const {
        program.set_uniform(0, value);
        program.set_uniform(1, z);
        program.set_uniform(2, mirror);
        pass.draw(program, empty, state, {PrimitiveType::Triangles, 0, 3, 1});
    }
    [[nodiscard]] glm::vec4 pixel() const {
        const std::vector<float> p = target.read_rgba32f({{0, 0}, {1, 1}});
        return {p[0], p[1], p[2], p[3]};
    }
    /// What one draw makes of a target that holds `under`.
    [[nodiscard]] glm::vec4 over(glm::vec4 under, glm::vec4 value, const gl::DrawState& state) const {
        {
            gl::Pass pass(cleared_to(under));
            draw(pass, value, state);
        }
        return pixel();
    }
};

} // namespace

TEST_SUITE("drivers/gles3/gl/draw_state") {
    TEST_CASE("[gl] each blend joins source and target by its formula") {
        on_each_gl([](GLTest&) {
            const Bench bench = Bench::make();
            const glm::vec4 under(0.5f, 1.0f, 2.0f, 0.5f), value(1.0f, 0.25f, 0.0f, 0.25f);
            const auto blended = [&](const gl::Blend& blend) {
                return bench.over(under, value, {.depth_test = gl::DepthTest::Off, .blend = blend});
            };
            CHECK(blended(gl::blend::kReplace) == value);
            CHECK(blended(gl::blend::kMix) == glm::vec4(0.625f, 0.8125f, 1.5f, 0.625f));
            CHECK(blended(gl::blend::kAdd) == glm::vec4(0.75f, 1.0625f, 2.0f, 0.5625f));
            CHECK(blended(gl::blend::kSub) == glm::vec4(0.25f, 0.9375f, 2.0f, 0.4375f));
            CHECK(blended(gl::blend::kMul) == glm::vec4(0.5f, 0.25f, 0.0f, 0.125f));
        });
    }

    TEST_CASE("[gl] culling goes by the winding that counts as front") {
        on_each_gl([](GLTest&) {
            const Bench bench = Bench::make();
            for (const float mirror : {1.0f, -1.0f}) {
                for (const gl::Cull cull : {gl::Cull::Off, gl::Cull::Back, gl::Cull::Front}) {
                    for (const gl::FrontFace front :
                         {gl::FrontFace::CounterClockwise, gl::FrontFace::Clockwise}) {
                        {
                            gl::Pass pass(bench.cleared_to(glm::vec4(0.0f)));
                            bench.draw(pass, glm::vec4(1.0f), {.cull = cull, .front_face = front}, 0.0f,
                                       mirror);
                        }
                        const bool is_front = (front == gl::FrontFace::CounterClockwise) == (mirror > 0.0f);
                        const bool drawn = cull == gl::Cull::Off || (cull == gl::Cull::Back) == is_front;
                        CHECK(bench.pixel().r == (drawn ? 1.0f : 0.0f));
                    }
                }
            }
        });
    }

    TEST_CASE("[gl] each depth test passes what its name says") {
        on_each_gl([](GLTest&) {
            const Bench bench = Bench::make();
            struct Case {
                gl::DepthTest test;
                bool nearer, same, farther;
            };
            for (const Case& c :
                 {Case{gl::DepthTest::Off, true, true, true}, Case{gl::DepthTest::Less, true, false, false},
                  Case{gl::DepthTest::LessEqual, true, true, false},
                  Case{gl::DepthTest::Equal, false, true, false},
                  Case{gl::DepthTest::Always, true, true, true}}) {
                const std::array<std::pair<float, bool>, 3> depths{
                    {{-0.5f, c.nearer}, {0.0f, c.same}, {0.5f, c.farther}}};
                for (const auto& [z, passes] : depths) {
                    {
                        gl::Pass pass(bench.cleared_to(glm::vec4(0.0f), 0.5f));
                        bench.draw(pass, glm::vec4(0.0f), {.depth_test = gl::DepthTest::Always}, 0.0f);
                        bench.draw(pass, glm::vec4(1.0f), {.depth_test = c.test}, z);
                    }
                    CHECK(bench.pixel().r == (passes ? 1.0f : 0.0f));
                }
            }
        });
    }

    TEST_CASE("[gl] write masks hold colour and depth apart") {
        on_each_gl([](GLTest&) {
            const Bench bench = Bench::make();
            {
                gl::Pass pass(bench.cleared_to(glm::vec4(0.0f)));
                bench.draw(pass, glm::vec4(1.0f), {.write = gl::WriteMask::Depth}, -0.5f);
            }
            CHECK(bench.pixel().r == 0.0f);
            {
                gl::PassDesc keep{.label = "keep", .target = &bench.target};
                gl::Pass pass(keep);
                bench.draw(pass, glm::vec4(1.0f),
                           {.depth_test = gl::DepthTest::Less, .write = gl::WriteMask::Color}, 0.0f);
            }
            CHECK(bench.pixel().r == 0.0f); // the depth of -0.5 was written
            {
                gl::Pass pass(bench.cleared_to(glm::vec4(0.0f)));
                bench.draw(pass, glm::vec4(1.0f), {.write = gl::WriteMask::Color}, -0.5f);
                bench.draw(pass, glm::vec4(2.0f), {.depth_test = gl::DepthTest::Less}, 0.0f);
            }
            CHECK(bench.pixel().r == 2.0f); // the depth of -0.5 was not
        });
    }

    TEST_CASE("[gl] polygon offset of positive units pushes a surface behind its equal") {
        on_each_gl([](GLTest&) {
            const Bench bench = Bench::make();
            for (const float units : {0.0f, 4.0f}) {
                {
                    gl::Pass pass(bench.cleared_to(glm::vec4(0.0f)));
                    bench.draw(pass, glm::vec4(1.0f), {}, 0.0f);
                    bench.draw(pass, glm::vec4(2.0f), {.polygon_offset = {0.0f, units}}, 0.0f);
                }
                CHECK(bench.pixel().r == (units > 0.0f ? 1.0f : 2.0f));
            }
        });
    }
}
