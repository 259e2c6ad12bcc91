#include "servers/radiosity/openness.h"

#include "servers/radiosity/fragments.h"
#include "servers/radiosity/patches.h"
#include "servers/radiosity/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace cl::radiosity {
namespace {

/// Reorders what it is given.
float median(std::span<float> values) noexcept {
    const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

constexpr size_t kMany = 24, kHalf = kMany / 2;

/// What rays from a point of a surface met so far.
struct Outlook {
    size_t backs = 0;   ///< backs of surfaces
    size_t unclear = 0; ///< a front and a back in one place: two solids that touch, or a wall of no thickness
    std::vector<float> distances_m;

    /// True if most of `kMany` rays will have met backs, whatever the rest of them meet. Unclear ones do not
    /// count.
    [[nodiscard]] bool is_inside() const noexcept { return 2 * backs + unclear >= kMany && backs > 0; }
};

/// Which of some hits have a surface that shows its other side in the same place.
std::array<bool, kHalf> are_doubled(const RayScene& rays, std::span<const Ray> asked,
                                    std::span<const Hit> hits, float cell_m) noexcept {
    std::array<bool, kHalf> doubled{};
    for (const RayScene::Side other : {RayScene::Side::Front, RayScene::Side::Back}) {
        std::array<Ray, kHalf> shorter;
        std::array<size_t, kHalf> which{};
        size_t count = 0;
        for (size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].triangle != kMiss && hits[i].is_front != (other == RayScene::Side::Front)) {
                which[count] = i;
                shorter[count] = asked[i];
                shorter[count++].max_t = hits[i].t + kNudge_cells * cell_m;
            }
        }
        std::array<Hit, kHalf> met;
        rays.trace_side(other, std::span(shorter).first(count), std::span(met).first(count));
        for (size_t i = 0; i < count; ++i) {
            doubled[which[i]] = met[i].triangle != kMiss;
        }
    }
    return doubled;
}

void look(const RayScene& rays, std::span<const Ray> asked, float cell_m, Outlook& outlook) noexcept {
    std::array<Hit, kHalf> hits;
    rays.trace(asked, std::span(hits).first(asked.size()));
    const std::array<bool, kHalf> doubled =
        are_doubled(rays, asked, std::span(hits).first(asked.size()), cell_m);
    for (size_t i = 0; i < asked.size(); ++i) {
        const bool missed = hits[i].triangle == kMiss;
        outlook.unclear += doubled[i] ? 1 : 0;
        outlook.backs += !missed && !hits[i].is_front && !doubled[i] ? 1 : 0;
        outlook.distances_m.push_back(missed ? 1e30f : hits[i].t);
    }
}

/// The median of the distances to what some rays meet, if all of it shows its front.
template <size_t kCount>
std::optional<float> open_on_all_sides(const RayScene& rays, const std::array<Ray, kCount>& asked) noexcept {
    std::array<Hit, kCount> hits;
    rays.trace(asked, hits);
    std::array<float, kCount> distances_m;
    for (size_t i = 0; i < kCount; ++i) {
        const bool missed = hits[i].triangle == kMiss;
        if (!missed && !hits[i].is_front) {
            return std::nullopt;
        }
        distances_m[i] = missed ? 1e30f : hits[i].t;
    }
    return median(distances_m);
}

} // namespace

glm::vec3 lifted(const glm::vec3& point, const glm::vec3& normal, float cell_m) noexcept {
    return point + kLift * cell_m * normal;
}

float openness(const RayScene& rays, const glm::vec3& point, const glm::vec3& normal, float cell_m) noexcept {
    const CosineFrame frame(normal);
    const glm::vec3 origin = lifted(point, normal, cell_m);
    std::array<Ray, 5> few;
    for (size_t i = 0; i < few.size(); ++i) {
        const glm::vec2 u = i == 0 ? glm::vec2(0.0f) : glm::vec2(0.64f, 0.25f * float(i) - 0.125f);
        few[i] = {origin, frame.direction(u)};
    }
    if (const std::optional<float> open_m = open_on_all_sides(rays, few)) {
        return *open_m;
    }
    // A few rays settle it where none meets a back; more are asked otherwise, and those that meet faces of
    // two solids that touch do not count. Half of them do where all meet backs.
    Outlook outlook;
    for (size_t begin = 0; begin < kMany; begin += kHalf) {
        std::array<Ray, kHalf> some;
        for (size_t i = 0; i < kHalf; ++i) {
            some[i] = {origin, frame.direction(r2_point(uint32_t(begin + i), glm::vec2(0.5f)))};
        }
        look(rays, some, cell_m, outlook);
        if (outlook.is_inside()) {
            return outlook.backs + outlook.unclear == begin + kHalf ? kBuried : kInside;
        }
    }
    return median(outlook.distances_m);
}

std::vector<float> openness_of_all(const RayScene& rays, std::span<const glm::vec3> points,
                                   const glm::vec3& normal, float cell_m, std::optional<glm::vec3> buried) {
    std::vector<float> open_m;
    for (const glm::vec3& p : points) {
        const bool sees_buried =
            buried && !rays.is_blocked(lifted(*buried, normal, cell_m), lifted(p, normal, cell_m));
        open_m.push_back(sees_buried ? kBuried : openness(rays, p, normal, cell_m));
        if (open_m.back() == kBuried) {
            buried = p;
        }
    }
    return open_m;
}

std::vector<size_t> spaces(const RayScene& rays, std::span<const glm::vec3> points, const glm::vec3& normal,
                           float cell_m) {
    constexpr size_t kUnreached = std::numeric_limits<size_t>::max();
    std::vector<size_t> space(points.size(), kUnreached);
    std::vector<size_t> reached;
    for (size_t start = 0; start < points.size(); ++start) {
        if (space[start] != kUnreached) {
            continue;
        }
        space[start] = start;
        reached.assign(1, start);
        for (size_t next = 0; next < reached.size(); ++next) {
            const glm::vec3 from = lifted(points[reached[next]], normal, cell_m);
            for (size_t j = 0; j < points.size(); ++j) {
                if (space[j] == kUnreached && !rays.is_blocked(from, lifted(points[j], normal, cell_m))) {
                    space[j] = start;
                    reached.push_back(j);
                }
            }
        }
    }
    return space;
}

} // namespace cl::radiosity
