#include "servers/radiosity/solver.h"

#include "servers/gi/float4.h"
#include "servers/radiosity/gather.h"

#include "core/threads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr int kMaxBounces = 96;
constexpr float kTolerance = 1e-3f;

template <typename F>
void for_all(size_t count, const F& f) {
    parallel_for(count, 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            f(i);
        }
    });
}

float largest(const glm::vec3& v) noexcept {
    return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
}

struct Progress {
    double change = 0.0, total = 0.0; ///< sums over records of the largest channel
};
Progress compare(std::span<const gi::float4> before, std::span<const gi::float4> after) noexcept {
    Progress p;
    for (size_t r = 0; r < after.size(); ++r) {
        const gi::float4 d = after[r] - before[r], v = after[r];
        p.change += double(largest({d[0], d[1], d[2]}));
        p.total += double(largest({v[0], v[1], v[2]}));
    }
    return p;
}

/// Sums the bounces after the first: the fixed point of step_bounce(), to which plain iteration converges as
/// albedos stay below 1. Every fourth step goes as far as the changes' ratio says that all later ones would
/// add up to (Aitken's extrapolation), which saves bright rooms most of their bounces.
int bounce(const Transport& t, std::span<const glm::vec3> first, std::vector<glm::vec3>& arriving,
           const std::atomic<bool>& stop) {
    std::vector<gi::float4> now, next(arriving.size());
    for (const glm::vec3& a : arriving) {
        now.push_back(gi::float4{a.x, a.y, a.z, 0.0f});
    }
    double last_change = 0.0;
    int n = 1;
    for (; n <= kMaxBounces && !stop; ++n) {
        step_bounce(t, first, now, next);
        const Progress p = compare(now, next);
        const double ratio = last_change > 0.0 ? std::min(p.change / last_change, 0.98) : 0.0;
        // What is still missing is this change times ratio / (1 - ratio).
        const bool done = p.change * ratio <= double(kTolerance) * p.total * (1.0 - ratio) && n > 2;
        if (n % 4 == 0 && !done) {
            const gi::float4 ahead = gi::splat(float(ratio / (1.0 - ratio)));
            for (size_t r = 0; r < next.size(); ++r) {
                next[r] += ahead * (next[r] - now[r]);
            }
            last_change = 0.0; // the ratio of changes across a leap says nothing
        } else {
            last_change = p.change;
        }
        now.swap(next);
        if (done || p.total == 0.0) {
            break;
        }
    }
    for (size_t r = 0; r < now.size(); ++r) {
        arriving[r] = {now[r][0], now[r][1], now[r][2]};
    }
    return n;
}

std::vector<glm::vec3> light_of(const Transport& t, const Source& source) {
    std::vector<glm::vec3> out(t.patches.size());
    for_all(out.size(), [&](size_t p) {
        const float lift_m = kLift * t.patches.grids[t.patches.grid[p]].cells.cell_m;
        out[p] = direct_light(source, t.rays, t.patches.position[p], t.patches.normal[p], lift_m);
    });
    return out;
}

/// Light that each patch sends on.
std::vector<glm::vec3> sent_on(const Transport& t, std::span<const glm::vec3> direct,
                               std::span<const glm::vec3> arriving) {
    std::vector<glm::vec3> out(t.patches.size());
    for_all(out.size(), [&](size_t p) {
        out[p] = t.patches.albedo[p] * (direct[p] + (arriving.empty() ? glm::vec3(0.0f) : arriving[p]));
    });
    return out;
}

std::vector<Solution::Air> gather_air(const AirPoints& air, const Lighting& lighting, bool with_sky,
                                      std::span<const glm::vec3> leaving) {
    std::vector<Solution::Air> own(air.links.points.size());
    for_all(own.size(), [&](size_t i) {
        const Links::Point& point = air.links.points[i];
        Solution::Air a{};
        const auto add = [&](const glm::vec3& radiance, const glm::vec3& direction) {
            a.mean += radiance;
            for (int axis = 0; axis < 3; ++axis) {
                a.slope[size_t(axis)] += radiance * direction[axis];
            }
        };
        for (uint32_t k = 0; k < point.patch_count + point.sky_count; ++k) {
            const uint32_t target = air.links.targets[point.first + k];
            const bool is_sky = k >= point.patch_count;
            if (!is_sky || with_sky) {
                add(is_sky ? lighting.sky[target] : leaving[target],
                    air.directions[air.rays[point.first + k]]);
            }
        }
        const float scale = point.ray_count > 0 ? 1.0f / float(point.ray_count) : 0.0f;
        own[i] = {a.mean * scale, {a.slope[0] * scale, a.slope[1] * scale, a.slope[2] * scale}};
    });
    std::vector<Solution::Air> shown(own.size());
    for_all(own.size(), [&](size_t i) { shown[i] = own[air.stand_in[i]]; });
    return shown;
}

} // namespace

glm::vec3 direct_light(const Source& s, const RayScene& rays, const glm::vec3& position,
                       const glm::vec3& normal, float lift_m) noexcept {
    glm::vec3 to_light = s.to_light;
    float factor = 1.0f, distance_m = 1e5f;
    if (s.type != SourceType::Directional) {
        const glm::vec3 apart = s.position - position;
        distance_m = glm::length(apart);
        if (distance_m >= s.range_m || distance_m <= 0.0f) {
            return glm::vec3(0.0f);
        }
        to_light = apart / distance_m;
        factor = std::pow(1.0f - distance_m / s.range_m, s.attenuation);
    }
    if (s.type == SourceType::Spot) {
        const float cosine = std::max(glm::dot(to_light, s.to_light), s.cos_spot_angle);
        const float rim = std::max((1.0f - cosine) / std::max(1.0f - s.cos_spot_angle, 1e-6f), 1e-3f);
        factor *= 1.0f - std::pow(rim, s.spot_attenuation);
    }
    factor *= glm::dot(normal, to_light);
    if (!(factor > 0.0f)) {
        return glm::vec3(0.0f);
    }
    const glm::vec3 from = position + lift_m * normal;
    const bool dark =
        s.shadow && rays.is_blocked({from, to_light, std::max(distance_m - 2.0f * lift_m, 0.0f)});
    return dark ? glm::vec3(0.0f) : factor * s.radiance;
}

std::vector<glm::vec3> DirectCache::gather(const Transport& t, std::span<const Source> sources) {
    std::vector<Known> kept;
    std::vector<glm::vec3> sum(t.patches.size(), glm::vec3(0.0f));
    for (const Source& source : sources) {
        const auto found =
            std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.source == source; });
        Known light{source, found == known_.end() ? light_of(t, source) : std::move(found->at_patches)};
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
    const std::vector<glm::vec3> first = gather_records(t, lighting, sent_on(t, direct, {}), Detail::Some);
    std::vector<glm::vec3> arriving = first;
    s.bounces = bounce(t, first, arriving, stop);
    // The last bounce again, from patches instead of records: what is seen has the detail.
    const std::vector<glm::vec3> before_last = at_patches(t, arriving);
    arriving = gather_records(t, lighting, sent_on(t, direct, before_last), Detail::All);
    s.arriving = at_patches(t, arriving);
    s.leaving = sent_on(t, direct, s.arriving);
    for_all(s.leaving.size(), [&](size_t p) { s.leaving[p] += t.patches.emission[p]; });
    for (size_t i = 0; i < t.air.size() && !stop; ++i) {
        s.air.push_back(gather_air(t.air[i], lighting,
                                   !(i < lighting.interior.size() && lighting.interior[i]), s.leaving));
    }
    return s;
}

} // namespace cl::radiosity
