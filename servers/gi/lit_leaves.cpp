// Which leaves a light reaches (spec gi-update section 5).
#include "servers/gi/clip_planes.h"
#include "servers/gi/light_march.h"
#include "servers/gi/relight.h"

#include "core/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace cl::gi {

namespace {

using Leaf = CellLayout::Leaf;

/// Below this much N.L a leaf counts as turned away.
constexpr float kMinFacing = 0.001f;
/// Rays end this far from the voxel's centre, toward the light, so that they arrive inside the voxel.
constexpr float kTowardLight = 0.47f;

float dot(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
float length(const glm::vec3& v) {
    return std::sqrt(dot(v, v));
}
glm::vec3 normalized_or_zero(const glm::vec3& v) {
    const float l = length(v);
    return l > 0.0f ? v / l : glm::vec3(0.0f);
}
/// -1 below 0, +1 from 0 on.
glm::vec3 signs(const glm::vec3& v) {
    return {v.x < 0.0f ? -1.0f : 1.0f, v.y < 0.0f ? -1.0f : 1.0f, v.z < 0.0f ? -1.0f : 1.0f};
}
/// b^e, without the call for the usual exponent, whose result is b.
float power(float base, float exponent) {
    return exponent == 1.0f ? base : std::pow(base, exponent);
}

/// The end of the way from a light to a leaf, and the light's share that arrives if nothing is in its way.
struct Ray {
    glm::vec3 to{0.0f};        ///< [cells]
    glm::vec3 direction{0.0f}; ///< of the light's travel, unit length
    float attenuation = 0.0f;
};

/// A march along a ray that starts whole steps before its end. @param extra_steps  sun rays start one farther
/// out.
March whole_steps(const glm::ivec3& dims, const Ray& ray, const glm::vec3& from, float extra_steps) {
    const float step = advance_of(ray.direction);
    // Clipped, a ray is no longer than the grid's diagonal and its margins. Where float32 cannot clip (a
    // light 1e9 cells away) this keeps the march short.
    const float longest = 1.1f * length(glm::vec3(dims)) + 8.0f;
    float distance = std::min(length(ray.to - from), longest);
    distance += extra_steps * step - remainder_of(distance, step);
    return {ray.to - ray.direction * distance, ray.direction, distance, step};
}

/// Section 5.2.
class Sun {
public:
    Sun(const CellLayout& layout, const CachedLight& light)
        : dims_(layout.dims), direction_(-normalized_or_zero(light.cells_from_light.basis[2])),
          start_(length(glm::vec3(layout.dims)) * 1.1f) {
        planes_.turn_to(dims_, direction_);
    }

    [[nodiscard]] std::optional<Ray> ray_to(const Leaf& leaf) const {
        const float facing = dot(leaf.normal, -direction_);
        if (!(facing >= kMinFacing)) {
            return std::nullopt;
        }
        return Ray{glm::vec3(leaf.voxel) + 0.5f - kTowardLight * signs(direction_), direction_, facing};
    }

    /// Its one direction turned the planes before the first leaf.
    void turn(ClipPlanes&, const Ray&) const {}
    [[nodiscard]] const ClipPlanes& planes() const { return planes_; }

    [[nodiscard]] March march(const Ray& ray, const ClipPlanes& planes) const {
        return whole_steps(dims_, ray, planes.clipped_start(ray.to - start_ * direction_, ray.to), 1.0f);
    }

private:
    glm::ivec3 dims_;
    glm::vec3 direction_; ///< of the light's travel
    float start_;         ///< far enough to be outside of the grid [cells]
    ClipPlanes planes_;
};

/// Section 5.3: omni lights, and spots, which have a cone besides.
class Lamp {
public:
    Lamp(const CellLayout& layout, const CachedLight& light)
        : dims_(layout.dims), light_(light), position_(light.cells_from_light.origin),
          axis_(-normalized_or_zero(light.cells_from_light.basis[2])),
          range_(light.range_m * length(light.cells_from_light.basis[2])) {}

    [[nodiscard]] std::optional<Ray> ray_to(const Leaf& leaf) const {
        glm::vec3 to = glm::vec3(leaf.voxel) + 0.5f;
        to += kTowardLight * signs(position_ - to);
        const glm::vec3 way = to - position_;
        // Most leaves end here, before the root and the divisions. Roundings of these sums and of those below
        // are far smaller than kMinFacing and the margin.
        constexpr float kMargin = 1.001f;
        if (!(dot(leaf.normal, way) < 0.0f) || dot(way, way) > kMargin * range_ * range_) {
            return std::nullopt;
        }
        const float distance = length(way);
        const glm::vec3 direction = way / distance;
        const float facing = dot(leaf.normal, -direction);
        const float reach = distance + advance_of(direction);
        if (!(facing >= kMinFacing) || reach > range_) {
            return std::nullopt;
        }
        const float cone = light_.type == LightType::Spot ? cone_share(direction) : 1.0f;
        const float attenuation =
            facing * power(1.0f - std::clamp(reach / range_, 0.0f, 1.0f), light_.attenuation);
        if (cone < 0.0f) {
            return std::nullopt;
        }
        return Ray{to, direction, attenuation * cone};
    }

    void turn(ClipPlanes& planes, const Ray& ray) const { planes.turn_to(dims_, ray.direction); }

    [[nodiscard]] March march(const Ray& ray, const ClipPlanes& planes) const {
        return whole_steps(dims_, ray, planes.clipped_start(position_, ray.to), 0.0f);
    }

private:
    /// Negative outside the cone.
    [[nodiscard]] float cone_share(const glm::vec3& direction) const {
        constexpr double kDegrees = 180.0 / 3.14159265358979323846;
        const float angle_deg = float(std::acos(std::clamp(dot(direction, axis_), -1.0f, 1.0f)) * kDegrees);
        if (angle_deg > light_.spot_angle_deg) {
            return -1.0f;
        }
        return power(1.0f - std::clamp(angle_deg / light_.spot_angle_deg, 0.0f, 1.0f),
                     light_.spot_attenuation);
    }

    glm::ivec3 dims_;
    const CachedLight& light_;
    glm::vec3 position_; ///< [cells]
    glm::vec3 axis_;
    float range_; ///< [cells]
};

/// Leaves that one thread works on at a time, in their order.
struct Run {
    struct Lit {
        uint32_t leaf;
        Ray ray;
    };
    std::vector<Lit> lit; ///< leaves that face the light within its reach
    ClipPlanes planes;    ///< as the run finds them
    static constexpr size_t kLeaves = 1024;
};

template <typename Light>
std::vector<Run> aim(const CellLayout& layout, const Light& light) {
    std::vector<Run> runs((layout.leaves.size() + Run::kLeaves - 1) / Run::kLeaves);
    parallel_for(runs.size(), 1, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            const size_t last = std::min((run + 1) * Run::kLeaves, layout.leaves.size());
            for (size_t i = run * Run::kLeaves; i < last; ++i) {
                if (const std::optional<Ray> ray = light.ray_to(layout.leaves[i])) {
                    runs[run].lit.push_back({uint32_t(i), *ray});
                }
            }
        }
    });
    return runs;
}

