#include "servers/radiosity/air_points.h"

#include "servers/radiosity/sampling.h"

#include "core/threads.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <deque>
#include <span>

namespace cl::radiosity {
namespace {

constexpr uint32_t kNoPoint = 0xFFFFFFFFu;

constexpr uint32_t rays_for(AirUse use) noexcept {
    return use == AirUse::Gaps ? 32 : 64;
}

/// Light from all around; no rays if the point lies inside a solid.
RayFan gather_from(const Transport& t, const glm::vec3& at, std::span<const glm::vec3> directions) {
    constexpr size_t kBatch = 16;
    std::array<Ray, kBatch> asked;
    RayFan fan;
    for (size_t begin = 0; begin < directions.size(); begin += kBatch) {
        const size_t count = std::min(kBatch, directions.size() - begin);
        for (size_t i = 0; i < count; ++i) {
            asked[i] = {at, directions[begin + i]};
        }
        add_rays(t.rays, t.patches, std::span(asked).first(count), fan);
        // A quarter of the rays on the backs of surfaces: inside a solid, or behind a wall that has no back.
        if (fan.back_count * 4 > directions.size()) {
            return {};
        }
    }
    return fan;
}

/// A point may lie in a solid and its brick not: other places of the brick are tried.
RayFan gather_near(const Transport& t, const CellGrid& grid, const glm::vec3& centre_cells,
                   std::span<const glm::vec3> directions) {
    static constexpr glm::vec3 kOffsets[] = {
        {0, 0, 0}, {1.2f, 1.2f, 1.2f}, {-1.2f, 1.2f, -1.2f}, {1.2f, -1.2f, -1.2f}, {-1.2f, -1.2f, 1.2f}};
    for (const glm::vec3& offset : kOffsets) {
        RayFan fan = gather_from(t, grid.world_from_cells.xform(centre_cells + offset), directions);
        if (fan.ray_count > 0) {
            return fan;
        }
    }
    return {};
}

/// AirPoints::reach of a point in the open.
std::array<float, 6> reach_from(const RayScene& rays, const CellGrid& grid, const glm::vec3& at) {
    std::array<Ray, 6> asked;
    for (int side = 0; side < 6; ++side) {
        const glm::vec3 axis = glm::normalize(grid.world_from_cells.basis[side / 2]);
        asked[size_t(side)] = {at, side % 2 == 0 ? -axis : axis, AirPoints::kMaxReach * grid.cell_m};
    }
    std::array<Hit, 6> hits;
    rays.trace(asked, hits);
    std::array<float, 6> reach{};
    for (size_t side = 0; side < 6; ++side) {
        reach[side] = hits[side].triangle == kMiss ? AirPoints::kMaxReach : hits[side].t / grid.cell_m;
    }
    return reach;
}

/// Each point without rays shows the nearest one that has some: filtering finds light on every side.
std::vector<uint32_t> spread(const Links& links, const glm::ivec3& dims) {
    std::vector<uint32_t> stand_in(links.points.size(), kNoPoint);
    std::deque<uint32_t> queue;
    for (uint32_t i = 0; i < stand_in.size(); ++i) {
        if (links.points[i].ray_count > 0) {
            stand_in[i] = i;
            queue.push_back(i);
        }
    }
    while (!queue.empty()) {
        const int at = int(queue.front());
        queue.pop_front();
        const glm::ivec3 c(at % dims.x, at / dims.x % dims.y, at / (dims.x * dims.y));
        for (int side = 0; side < 6; ++side) {
            glm::ivec3 next = c;
            next[side / 2] += side % 2 * 2 - 1;
            if (next[side / 2] < 0 || next[side / 2] >= dims[side / 2]) {
                continue;
            }
            const uint32_t n = uint32_t((next.z * dims.y + next.y) * dims.x + next.x);
            if (stand_in[n] == kNoPoint) {
                stand_in[n] = stand_in[size_t(at)];
                queue.push_back(n);
            }
        }
    }
    for (uint32_t i = 0; i < stand_in.size(); ++i) {
        stand_in[i] = stand_in[i] == kNoPoint ? i : stand_in[i];
    }
    return stand_in;
}

glm::ivec3 place_of(size_t number, const glm::ivec3& dims) noexcept {
    const int n = int(number);
    return {n % dims.x, n / dims.x % dims.y, n / (dims.x * dims.y)};
}

/// Bricks that hold patches, and those around them.
std::vector<bool> beside_surfaces(const Patches::Grid& grid, const glm::ivec3& dims) {
    const std::span<const CellIndex::Brick> bricks = grid.index.bricks();
    std::vector<bool> beside(bricks.size(), false);
    for (size_t i = 0; i < bricks.size(); ++i) {
        if ((bricks[i].low | bricks[i].high) == 0) {
            continue;
        }
        const glm::ivec3 first = glm::max(place_of(i, dims) - 1, 0);
        const glm::ivec3 last = glm::min(place_of(i, dims) + 1, dims - 1);
        for (int z = first.z; z <= last.z; ++z) {
            for (int y = first.y; y <= last.y; ++y) {
                for (int x = first.x; x <= last.x; ++x) {
                    beside[(size_t(z) * size_t(dims.y) + size_t(y)) * size_t(dims.x) + size_t(x)] = true;
                }
            }
        }
    }
    return beside;
}

AirPoints make_air_points(const Transport& t, const Patches::Grid& grid, AirUse use) {
    AirPoints air;
    air.dims = grid.cells.bricks();
    for (uint32_t i = 0; i < rays_for(use); ++i) {
        air.directions.push_back(sphere_direction(r2_point(i, glm::vec2(0.5f))));
    }
    std::vector<RayFan> fans(size_t(air.dims.x) * size_t(air.dims.y) * size_t(air.dims.z));
    const std::vector<bool> wanted =
        use == AirUse::Gaps ? beside_surfaces(grid, air.dims) : std::vector<bool>(fans.size(), true);
    air.reach.resize(fans.size());
    parallel_for(fans.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            if (!wanted[i]) {
                continue;
            }
            const glm::vec3 centre(place_of(i, air.dims) * 4 + 2);
            fans[i] = gather_near(t, grid.cells, centre, air.directions);
            if (fans[i].ray_count > 0) {
                air.reach[i] = reach_from(t.rays, grid.cells, grid.cells.world_from_cells.xform(centre));
            }
        }
    });
    for (const RayFan& f : fans) {
        append_point(air.links, f);
        air.rays.insert(air.rays.end(), f.patch_rays.begin(), f.patch_rays.end());
        air.rays.insert(air.rays.end(), f.sky_rays.begin(), f.sky_rays.end());
    }
    air.stand_in = spread(air.links, air.dims);
    return air;
}

} // namespace

std::vector<AirPoints> make_air(const Transport& transport, AirUse use, const std::atomic<bool>& stop) {
    std::vector<AirPoints> air;
    for (size_t i = 0; i < transport.probe_count && !stop; ++i) {
        air.push_back(make_air_points(transport, transport.patches.grids[i], use));
    }
    return air;
}

} // namespace cl::radiosity
