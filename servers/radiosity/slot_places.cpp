#include "servers/radiosity/slot_places.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cl::radiosity {
namespace {

constexpr float kOneFacing = 0.8f;      // cosine between patches that normals do not tell apart
constexpr float kOneSurface = 0.9f;     // cosine between patches of one surface ...
constexpr float kOneLayer_cells = 0.1f; // ... and the step between them

/// The line in which a wall meets the surface it stands on, in the middle of the wall; in cells.
struct Border {
    glm::vec3 middle, across; ///< across: unit length, on the surface, towards the first patch
    glm::vec3 normal{0.0f};   ///< of the surface
};

/// Where the wall between two points begins, seen from the first; and its normal there.
std::optional<Border> face_between(const RayScene& rays, const StillScene& scene, const glm::vec3& from,
                                   const glm::vec3& to) {
    const Ray ray{from, glm::normalize(to - from), glm::distance(from, to)};
    Hit hit;
    rays.trace({&ray, 1}, {&hit, 1});
    if (hit.triangle == kMiss) {
        return std::nullopt;
    }
    glm::vec3 normal = scene.normal(hit.triangle);
    normal *= glm::dot(normal, ray.direction) > 0.0f ? -1.0f : 1.0f;
    return Border{from + hit.t * ray.direction, normal};
}

std::optional<Border> border_of(const RayScene& rays, const StillScene& scene, const Patches& patches,
                                uint32_t a, uint32_t b) {
    const glm::vec3 na = patches.normal[a], nb = patches.normal[b];
    const CellGrid& grid = patches.grids[patches.grid[a]].cells;
    const glm::vec3 apart = patches.position[b] - patches.position[a];
    if (glm::dot(na, nb) < kOneSurface || std::abs(glm::dot(na, apart)) > kOneLayer_cells * grid.cell_m) {
        return std::nullopt;
    }
    const float lift_m = 2.0f * kLift * grid.cell_m;
    const glm::vec3 from = patches.position[a] + lift_m * na, to = patches.position[b] + lift_m * nb;
    const std::optional<Border> near = face_between(rays, scene, from, to),
                                far = face_between(rays, scene, to, from);
    if (!near || !far) {
        return std::nullopt;
    }
    const glm::vec3 across = near->across - na * glm::dot(na, near->across);
    if (glm::length(across) < 0.5f) {
        return std::nullopt; // no wall: something that hangs low
    }
    const glm::vec3 origin(grid.cell_at(patches.order[a]));
    return Border{grid.cells_from_world.xform(0.5f * (near->middle + far->middle)) - origin,
                  glm::normalize(grid.cells_from_world.basis * across),
                  glm::normalize(grid.cells_from_world.basis * na)};
}

constexpr int kPlaces = kPlaceSteps * kPlaceSteps * kPlaceSteps;

glm::vec3 place(int i) noexcept {
    const glm::ivec3 step(i % kPlaceSteps, i / kPlaceSteps % kPlaceSteps, i / (kPlaceSteps * kPlaceSteps));
    return (glm::vec3(step) + 0.5f) / float(kPlaceSteps);
}

glm::vec3 rounded(const glm::vec3& place) noexcept {
    const float steps = float(kPlaceSteps);
    return (glm::floor(glm::clamp(place * steps, 0.0f, steps - 1.0f)) + 0.5f) / steps;
}

glm::vec3 facing_in_cell(const Patches& patches, uint32_t patch) noexcept {
    const CellGrid& grid = patches.grids[patches.grid[patch]].cells;
    return 0.5f + 0.5f * glm::normalize(grid.cells_from_world.basis * patches.normal[patch]);
}

/// field_distance() of shaders/lib/gi_field.glsl.
float misfit(const glm::vec3& apart, const glm::vec3& normal) noexcept {
    const float rise = glm::dot(apart, normal);
    return glm::dot(apart, apart) + 8.0f * rise * rise;
}

/// How far the points that fit one place as well as the other lie off a border, at most [cells].
float error_of(const Border& border, const glm::vec3& a, const glm::vec3& b) noexcept {
    const glm::vec3 along = glm::cross(border.normal, border.across);
    const float slope = std::max(2.0f * std::abs(glm::dot(a - b, border.across)), 1e-3f);
    float worst = 0.0f;
    for (float t : {-0.5f, 0.0f, 0.5f}) {
        const glm::vec3 at = border.middle + t * along;
        worst =
            std::max(worst, std::abs(misfit(at - b, border.normal) - misfit(at - a, border.normal)) / slope);
    }
    return worst;
}

} // namespace

glm::vec3 place_in_cell(const Patches& patches, uint32_t patch) noexcept {
    const CellGrid& grid = patches.grids[patches.grid[patch]].cells;
    return grid.cells_from_world.xform(patches.position[patch]) -
           glm::vec3(grid.cell_at(patches.order[patch]));
}

SlotPlaces slot_places(const RayScene& rays, const StillScene& scene, const Patches& patches, uint32_t a,
                       uint32_t b) {
    if (glm::dot(patches.normal[a], patches.normal[b]) < kOneFacing) {
        return {SlotTest::Normal, {facing_in_cell(patches, a), facing_in_cell(patches, b)}};
    }
    SlotPlaces best{SlotTest::Place, {place_in_cell(patches, a), place_in_cell(patches, b)}};
    const std::optional<Border> border = border_of(rays, scene, patches, a, b);
    if (!border) {
        return best;
    }
    float least = 1e30f;
    for (int i = 0; i < kPlaces; ++i) {
        const glm::vec3 one = place(i);
        const float side = glm::dot(one - border->middle, border->across);
        const glm::vec3 other = rounded(one - 2.0f * side * border->across);
        if (side <= 0.0f || one == other) {
            continue;
        }
        const float error = error_of(*border, one, other);
        if (error < least) {
            least = error;
            best.at = {one, other};
        }
    }
    return best;
}

} // namespace cl::radiosity