void set_planes(const Sun& sun, std::vector<Run>& runs) {
    for (Run& run : runs) {
        run.planes = sun.planes();
    }
}

/// They turn from leaf to leaf, in the leaves' order.
void set_planes(const Lamp& lamp, std::vector<Run>& runs) {
    parallel_for(runs.size(), 1, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            for (const Run::Lit& lit : runs[run].lit) {
                lamp.turn(runs[run].planes, lit.ray);
            }
        }
    });
    ClipPlanes before;
    for (Run& run : runs) {
        const ClipPlanes turned = std::exchange(run.planes, before);
        before.then(turned);
    }
}

/// Leaves of a run that nothing shades.
template <typename Light>
std::vector<LitLeaf> march_run(const CellLayout& layout, const Light& light, const Run& run) {
    std::vector<LitLeaf> lit;
    lit.reserve(run.lit.size());
    ClipPlanes planes = run.planes;
    std::array<AimedMarch, kMarchLanes> marches;
    std::array<LitLeaf, kMarchLanes> marched;
    size_t count = 0;
    const auto walk = [&] {
        const uint32_t reached = reaches_each(layout.leaf_bitmap, marches);
        for (size_t i = 0; i < count; ++i) {
            if ((reached >> i & 1u) != 0) {
                lit.push_back(marched[i]);
            }
        }
        count = 0;
    };
    for (const auto& [index, ray] : run.lit) {
        const Leaf& leaf = layout.leaves[index];
        light.turn(planes, ray);
        if (ray.attenuation != 0.0f && leaf.albedo != glm::u8vec3(0)) {
            marches[count] = {light.march(ray, planes), glm::ivec3(leaf.voxel)};
            marched[count] = {index, ray.attenuation};
            if (++count == kMarchLanes) {
                walk();
            }
        }
    }
    walk(); // the rest, and some that were walked before
    return lit;
}

template <typename Light>
std::vector<LitLeaf> find(const CellLayout& layout, const Light& light) {
    std::vector<Run> runs = aim(layout, light);
    set_planes(light, runs);
    std::vector<std::vector<LitLeaf>> found(runs.size());
    parallel_for(runs.size(), 1, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            found[run] = march_run(layout, light, runs[run]);
        }
    });
    size_t count = 0;
    for (const std::vector<LitLeaf>& run : found) {
        count += run.size();
    }
    std::vector<LitLeaf> all;
    all.reserve(count);
    for (const std::vector<LitLeaf>& run : found) {
        all.insert(all.end(), run.begin(), run.end());
    }
    return all;
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_usable(const CachedLight& l) {
    return is_finite(l.cells_from_light.basis[2]) && is_finite(l.cells_from_light.origin) &&
           std::isfinite(l.range_m) && std::isfinite(l.attenuation) && std::isfinite(l.spot_angle_deg) &&
           std::isfinite(l.spot_attenuation);
}

} // namespace

std::vector<LitLeaf> find_lit_leaves(const CellLayout& layout, const CachedLight& light) {
    if (!is_usable(light)) {
        return {};
    }
    return light.type == LightType::Directional ? find(layout, Sun(layout, light))
                                                : find(layout, Lamp(layout, light));
}

bool reach_alike(const CachedLight& a, const CachedLight& b) noexcept {
    CachedLight painted = a;
    painted.color = b.color;
    painted.energy = b.energy;
    painted.visible = b.visible;
    return painted == b;
}

} // namespace cl::gi
