#include "servers/radiosity/air_points.h"

#include "servers/radiosity/sampling.h"

#include "core/threads.h"

#include <array>
#include <deque>

namespace cl::radiosity {
namespace {

constexpr uint32_t kRays = 64;
constexpr uint32_t kNoPoint = 0xFFFFFFFFu;

/// Light from all around; no rays if the point lies inside a solid.
RayFan gather_from(const StillScene& scene, const RayScene& rays, const Patches& patches, const glm::vec3& at,
                   std::span<const glm::vec3> directions) {
    std::array<Ray, kRays> asked;
    for (size_t i = 0; i < kRays; ++i) {
        asked[i] = {at, directions[i]};
    }
    RayFan fan;
    add_rays(scene, rays, patches, asked, fan);
    // A quarter of the rays on the backs of surfaces: inside a solid, or behind a wall that has no back.
    return fan.back_count * 4 > kRays ? RayFan{} : fan;
}

/// A point may lie in a solid and its brick not: other places of the brick are tried.
RayFan gather_near(const StillScene& scene, const RayScene& rays, const Patches& patches,
                   const CellGrid& grid, const glm::vec3& centre_cells,
                   std::span<const glm::vec3> directions) {
    static constexpr glm::vec3 kOffsets[] = {
        {0, 0, 0}, {1.2f, 1.2f, 1.2f}, {-1.2f, 1.2f, -1.2f}, {1.2f, -1.2f, -1.2f}, {-1.2f, -1.2f, 1.2f}};
    for (const glm::vec3& offset : kOffsets) {
        RayFan fan =
            gather_from(scene, rays, patches, grid.world_from_cells.xform(centre_cells + offset), directions);
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

/// Each point in a solid shows the nearest one that is not, so that filtering finds light on every side.
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

} // namespace

AirPoints make_air_points(const StillScene& scene, const RayScene& rays, const Patches& patches,
                          const CellGrid& grid) {
    AirPoints air;
    air.dims = grid.bricks();
    for (uint32_t i = 0; i < kRays; ++i) {
        air.directions.push_back(sphere_direction(r2_point(i, glm::vec2(0.5f))));
    }
    std::vector<RayFan> fans(size_t(air.dims.x) * size_t(air.dims.y) * size_t(air.dims.z));
    air.reach.resize(fans.size());
    parallel_for(fans.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const int n = int(i);
            const glm::ivec3 brick(n % air.dims.x, n / air.dims.x % air.dims.y,
                                   n / (air.dims.x * air.dims.y));
            const glm::vec3 centre(brick * 4 + 2);
            fans[i] = gather_near(scene, rays, patches, grid, centre, air.directions);
            if (fans[i].ray_count > 0) {
                air.reach[i] = reach_from(rays, grid, grid.world_from_cells.xform(centre));
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

} // namespace cl::radiosity
