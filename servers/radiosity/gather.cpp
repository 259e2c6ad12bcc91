#include "servers/radiosity/gather.h"

#include "servers/radiosity/for_all.h"

#include <algorithm>

namespace cl::radiosity {
namespace {

bool sky_reaches(const Transport& t, const Lighting& lighting, uint32_t patch) noexcept {
    const uint8_t grid = t.patches.grid[patch];
    return grid >= lighting.interior.size() || !lighting.interior[grid];
}

Rgb4 sum_over(std::span<const uint32_t> targets, std::span<const Rgb4> radiance) noexcept {
    Rgb4 sums[4] = {}; // an addition need not wait for the one before
    size_t i = 0;
    for (; i + 4 <= targets.size(); i += 4) {
        for (size_t k = 0; k < 4; ++k) {
            sums[k] += radiance[targets[i + k]];
        }
    }
    for (; i < targets.size(); ++i) {
        sums[0] += radiance[targets[i]];
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

} // namespace

std::vector<Rgb4> sky_lanes(const Lighting& lighting) {
    std::vector<Rgb4> sky;
    for (const glm::vec3& radiance : lighting.sky) {
        sky.push_back(rgb4(radiance));
    }
    return sky;
}

std::vector<Rgb4> from_surroundings(const Transport& t, const Lighting& lighting) {
    const std::vector<Rgb4> sky = sky_lanes(lighting);
    std::vector<Rgb4> arriving(t.records.patch.size());
    for_all(arriving.size(), [&](size_t r) {
        const Links::Point& point = t.records.links.points[r];
        arriving[r] = rgb4(t.records.emitted[r]);
        if (sky_reaches(t, lighting, t.records.patch[r])) {
            arriving[r] += sum_over(t.records.links.skies_of(point), sky) *
                           gi::splat(1.0f / float(std::max(point.ray_count, 1u)));
        }
    });
    return arriving;
}

void add_bounce(const Transport& t, std::span<const Rgb4> leaving, std::span<const Rgb4> first,
                std::span<Rgb4> arriving) {
    for_all(arriving.size(), [&](size_t r) {
        const Links::Point& point = t.records.links.points[r];
        const Rgb4 sum = sum_over(t.records.links.patches_of(point), leaving);
        arriving[r] = first[r] + sum * gi::splat(1.0f / float(std::max(point.ray_count, 1u)));
    });
}

} // namespace cl::radiosity
