#include "servers/gi/voxelizer.h"

#include "servers/gi/brick_bake.h"

#include <utility>

namespace cl::gi {

Expected<BakedOctree> voxelize(const Grid& grid, std::span<const PlotSurface> surfaces,
                               const BakeProgress& progress, const BakeLimits& limits) {
    return run_bake(progress, [&]() -> Expected<BakedOctree> {
        const Expected<PlotTriangles> triangles = collect_triangles(surfaces, grid);
        if (!triangles) {
            return triangles.error();
        }
        const TopCells top(grid, *triangles);
        Expected<BakedBricks> baked = BrickBake(grid, limits, progress).run(surfaces, *triangles, top);
        return baked ? Expected<BakedOctree>(std::move(baked->octree)) : baked.error();
    });
}

bool triangle_overlaps_box(const glm::vec3& center, const glm::vec3& half, const glm::vec3& a,
                           const glm::vec3& b, const glm::vec3& c) noexcept {
    const Boxes<float> box{{center.x, center.y, center.z}, {half.x, half.y, half.z}};
    const glm::vec3 vertices[3] = {a, b, c};
    return !separated(box, vertices);
}

} // namespace cl::gi
