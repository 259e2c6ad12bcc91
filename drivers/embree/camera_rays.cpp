#include "drivers/embree/camera_rays.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace cl::embree {

namespace {

/// As drivers/gles3/passes/sky_pass.cpp chooses it.
CameraDesc sky_camera(const Frame& frame) noexcept {
    CameraDesc camera = frame.camera;
    if (camera.projection == Projection::Orthogonal) {
        camera.projection = Projection::Perspective;
    }
    if (frame.has_environment && frame.environment.sky_custom_fov_deg > 0.0f) {
        camera.projection = Projection::Perspective;
        camera.fov_deg = frame.environment.sky_custom_fov_deg;
    }
    return camera;
}

glm::dvec3 point_at(const glm::dmat4& from_clip, const glm::dvec2& ndc, double depth) noexcept {
    const glm::dvec4 p = from_clip * glm::dvec4(ndc, depth, 1.0);
    return glm::dvec3(p) / p.w;
}

} // namespace

CameraRays::CameraRays(const Frame& frame)
    : size_(frame.size),
      world_from_clip_(glm::dmat4(frame.camera.world_from_camera.to_mat4()) *
                       glm::inverse(glm::dmat4(projection_matrix(frame.camera, frame.size)))),
      view_from_sky_clip_(glm::inverse(glm::dmat4(projection_matrix(sky_camera(frame), frame.size)))),
      world_from_view_(frame.camera.world_from_camera.basis) {}

CameraRays::CameraRay CameraRays::ray(const glm::vec2& pixel) const noexcept {
    const glm::dvec2 unit = glm::dvec2(pixel) / glm::dvec2(size_);
    const glm::dvec2 ndc(2.0 * unit.x - 1.0, 1.0 - 2.0 * unit.y);
    const glm::dvec3 near = point_at(world_from_clip_, ndc, -1.0);
    const glm::dvec3 far = point_at(world_from_clip_, ndc, 1.0);
    const glm::dvec3 sky = point_at(view_from_sky_clip_, ndc, 1.0) - point_at(view_from_sky_clip_, ndc, -1.0);
    CameraRay out;
    out.ray.origin = glm::vec3(near);
    out.ray.direction = glm::vec3(glm::normalize(far - near));
    out.ray.far_m = static_cast<float>(glm::distance(near, far));
    out.sky_direction = glm::normalize(world_from_view_ * glm::vec3(glm::normalize(sky)));
    return out;
}

} // namespace cl::embree
