#include "servers/radiosity/solver.h"

#include "servers/radiosity/bounces.h"
#include "servers/radiosity/for_all.h"
#include "servers/radiosity/gather.h"

#include "core/threads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cl::radiosity {
namespace {

/// b^e, without the call for the usual exponent.
float power(float base, float exponent) noexcept {
    return exponent == 1.0f ? base : std::pow(base, exponent);
}

/// Light that arrives where nothing is in its way, and the way it takes.
struct Aim {
    glm::vec3 light{0.0f};
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
    return {factor * s.radiance,
            {position + lift_m * normal, to_light, std::max(distance_m - 2.0f * lift_m, 0.0f)}};
}

/// Patches whose rays are traced together: fixed runs, so that the result does not know of threads.
constexpr size_t kRun = 64;

void light_run(const Transport& t, const Source& source, size_t first, std::span<glm::vec3> out) {
    std::array<Ray, kRun> ways;
    std::array<uint8_t, kRun> dark{};
    std::array<size_t, kRun> patch{};
    size_t count = 0;
    for (size_t p = first; p < std::min(first + kRun, out.size()); ++p) {
        const float lift_m = kLift * t.patches.grids[t.patches.grid[p]].cells.cell_m;
        const Aim a = aim(source, t.patches.position[p], t.patches.normal[p], lift_m);
        out[p] = a.light;
        if (a.light != glm::vec3(0.0f)) {
            ways[count] = a.way;
            patch[count++] = p;
        }
    }
    if (!source.shadow) {
        return;
    }
    t.rays.find_blocked(std::span(ways).first(count), std::span(dark).first(count));
    for (size_t i = 0; i < count; ++i) {
        out[patch[i]] = dark[i] != 0 ? glm::vec3(0.0f) : out[patch[i]];
    }
}

/// Light that each patch sends on.
std::vector<Rgb4> sent_on(const Transport& t, std::span<const glm::vec3> direct,
                          std::span<const Rgb4> arriving) {
    std::vector<Rgb4> out(t.patches.size());
    for_all(out.size(), [&](size_t p) {
        const Rgb4 straight = direct.empty() ? Rgb4{} : rgb4(direct[p]);
        const Rgb4 all = arriving.empty() ? straight : straight + arriving[p];
        out[p] = rgb4(t.patches.albedo[p]) * all;
    });
    return out;
}

std::vector<glm::vec3> in_three(std::span<const Rgb4> colors) {
    std::vector<glm::vec3> out(colors.size());
    for_all(out.size(), [&](size_t i) { out[i] = rgb(colors[i]); });
    return out;
}

} // namespace

std::vector<glm::vec3> direct_light(const Transport& t, const Source& source) {
    std::vector<glm::vec3> out(t.patches.size());
    parallel_for((out.size() + kRun - 1) / kRun, 32, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            light_run(t, source, run * kRun, out);
        }
    });
    return out;
}

std::vector<glm::vec3> DirectCache::gather(const Transport& t, std::span<const Source> sources) {
    std::vector<Known> kept;
    std::vector<glm::vec3> sum(t.patches.size(), glm::vec3(0.0f));
    for (const Source& source : sources) {
        const auto found =
            std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.source == source; });
        Known light{source, found == known_.end() ? direct_light(t, source) : std::move(found->at_patches)};
        if (found != known_.end()) {
            known_.erase(found); // a second light just like it is traced for itself
        }
        for_all(sum.size(), [&](size_t p) { sum[p] += light.at_patches[p]; });
        if (kept.size() < kMostKnown) {
            kept.push_back(std::move(light));
        }
    }
    known_ = std::move(kept);
    return sum;
}

Solution solve(const Transport& t, const Lighting& lighting, const std::atomic<bool>& stop,
               DirectCache* cache) {
    Solution s;
    DirectCache fresh;
    const std::vector<glm::vec3> direct = (cache ? *cache : fresh).gather(t, lighting.sources);
    const std::vector<Rgb4> first = gather_records(t, lighting, sent_on(t, direct, {}));
    std::vector<Rgb4> arriving;
    s.bounces = sum_bounces(t, first, stop, arriving);
    // The last bounce again, from patches instead of records: what is seen has the detail.
    add_bounce(t, sent_on(t, {}, at_patches(t, arriving)), first, arriving);
    const std::vector<Rgb4> seen = at_patches(t, arriving);
    std::vector<Rgb4> leaving = sent_on(t, direct, seen);
    for_all(leaving.size(), [&](size_t p) { leaving[p] += rgb4(t.patches.emission[p]); });
    s.arriving = in_three(seen);
    s.leaving = in_three(leaving);
    return s;
}

} // namespace cl::radiosity
