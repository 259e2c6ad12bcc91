#include "servers/radiosity/direct_light.h"

#include "core/threads.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace cl::radiosity {
namespace {

/// b^e, without the call for the usual exponent.
float power(float base, float exponent) noexcept {
    return exponent == 1.0f ? base : std::pow(base, exponent);
}

/// Light that arrives where nothing is in its way, and the way it takes.
struct Aim {
    float light = 0.0f;
    Ray way;
};

Aim aim(const Source& s, const glm::vec3& position, const glm::vec3& normal, float lift_m) noexcept {
    glm::vec3 to_light = s.to_light;
    float factor = 1.0f, distance_m = 1e5f;
    if (s.type != SourceType::Directional) {
        const glm::vec3 apart = s.position - position;
        distance_m = glm::length(apart);
        if (distance_m >= s.range_m || distance_m <= 0.0f) {
            return {};
        }
        to_light = apart / distance_m;
        factor = power(1.0f - distance_m / s.range_m, s.attenuation);
    }
    if (s.type == SourceType::Spot) {
        const float cosine = std::max(glm::dot(to_light, s.to_light), s.cos_spot_angle);
        const float rim = std::max((1.0f - cosine) / std::max(1.0f - s.cos_spot_angle, 1e-6f), 1e-3f);
        factor *= 1.0f - power(rim, s.spot_attenuation);
    }
    factor *= glm::dot(normal, to_light);
    if (!(factor > 0.0f)) {
        return {};
    }
    return {factor, {position + lift_m * normal, to_light, std::max(distance_m - 2.0f * lift_m, 0.0f)}};
}

/// Patches whose rays are traced together: fixed runs, so that the result does not know of threads.
constexpr size_t kRun = 64;

void light_run(const Transport& t, const Source& source, size_t first, std::span<float> out) {
    std::array<Ray, kRun> ways;
    std::array<uint8_t, kRun> dark{};
    std::array<size_t, kRun> patch{};
    size_t count = 0;
    for (size_t p = first; p < std::min(first + kRun, out.size()); ++p) {
        const float lift_m = kLift * t.patches.grids[t.patches.grid[p]].cells.cell_m;
        const Aim a = aim(source, t.patches.position[p], t.patches.normal[p], lift_m);
        out[p] = a.light;
        if (a.light != 0.0f) {
            ways[count] = a.way;
            patch[count++] = p;
        }
    }
    if (!source.shadow) {
        return;
    }
    t.rays.find_blocked(std::span(ways).first(count), std::span(dark).first(count));
    for (size_t i = 0; i < count; ++i) {
        out[patch[i]] = dark[i] != 0 ? 0.0f : out[patch[i]];
    }
}

} // namespace

std::vector<float> unit_light(const Transport& t, const Source& source) {
    std::vector<float> out(t.patches.size());
    parallel_for((out.size() + kRun - 1) / kRun, 32, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            light_run(t, source, run * kRun, out);
        }
    });
    return out;
}

} // namespace cl::radiosity
