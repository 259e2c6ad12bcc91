#include "servers/radiosity/links.h"

#include "servers/radiosity/sky_bins.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace cl::radiosity {

namespace {

constexpr size_t kBatch = 64;

/// What the rays of a batch that end on fronts of surfaces met.
struct Fronts {
    std::array<Patches::SurfacePoint, kBatch> points;
    std::array<uint8_t, kBatch> numbers; ///< of the rays, modulo 256
    std::array<uint8_t, kBatch> rays;    ///< in the batch
    size_t count = 0;
};

/// Counts hits and lists those in the sky. @return the others
Fronts sort_out(const RayScene& rays, std::span<const Ray> batch, std::span<const Hit> hits, RayFan& fan) {
    Fronts fronts;
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
        const glm::vec3 normal = rays.normal(hit.triangle);
        const bool is_turned = glm::dot(normal, batch[i].direction) > 0.0f;
        fronts.points[fronts.count] = {batch[i].origin + hit.t * batch[i].direction,
                                       is_turned ? -normal : normal};
        fronts.numbers[fronts.count] = number;
        fronts.rays[fronts.count++] = uint8_t(i);
    }
    return fronts;
}

} // namespace

void add_rays(const RayScene& rays, const Patches& patches, std::span<const Ray> asked, RayFan& fan) {
    std::array<Hit, kBatch> hits;
    std::array<uint32_t, kBatch> found;
    for (size_t begin = 0; begin < asked.size(); begin += kBatch) {
        const std::span<const Ray> batch = asked.subspan(begin, std::min(kBatch, asked.size() - begin));
        rays.trace(batch, std::span(hits).first(batch.size()));
        const Fronts fronts = sort_out(rays, batch, hits, fan);
        patches.find_seen(rays, std::span(fronts.points).first(fronts.count),
                          std::span(found).first(fronts.count));
        for (size_t i = 0; i < fronts.count; ++i) {
            const uint32_t patch = found[i];
            if (patch == kNoPatch) {
                continue;
            }
            fan.patches.push_back(patch);
            fan.patch_rays.push_back(fronts.numbers[i]);
            if (patches.emission[patch] != glm::vec3(0.0f)) {
                const glm::vec3& direction = batch[fronts.rays[i]].direction;
                fan.emitters.push_back({patch, hits[fronts.rays[i]].t,
                                        -glm::dot(fronts.points[i].facing, direction), direction});
            }
        }
    }
}

void sort_patches(std::span<uint32_t> patches, size_t patch_count) {
    const int half_bits = (int(std::bit_width(patch_count)) + 1) / 2;
    std::vector<uint32_t> first, sorted(patches.size());
    for (const int shift : {0, half_bits}) {
        const auto digit_of = [=](uint32_t patch) { return (patch >> shift) & ((1u << half_bits) - 1u); };
        first.assign((size_t(1) << half_bits) + 1, 0u);
        for (uint32_t patch : patches) {
            ++first[digit_of(patch) + 1];
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        for (uint32_t patch : patches) {
            sorted[first[digit_of(patch)]++] = patch;
        }
        std::copy(sorted.begin(), sorted.end(), patches.begin());
    }
}

void append_point(Links& links, const RayFan& fan) {
    links.points.push_back({uint32_t(links.targets.size()), uint32_t(fan.patches.size()),
                            uint32_t(fan.skies.size()), fan.ray_count});
    links.targets.insert(links.targets.end(), fan.patches.begin(), fan.patches.end());
    links.targets.insert(links.targets.end(), fan.skies.begin(), fan.skies.end());
}

} // namespace cl::radiosity
