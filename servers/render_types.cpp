#include "servers/render_types.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl {
namespace {

/// Off-centre perspective through the rectangle [left, right] x [bottom, top] of the near plane (glFrustum).
glm::mat4 frustum_matrix(glm::vec2 least, glm::vec2 most, float near_m, float far_m) noexcept {
    const glm::vec2 extent = most - least;
    const float depth = far_m - near_m;
    glm::mat4 m(0.0f);
    m[0][0] = 2.0f * near_m / extent.x;
    m[1][1] = 2.0f * near_m / extent.y;
    m[2][0] = (most.x + least.x) / extent.x;
    m[2][1] = (most.y + least.y) / extent.y;
    m[2][2] = -(far_m + near_m) / depth;
    m[2][3] = -1.0f;
    m[3][2] = -2.0f * far_m * near_m / depth;
    return m;
}

glm::mat4 perspective_matrix(float fov_y_rad, float aspect, float near_m, float far_m) noexcept {
    const float cot = 1.0f / std::tan(0.5f * fov_y_rad);
    const float depth = far_m - near_m;
    glm::mat4 m(0.0f);
    m[0][0] = cot / aspect;
    m[1][1] = cot;
    m[2][2] = -(far_m + near_m) / depth;
    m[2][3] = -1.0f;
    m[3][2] = -2.0f * far_m * near_m / depth;
    return m;
}

glm::mat4 orthogonal_matrix(glm::vec2 extent_m, float near_m, float far_m) noexcept {
    const float depth = far_m - near_m;
    glm::mat4 m(1.0f);
    m[0][0] = 2.0f / extent_m.x;
    m[1][1] = 2.0f / extent_m.y;
    m[2][2] = -2.0f / depth;
    m[3][2] = -(far_m + near_m) / depth;
    return m;
}

/// What an orthogonal camera sees, and a frustum camera on its near plane [m].
glm::vec2 view_extent_m(const CameraDesc& camera, float aspect) noexcept {
    return camera.keep_aspect == KeepAspect::Width ? glm::vec2(camera.size_m, camera.size_m / aspect)
                                                   : glm::vec2(camera.size_m * aspect, camera.size_m);
}

} // namespace

glm::mat4 projection_matrix(const CameraDesc& camera, glm::ivec2 size) noexcept {
    const float aspect = static_cast<float>(std::max(size.x, 1)) / static_cast<float>(std::max(size.y, 1));
    switch (camera.projection) {
    case Projection::Orthogonal:
        return orthogonal_matrix(view_extent_m(camera, aspect), camera.near_m, camera.far_m);
    case Projection::Frustum: {
        const glm::vec2 half = 0.5f * view_extent_m(camera, aspect);
        return frustum_matrix(camera.frustum_offset - half, camera.frustum_offset + half, camera.near_m,
                              camera.far_m);
    }
    case Projection::Perspective:
        break;
    }
    float fov_y_rad = glm::radians(camera.fov_deg);
    if (camera.keep_aspect == KeepAspect::Width) {
        fov_y_rad = 2.0f * std::atan(std::tan(0.5f * fov_y_rad) / aspect);
    }
    return perspective_matrix(fov_y_rad, aspect, camera.near_m, camera.far_m);
}

AABB light_bounds(const LightDesc& light) noexcept {
    const float range = std::max(light.range_m, 0.0f);
    if (light.type == LightType::Omni) {
        return {glm::vec3(-range), glm::vec3(2.0f * range)};
    }
    if (light.type == LightType::Directional) {
        return {};
    }
    if (light.spot_angle_deg < 90.0f) {
        const float half = std::tan(glm::radians(std::max(light.spot_angle_deg, 0.0f))) * range;
        return {glm::vec3(-half, -half, -range), glm::vec3(2.0f * half, 2.0f * half, range)};
    }
    return {glm::vec3(-range), glm::vec3(2.0f * range)}; // a cone this wide shines backward too
}

} // namespace cl
