// Which patch a point of a surface belongs to.

#include "servers/radiosity/fragments.h"
#include "servers/radiosity/patches.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace cl::radiosity {

namespace {

constexpr float kLeastFacing = 0.3f;
constexpr float kFacesTheSameWay = 0.8f; // within 37 degrees, as the fragments of a patch do

/// The patch of a cell that a point belongs to. A patch that faces elsewhere is not the point's surface.
uint32_t best_of_cell(const Patches& patches, const Patches::Grid& grid, uint32_t cell,
                      const glm::vec3& point, const glm::vec3& facing) noexcept {
    uint32_t best = kNoPatch;
    float best_score = 0.5f;
    for (uint32_t p = grid.first[cell]; p < grid.first[cell + 1]; ++p) {
        const float turned = glm::dot(patches.normal[p], facing);
        const float apart = glm::distance(patches.position[p], point) / grid.cells.cell_m;
        const float score = 1.0f + turned - 0.3f * apart;
        if (turned > kLeastFacing && score > best_score) {
            best = p;
            best_score = score;
        }
    }
    return best;
}

struct Found {
    uint32_t patch = kNoPatch;
    const Patches::Grid* grid = nullptr; ///< the first that the point lies in
    bool alone = false;                  ///< in its cell
};

/// Where to look for a point's patch.
struct Place {
    const Patches::Grid* grid = nullptr; ///< the first that the point lies in
    glm::ivec3 cell{0};
};

Place place_of(const Patches& patches, const glm::vec3& point, const glm::vec3& facing) noexcept {
    for (const Patches::Grid& g : patches.grids) {
        const glm::vec3 at =
            g.cells.cells_from_world.xform(point - 2.0f * kNudge_cells * g.cells.cell_m * facing);
        if (g.cells.contains(at)) {
            return {&g, glm::ivec3(at)}; // no less than 0
        }
    }
    return {};
}

/// @param cell  its number
Found search_cell(const Patches& patches, const Patches::Grid& g, uint32_t cell, const glm::vec3& point,
                  const glm::vec3& facing) noexcept {
    if (cell == CellIndex::kNone) {
        return {kNoPatch, &g, false};
    }
    const Patches::Grid::Sought& sought = g.sought[cell];
    if (sought.normal == 0) {
        return {best_of_cell(patches, g, cell, point, facing), &g, false};
    }
    const glm::vec3 normal(glm::unpackSnorm3x10_1x2(sought.normal));
    return {glm::dot(normal, facing) > kLeastFacing ? sought.first : kNoPatch, &g, true};
}

bool sees(const RayScene& rays, const Patches& patches, const glm::vec3& point, const glm::vec3& facing,
          uint32_t patch) noexcept {
    const float cell_m = patches.grids[patches.grid[patch]].cells.cell_m;
    const float lift_m = 2.0f * kLift * cell_m + 0.12f * glm::distance(point, patches.position[patch]);
    return !rays.is_blocked(point + lift_m * facing,
                            patches.position[patch] + lift_m * patches.normal[patch]);
}

/// The nearest patches about a point that face its way, at most as many as there is room for.
/// @return how many
size_t nearest_around(const Patches& patches, const Patches::Grid& grid, const glm::vec3& point,
                      const glm::vec3& facing, std::span<std::pair<float, uint32_t>> out) noexcept {
    const glm::ivec3 home(glm::floor(grid.cells.cells_from_world.xform(point)));
    size_t count = 0;
    for (int i = 0; i < 27; ++i) {
        const uint32_t cell = grid.index.find(home + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
        if (cell == CellIndex::kNone) {
            continue;
        }
        for (uint32_t p = grid.first[cell]; p < grid.first[cell + 1]; ++p) {
            if (glm::dot(patches.normal[p], facing) < kFacesTheSameWay) {
                continue;
            }
            std::pair<float, uint32_t> found{glm::distance(patches.position[p], point), p};
            for (size_t k = 0; k < out.size(); ++k) { // insertion into a short sorted list
                if (k == count) {
                    out[count++] = found;
                    break;
                }
                if (found < out[k]) {
                    std::swap(found, out[k]);
                }
            }
        }
    }
    return count;
}

/// The patch that was found, or one near it, if the point sees it.
uint32_t seen_patch(const RayScene& rays, const Patches& patches, const Found& own, const glm::vec3& point,
                    const glm::vec3& facing) noexcept {
    if (own.patch == kNoPatch || own.alone || sees(rays, patches, point, facing, own.patch)) {
        return own.patch;
    }
    std::array<std::pair<float, uint32_t>, 6> around;
    const size_t count = nearest_around(patches, *own.grid, point, facing, around);
    for (size_t i = 0; i < count; ++i) {
        if (around[i].second != own.patch && sees(rays, patches, point, facing, around[i].second)) {
            return around[i].second;
        }
    }
    return kNoPatch;
}

} // namespace

uint32_t Patches::find(const glm::vec3& point, const glm::vec3& facing) const noexcept {
    const Place place = place_of(*this, point, facing);
    return place.grid
               ? search_cell(*this, *place.grid, place.grid->index.find(place.cell), point, facing).patch
               : kNoPatch;
}

void Patches::find_seen(const RayScene& rays, std::span<const SurfacePoint> points,
                        std::span<uint32_t> found) const noexcept {
    // Points jump about: in three rounds, each of which has the memory fetched that the next one reads.
    constexpr size_t kRound = 32;
    std::array<Place, kRound> places;
    std::array<uint32_t, kRound> cells;
    for (size_t begin = 0; begin < points.size(); begin += kRound) {
        const std::span<const SurfacePoint> some =
            points.subspan(begin, std::min(kRound, points.size() - begin));
        for (size_t i = 0; i < some.size(); ++i) {
            places[i] = place_of(*this, some[i].position, some[i].facing);
            if (places[i].grid) {
                places[i].grid->index.prefetch(places[i].cell);
            }
        }
        for (size_t i = 0; i < some.size(); ++i) {
            cells[i] = places[i].grid ? places[i].grid->index.find(places[i].cell) : CellIndex::kNone;
            if (cells[i] != CellIndex::kNone) {
                __builtin_prefetch(&places[i].grid->sought[cells[i]]);
            }
        }
        for (size_t i = 0; i < some.size(); ++i) {
            const glm::vec3 &point = some[i].position, &facing = some[i].facing;
            found[begin + i] =
                cells[i] == CellIndex::kNone
                    ? kNoPatch
                    : seen_patch(rays, *this, search_cell(*this, *places[i].grid, cells[i], point, facing),
                                 point, facing);
        }
    }
}

} // namespace cl::radiosity
