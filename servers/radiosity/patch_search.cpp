// Which patch a point of a surface belongs to.

#include "servers/radiosity/fragments.h"
#include "servers/radiosity/patches.h"

#include <array>
#include <utility>

namespace cl::radiosity {

uint32_t Patches::find(const glm::vec3& point, const glm::vec3& facing) const noexcept {
    for (const Grid& g : grids) {
        const glm::vec3 at =
            g.cells.cells_from_world.xform(point - 2.0f * kNudge_cells * g.cells.cell_m * facing);
        if (!g.cells.contains(at)) {
            continue;
        }
        const uint32_t cell = g.index.find(glm::ivec3(glm::floor(at)));
        if (cell == CellIndex::kNone) {
            return kNoPatch;
        }
        uint32_t best = kNoPatch;
        float best_score = 0.5f; // a patch that faces elsewhere is not this surface's
        for (uint32_t p = g.first[cell]; p < g.first[cell + 1]; ++p) {
            const float apart = glm::distance(position[p], point) / g.cells.cell_m;
            const float score = 1.0f + glm::dot(normal[p], facing) - 0.3f * apart;
            if (glm::dot(normal[p], facing) > 0.3f && score > best_score) {
                best = p;
                best_score = score;
            }
        }
        return best;
    }
    return kNoPatch;
}

namespace {

constexpr float kFacesTheSameWay = 0.8f; // within 37 degrees, as the fragments of a patch do

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

} // namespace

uint32_t Patches::find_seen(const RayScene& rays, const glm::vec3& point,
                            const glm::vec3& facing) const noexcept {
    const uint32_t own = find(point, facing);
    if (own == kNoPatch) {
        return own;
    }
    const Grid& g = grids[grid[own]];
    const uint32_t cell = g.index.find(g.cells.cell_at(order[own]));
    const bool alone = g.first[cell + 1] - g.first[cell] == 1;
    if (alone || sees(rays, *this, point, facing, own)) {
        return own;
    }
    std::array<std::pair<float, uint32_t>, 6> around;
    const size_t count = nearest_around(*this, g, point, facing, around);
    for (size_t i = 0; i < count; ++i) {
        if (around[i].second != own && sees(rays, *this, point, facing, around[i].second)) {
            return around[i].second;
        }
    }
    return kNoPatch;
}

} // namespace cl::radiosity
