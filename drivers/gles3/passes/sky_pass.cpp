#include "drivers/gles3/passes/sky_pass.h"

#include "drivers/gles3/gl/pass.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

namespace {

/// Half size (xy) and centre (zw) of the view at distance 1. Parallel cameras look at the sky in perspective.
glm::vec4 view_rays(const Frame& frame) noexcept {
    CameraDesc camera = frame.camera;
    if (camera.projection == Projection::Orthogonal) {
        camera.projection = Projection::Perspective;
    }
    if (frame.environment.sky_custom_fov_deg > 0.0f) {
        camera.projection = Projection::Perspective;
        camera.fov_deg = frame.environment.sky_custom_fov_deg;
    }
    const glm::mat4 clip_from_view = projection_matrix(camera, frame.size);
    const glm::vec2 scale(clip_from_view[0][0], clip_from_view[1][1]);
    return {1.0f / scale, glm::vec2(clip_from_view[2]) / scale};
}

} // namespace

Status SkyPass::draw(const RenderTarget& target, const Frame& frame, const StoredSky& sky,
                     const Resources& resources) {
    using S = shaders::Sky;
    const auto program = programs_.get(0);
    if (!program) {
        return program.error();
    }
    const glm::vec4 rays = view_rays(frame);
    const float pixel_rad = 2.0f * std::atan(rays.y) / static_cast<float>(frame.size.y);
    const float texel_rad = 2.0f * 3.14159265f / static_cast<float>(sky.panorama_width);
    (*program)->set(S::ray, rays);
    (*program)->set(S::sky_from_view,
                    glm::inverse(frame.environment.sky_orientation) * frame.camera.world_from_camera.basis);
    (*program)->set(S::energy, frame.environment.background_energy);
    (*program)->set(S::lod, std::max(0.0f, std::log2(pixel_rad / texel_rad)));
    (*program)->bind(S::panorama, sky.panorama);
    gl::Pass pass({.label = "sky", .target = &target.scene});
    constexpr gl::DrawState kBehind{gl::DepthTest::LessEqual, gl::WriteMask::Color, gl::Cull::Off};
    pass.draw_fullscreen(**program, resources.no_vertices, kBehind);
    return {};
}

} // namespace cl::gles3
