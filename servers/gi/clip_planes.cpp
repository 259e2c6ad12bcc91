#include "servers/gi/clip_planes.h"

#include <glm/common.hpp>

#include <cmath>

namespace cl::gi {

namespace {

constexpr float kEpsilon = 1e-5f;

float dot(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace

void ClipPlanes::turn_to(const glm::ivec3& dims, const glm::vec3& direction) noexcept {
    count_ = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(direction[axis]) < kEpsilon) {
            continue;
        }
        Plane& plane = planes_[size_t(count_++)];
        plane.normal[axis] = 1.0f;
        if (direction[axis] < 0.0f) {
            plane.d = float(dims[axis] + 1);
            plane.is_set = true;
        } else {
            plane.d -= 1.0f;
        }
    }
}

void ClipPlanes::then(const ClipPlanes& later) noexcept {
    for (size_t i = 0; i < planes_.size(); ++i) {
        const Plane& turned = later.planes_[i];
        planes_[i].normal = glm::max(planes_[i].normal, turned.normal);
        planes_[i].d = turned.is_set ? turned.d : planes_[i].d + turned.d;
        planes_[i].is_set = planes_[i].is_set || turned.is_set;
    }
}

glm::vec3 ClipPlanes::clipped_start(glm::vec3 from, const glm::vec3& to) const noexcept {
    for (int i = 0; i < count_; ++i) {
        const Plane& plane = planes_[size_t(i)];
        const glm::vec3 along = from - to;
        const float slope = dot(plane.normal, along);
        const float t = (dot(plane.normal, from) - plane.d) / slope;
        if (std::abs(slope) >= kEpsilon && t >= -kEpsilon && t <= 1.0f + kEpsilon) {
            from -= t * along;
        }
    }
    return from;
}

} // namespace cl::gi
