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

namespace cl::radiosity {
namespace {

/// Reorders what it is given.
float median(std::span<float> values) noexcept {
    const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// What a few rays from a point of a surface meet.
struct Outlook {
    int backs = 0;   ///< backs of surfaces
    int unclear = 0; ///< a front and a back in one place: two solids that touch, or a wall of no thickness
    float openness_m = 1e30f; ///< median of the distances
};

template <size_t kCount>
Outlook look(const RayScene& rays, const std::array<Ray, kCount>& asked, float cell_m) noexcept {
    std::array<Hit, kCount> fronts, backs;
    rays.trace_side(RayScene::Side::Front, asked, fronts);
    rays.trace_side(RayScene::Side::Back, asked, backs);
    Outlook outlook;
    std::array<float, kCount> distances_m;
    for (size_t i = 0; i < kCount; ++i) {
        const float front_m = fronts[i].triangle == kMiss ? 1e30f : fronts[i].t;
        const float back_m = backs[i].triangle == kMiss ? 1e30f : backs[i].t;
        const float nearest_m = std::min(front_m, back_m);
        const bool one_place = nearest_m < 1e30f && std::abs(front_m - back_m) < kNudge_cells * cell_m;
        outlook.unclear += one_place ? 1 : 0;
        outlook.backs += !one_place && back_m < front_m ? 1 : 0;
        distances_m[i] = nearest_m;
    }
    outlook.openness_m = median(distances_m);
    return outlook;
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
    // two solids that touch do not count.
    std::array<Ray, 24> many;
    for (uint32_t i = 0; i < many.size(); ++i) {
        many[i] = {origin, frame.direction(r2_point(i, glm::vec2(0.5f)))};
    }
    const Outlook second = look(rays, many, cell_m);
    const int clear = int(many.size()) - second.unclear;
    return clear > 0 && second.backs * 2 >= clear ? -1.0f : second.openness_m;
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
