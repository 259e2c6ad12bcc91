#include "drivers/gles3/passes/cone_pass.h"

#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/material_variant.h"

#include "servers/cones/gather.h"

#include <span>
#include <vector>

namespace cl::gles3 {

namespace {

using S = shaders::ConePoints;
using Program = gl::ShaderProgram<S>;

void bind_maps(const MaterialDesc& m, const TextureStorage& textures) {
    Program::bind(S::albedo_map, textures.get_or(m.albedo_texture, DefaultTexture::White));
    Program::bind(S::normal_map, textures.get_or(m.normal_texture, DefaultTexture::FlatNormal));
    Program::bind(S::roughness_map, textures.get_or(m.roughness_texture, DefaultTexture::White));
    Program::bind(S::metallic_map, textures.get_or({}, DefaultTexture::White));
    Program::bind(S::emission_map, textures.get_or({}, DefaultTexture::Black));
    Program::bind(S::ao_map, textures.get_or({}, DefaultTexture::White));
}

std::span<float> floats_of(std::vector<glm::vec4>& pixels) {
    return {&pixels.data()->x, pixels.size() * 4};
}

} // namespace

Status ConePass::draw_points(const RenderTarget& target, const SceneDraws& draws,
                             const Resources& resources) {
    gl::Pass pass({.label = "cone points",
                   .target = &target.cones->points,
                   .colors = {gl::Load::Clear, gl::Load::Clear},
                   .depth = gl::Load::Clear});
    draws.bind_frame();
    for (const SceneDraw& draw : draws.opaque()) {
        const MaterialDesc& m = *draw.item->material;
        if (!writes_depth(m)) {
            continue;
        }
        const auto program = programs_.get(cone_points_variant(m, draw.surface->format));
        if (!program) {
            return program.error();
        }
        draws.bind(draw);
        bind_maps(m, resources.textures);
        gl::DrawState state = depth_state(*draw.item);
        state.write = gl::WriteMask::ColorAndDepth;
        pass.draw(**program, draw.surface->vertex_array, state, draw.surface->range);
    }
    return {};
}

Status ConePass::draw(RenderTarget& target, const Frame& frame, const shaders::FrameBlock& frame_block,
                      const SceneDraws& draws, const Resources& resources) {
    if (Status s = make_cone_buffers(target); !s) {
        return s;
    }
    if (Status s = draw_points(target, draws, resources); !s) {
        return s;
    }
    ConeBuffers& buffers = *target.cones;
    const gl::Rect all{glm::ivec2(0), target.size};
    buffers.points.read_rgba32f(all, 0, floats_of(buffers.place_pixels));
    buffers.points.read_rgba32f(all, 1, floats_of(buffers.shape_pixels));
    const std::vector<cones::ConeSet> sets = draws.cone_sets().resolve(frame, resources.volumes);
    const size_t pixels = buffers.place_pixels.size();
    const std::span<glm::vec4> light(buffers.light_pixels);
    cones::gather_cones(
        {.cones = std::span(frame_block.frame_cones).first(size_t(frame_block.frame_cone_count)),
         .tan_half_aperture = frame_block.frame_cone_tan,
         .reach = frame_block.frame_cone_reach,
         .specular_least_tan = frame_block.frame_specular_least_tan},
        sets,
        {.size = target.size,
         .places = buffers.place_pixels,
         .shapes = buffers.shape_pixels,
         .diffuse = light.first(pixels),
         .specular = light.last(pixels)});
    return buffers.light.upload(0, glm::ivec2(0), {target.size.x, 2 * target.size.y}, std::as_bytes(light));
}

} // namespace cl::gles3
