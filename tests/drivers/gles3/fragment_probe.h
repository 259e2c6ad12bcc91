#pragma once

#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/gl/state.h"

#include <doctest/doctest.h>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cl::tests {

/// Calls a GLSL function for a few pixels and gives what it returned, in full float precision.
/// `body`: declarations and `vec4 probe(int pixel) { ... }`. `samplers`: the units of its samplers.
inline std::vector<glm::vec4> probe_fragments(std::string_view body, int pixels,
                                              std::span<const gles3::gl::SamplerDecl> samplers = {}) {
    namespace gl = gles3::gl;
    static constexpr std::string_view kVertex = "void main() { gl_Position = vec4(float(gl_VertexID & 1) * "
                                                "4.0 - 1.0, float(gl_VertexID & 2) * 2.0 - 1.0, 0.0, "
                                                "1.0); }\n";
    const std::string fragment = std::string(body) +
                                 "\nlayout(location = 0) out vec4 out_color;\n"
                                 "void main() { out_color = probe(int(gl_FragCoord.x)); }\n";
    static constexpr std::string_view kFiles[] = {"probe"};
    const gl::ShaderSource source{
        .name = "probe", .vertex = kVertex, .fragment = fragment, .files = kFiles, .samplers = samplers};
    Expected<gl::Program> program = gl::Program::create(source);
    REQUIRE_MESSAGE(program, program.error().to_string());
    Expected<gl::Texture2D> target =
        gl::Texture2D::create({.size = {pixels, 1}, .format = gl::Format::RGBA32F});
    REQUIRE(target);
    Expected<gl::Framebuffer> framebuffer = gl::Framebuffer::create({.colors = {{{&*target}}}});
    REQUIRE(framebuffer);
    const gl::VertexArray empty = gl::VertexArray::create_empty();
    {
        gl::PassDesc desc{.label = "probe", .target = &*framebuffer};
        desc.colors[0] = gl::Load::DontCare;
        gl::Pass pass(desc);
        pass.draw_fullscreen(*program, empty);
    }
    const std::vector<float> floats = framebuffer->read_rgba32f({{0, 0}, {pixels, 1}});
    std::vector<glm::vec4> values;
    for (size_t i = 0; i < floats.size(); i += 4) {
        values.emplace_back(floats[i], floats[i + 1], floats[i + 2], floats[i + 3]);
    }
    return values;
}

/// Largest difference of any component.
inline float worst_difference(const glm::vec4& a, const glm::vec4& b) {
    float worst = 0.0f;
    for (int i = 0; i < 4; ++i) {
        worst = std::max(worst, std::abs(a[i] - b[i]));
    }
    return worst;
}

} // namespace cl::tests
