#include "servers/radiosity/open_skies.h"

#include "servers/radiosity/sampling.h"
#include "servers/radiosity/sky_bins.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>

namespace cl::radiosity {
namespace {

constexpr uint32_t kSharedRays = 1024;
constexpr size_t kMostShared = 256; ///< lists; curved surfaces, whose normals all differ, fill no memory

RayFan sky_before(const glm::vec3& normal, uint32_t facing, uint32_t rays) {
    RayFan fan;
    const CosineFrame frame(normal);
    for (uint32_t i = 0; i < rays; ++i) {
        fan.skies.push_back(sky_bin(frame.direction(r2_point(i, hashed_start(facing)))));
    }
    std::sort(fan.skies.begin(), fan.skies.end());
    fan.ray_count = rays;
    return fan;
}

} // namespace

void OpenSkies::append_point(const glm::vec3& normal, uint32_t rays) {
    // Normals less than a tenth of a degree apart see one sky.
    const uint32_t facing = glm::packSnorm3x10_1x2({normal, 0.0f});
    const auto known = shared_.find(facing);
    if (known != shared_.end()) {
        links_.points.push_back(known->second);
        return;
    }
    const bool is_shared = shared_.size() < kMostShared;
    radiosity::append_point(links_, sky_before(normal, facing, is_shared ? kSharedRays : rays));
    if (is_shared) {
        shared_.emplace(facing, links_.points.back());
    }
}

} // namespace cl::radiosity
