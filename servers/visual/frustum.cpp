#include "servers/visual/frustum.h"

#include <glm/geometric.hpp>

namespace cl {

Frustum frustum_from_clip(const glm::mat4& clip_from_world) noexcept {
    const auto row = [&clip_from_world](int i) {
        return glm::vec4(clip_from_world[0][i], clip_from_world[1][i], clip_from_world[2][i],
                         clip_from_world[3][i]);
    };
    Frustum frustum;
    for (int axis = 0; axis < 3; ++axis) {
        const size_t least = 2 * static_cast<size_t>(axis);
        frustum.planes[least] = row(3) + row(axis);
        frustum.planes[least + 1] = row(3) - row(axis);
    }
    return frustum;
}

bool may_see(const Frustum& frustum, const glm::vec3& least, const glm::vec3& most) noexcept {
    for (const glm::vec4& plane : frustum.planes) {
        const glm::vec3 farthest_in(plane.x >= 0.0f ? most.x : least.x, plane.y >= 0.0f ? most.y : least.y,
                                    plane.z >= 0.0f ? most.z : least.z);
        if (glm::dot(glm::vec3(plane), farthest_in) + plane.w < 0.0f) {
            return false;
        }
    }
    return true;
}

} // namespace cl
