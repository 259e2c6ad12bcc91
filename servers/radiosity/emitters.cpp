#include "servers/radiosity/emitters.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>

namespace cl::radiosity {
namespace {

constexpr float kInversePi = 1.0f / std::numbers::pi_v<float>;

float brightest(const glm::vec3& v) noexcept {
    return std::max(v.x, std::max(v.y, v.z));
}

bool is_far(const Patches& patches, uint32_t patch, float distance_m) noexcept {
    constexpr float kFar_cells = 4.0f;
    return distance_m > kFar_cells * patches.grids[patches.grid[patch]].cells.cell_m;
}

} // namespace

Emitters::Emitters(const Patches& patches) : density_(patches.size(), 0.0f) {
    double total = 0.0;
    for (uint32_t p = 0; p < patches.size(); ++p) {
        const float light = brightest(patches.emission[p]) * patches.area_m2[p];
        // Where grids overlap a surface has patches in both; rays end on those of the first.
        if (light > 0.0f && patches.find(patches.position[p], patches.normal[p]) == p) {
            patch_.push_back(p);
            total += double(light);
        }
    }
    double sum = 0.0;
    for (uint32_t p : patch_) {
        const double light = double(brightest(patches.emission[p])) * double(patches.area_m2[p]);
        sum += light;
        cumulative_.push_back(float(sum / total));
        density_[p] = float(double(kPoints) * light / total / double(patches.area_m2[p]));
    }
}

glm::vec3 Emitters::light_at(const Patches& patches, const RayScene& rays, const glm::vec3& origin,
                             const glm::vec3& normal, const RayFan& fan, float start) const noexcept {
    // Both ways of finding a direction, as rays and points per steradian there. A patch is no point from
    // nearby: there rays do all the work.
    const auto found_per_sr = [&](uint32_t patch, float cos_here, float cos_there, float distance_m) {
        const float by_rays = float(fan.ray_count) * cos_here * kInversePi;
        return is_far(patches, patch, distance_m)
                   ? by_rays + density_[patch] * distance_m * distance_m / cos_there
                   : by_rays;
    };
    glm::vec3 sum(0.0f);
    for (const RayFan::EmitterHit& hit : fan.emitters) {
        const float cos_here = glm::dot(hit.direction, normal);
        if (cos_here > 0.0f && hit.cosine > 0.0f) {
            sum += patches.emission[hit.patch] *
                   (cos_here * kInversePi / found_per_sr(hit.patch, cos_here, hit.cosine, hit.distance_m));
        }
    }
    for (size_t i = 0; i < kPoints && !patch_.empty(); ++i) {
        const float u = (float(i) + start) / float(kPoints);
        const size_t at =
            size_t(std::lower_bound(cumulative_.begin(), cumulative_.end(), u) - cumulative_.begin());
        const uint32_t patch = patch_[std::min(at, patch_.size() - 1)];
        const float lift_m = kLift * patches.grids[patches.grid[patch]].cells.cell_m;
        const glm::vec3 target = patches.position[patch] + lift_m * patches.normal[patch];
        const float distance_m = glm::distance(target, origin);
        const glm::vec3 direction = (target - origin) / std::max(distance_m, 1e-6f);
        const float cos_here = glm::dot(direction, normal),
                    cos_there = -glm::dot(direction, patches.normal[patch]);
        if (cos_here > 0.0f && cos_there > 0.0f && is_far(patches, patch, distance_m) &&
            !rays.is_blocked(origin, target)) {
            sum += patches.emission[patch] *
                   (cos_here * kInversePi / found_per_sr(patch, cos_here, cos_there, distance_m));
        }
    }
    return sum;
}

} // namespace cl::radiosity
