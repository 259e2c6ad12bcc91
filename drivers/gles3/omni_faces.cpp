#include "drivers/gles3/omni_faces.h"

#include <glm/ext/matrix_clip_space.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

namespace {

/// Beyond 90 degrees at each edge [texels]: taps lie up to one texel outside, and each mixes 2 x 2 texels.
constexpr float kMargin = 2.0f;

} // namespace

OmniFaces::OmniFaces(const gl::Rect& slot) noexcept
    : corner_(slot.position), tile_(std::max(slot.size.x / 3, 1)) {
    const auto edge = static_cast<float>(tile_);
    right_angle_ = edge - 2.0f * std::min(kMargin, 0.25f * edge); // of a few texels, some are left
}

gl::Rect OmniFaces::rect(int face) const noexcept {
    return {corner_ + glm::ivec2(face % 3, face / 3) * tile_, glm::ivec2(tile_)};
}

Transform OmniFaces::face_from_light(int face) noexcept {
    // Of the two axes that follow the face's own round the circle x, y, z, the first is up.
    const int axis = face % 3;
    const float sign = face < 3 ? 1.0f : -1.0f;
    glm::mat3 light_from_face(0.0f);
    light_from_face[0][(axis + 2) % 3] = sign;
    light_from_face[1][(axis + 1) % 3] = 1.0f;
    light_from_face[2][axis] = -sign;
    return {glm::transpose(light_from_face), glm::vec3(0.0f)};
}

glm::mat4 OmniFaces::clip_from_face(float near_m) const noexcept {
    const float tan_half = static_cast<float>(tile_) / right_angle_;
    return glm::infinitePerspective(2.0f * std::atan(tan_half), 1.0f, near_m);
}

glm::vec4 OmniFaces::uv_tiles(int atlas_size) const noexcept {
    const auto edge = static_cast<float>(tile_);
    const glm::vec2 middle = glm::vec2(corner_) + 0.5f * edge;
    return glm::vec4(middle, edge, 0.5f * right_angle_) / static_cast<float>(atlas_size);
}

} // namespace cl::gles3
