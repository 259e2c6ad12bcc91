#include "servers/radiosity/links.h"

#include "servers/radiosity/sky_bins.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace cl::radiosity {

void add_rays(const StillScene& scene, const RayScene& rays, const Patches& patches,
              std::span<const Ray> asked, RayFan& fan) {
    constexpr size_t kMaxBatch = 256;
    Hit hits[kMaxBatch];
    for (size_t begin = 0; begin < asked.size(); begin += kMaxBatch) {
        const std::span<const Ray> batch = asked.subspan(begin, std::min(kMaxBatch, asked.size() - begin));
        rays.trace(batch, std::span(hits, batch.size()));
        for (size_t i = 0; i < batch.size(); ++i) {
            const Hit& hit = hits[i];
            const uint8_t number = uint8_t(fan.ray_count++);
            if (hit.triangle == kMiss) {
                fan.skies.push_back(sky_bin(batch[i].direction));
                fan.sky_rays.push_back(number);
                continue;
            }
            fan.inverse_distance_sum += 1.0f / std::max(hit.t, 1e-6f);
            if (!hit.is_front) {
                ++fan.back_count;
                continue;
            }
            glm::vec3 facing = scene.normal(hit.triangle);
            facing = glm::dot(facing, batch[i].direction) > 0.0f ? -facing : facing;
            const uint32_t patch =
                patches.find_seen(rays, batch[i].origin + hit.t * batch[i].direction, facing);
            if (patch != kNoPatch) {
                fan.patches.push_back(patch);
                fan.patch_rays.push_back(number);
                if (patches.emission[patch] != glm::vec3(0.0f)) {
                    fan.emitters.push_back(
                        {patch, hit.t, -glm::dot(facing, batch[i].direction), batch[i].direction});
                }
            }
        }
    }
}

void append_point(Links& links, const RayFan& fan) {
    links.points.push_back({uint32_t(links.targets.size()), uint32_t(fan.patches.size()),
                            uint32_t(fan.skies.size()), fan.ray_count});
    links.targets.insert(links.targets.end(), fan.patches.begin(), fan.patches.end());
    links.targets.insert(links.targets.end(), fan.skies.begin(), fan.skies.end());
}

} // namespace cl::radiosity
