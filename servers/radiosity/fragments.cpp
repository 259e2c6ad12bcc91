#include "servers/radiosity/fragments.h"

#include "core/threads.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>

namespace cl::radiosity {
namespace {

constexpr float kLeastArea_cells = 1e-5f;

bool is_inside_finer(std::span<const CellGrid> finer, const glm::vec3& world) noexcept {
    return std::any_of(finer.begin(), finer.end(),
                       [&](const CellGrid& g) { return g.contains(g.cells_from_world.xform(world)); });
}

/// The triangle in cells, moved behind its face by a hair.
Polygon in_cells(const StillScene& scene, uint32_t triangle, const CellGrid& grid,
                 const glm::vec3& facing) noexcept {
    Polygon p;
    const glm::vec3 shift = -kNudge_cells * grid.cell_m * facing;
    for (int i = 0; i < 3; ++i) {
        p.add(grid.cells_from_world.xform(scene.positions[scene.triangles[triangle][i]] + shift));
    }
    return p;
}

/// Fragments of a range of triangles in one grid.
void cut(const StillScene& scene, std::span<const CellGrid> grids, size_t probe_count, size_t grid_index,
         size_t begin, size_t end, std::vector<Fragment>& out) {
    const CellGrid& grid = grids[grid_index];
    const std::span<const CellGrid> finer = grids.first(grid_index < probe_count ? 0 : grid_index);
    for (size_t t = begin; t < end; ++t) {
        const uint32_t triangle = uint32_t(t);
        const int sides = scene.surfaces[scene.surface_of[t]].two_sided ? 2 : 1;
        for (int side = 0; side < sides; ++side) {
            const glm::vec3 facing = side == 1 ? -scene.normal(triangle) : scene.normal(triangle);
            const Polygon whole = in_cells(scene, triangle, grid, facing);
            for_each_cell_piece(whole, grid.dims, [&](const glm::ivec3& cell, const Polygon& piece) {
                glm::vec3 centroid;
                const float area = piece.area_and_centroid(centroid);
                const glm::vec3 world =
                    grid.world_from_cells.xform(centroid) + kNudge_cells * grid.cell_m * facing;
                if (area > kLeastArea_cells && !is_inside_finer(finer, world)) {
                    out.push_back({grid.order(cell), triangle, area, world, uint8_t(grid_index), side == 1});
                }
            });
        }
    }
}

} // namespace

std::vector<Fragment> cut_fragments(const StillScene& scene, std::span<const CellGrid> grids,
                                    size_t probe_count) {
    // Few triangles are often large ones.
    const size_t grain = std::clamp<size_t>(scene.triangles.size() / 64, 1, 256);
    const size_t chunks = (scene.triangles.size() + grain - 1) / grain;
    std::vector<std::vector<Fragment>> parts(chunks * grids.size());
    parallel_for(parts.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const size_t first = i % chunks * grain;
            cut(scene, grids, probe_count, i / chunks, first, std::min(first + grain, scene.triangles.size()),
                parts[i]);
        }
    });
    std::vector<Fragment> all;
    for (std::vector<Fragment>& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
        part = {}; // a large scene has hundreds of megabytes of them
    }
    tbb::parallel_sort(all.begin(), all.end(), [](const Fragment& a, const Fragment& b) {
        return std::tie(a.grid, a.order, a.triangle, a.back) < std::tie(b.grid, b.order, b.triangle, b.back);
    });
    return all;
}

/// Where each cell's run of fragments begins, and the end.
std::vector<size_t> cell_starts(std::span<const Fragment> all) {
    std::vector<size_t> starts;
    for (size_t i = 0; i < all.size(); ++i) {
        if (i == 0 || all[i].order != all[i - 1].order || all[i].grid != all[i - 1].grid) {
            starts.push_back(i);
        }
    }
    starts.push_back(all.size());
    return starts;
}

glm::vec3 facing_of(const StillScene& scene, const Fragment& f) noexcept {
    return f.back ? -scene.normal(f.triangle) : scene.normal(f.triangle);
}

Polygon outline(const StillScene& scene, const CellGrid& grid, const Fragment& f) noexcept {
    Polygon piece = in_cells(scene, f.triangle, grid, facing_of(scene, f));
    const glm::ivec3 cell = grid.cell_at(f.order);
    for (int axis = 0; axis < 3; ++axis) {
        piece = clip(clip(piece, axis, float(cell[axis]), 1.0f), axis, float(cell[axis] + 1), -1.0f);
    }
    return piece;
}

glm::vec2 barycentric(const StillScene& scene, const Fragment& f) noexcept {
    const glm::uvec3 t = scene.triangles[f.triangle];
    const glm::vec3 a = scene.positions[t.x], e1 = scene.positions[t.y] - a, e2 = scene.positions[t.z] - a;
    const glm::vec3 d = f.centroid - a;
    const float d11 = glm::dot(e1, e1), d12 = glm::dot(e1, e2), d22 = glm::dot(e2, e2);
    const float det = d11 * d22 - d12 * d12;
    if (!(det > 0.0f)) {
        return glm::vec2(0.0f);
    }
    const float p1 = glm::dot(d, e1), p2 = glm::dot(d, e2);
    return glm::clamp(glm::vec2((d22 * p1 - d12 * p2) / det, (d11 * p2 - d12 * p1) / det), 0.0f, 1.0f);
}

} // namespace cl::radiosity
