#include "servers/gi/octree_builder.h"
#include "servers/gi/small_triangles.h"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <vector>

using namespace cl::gi;

namespace {

/// Leaves below a cell by the full test of each child; nothing if a cell is touched and none of its children.
std::optional<std::set<uint32_t>> descend(const Grid& grid, const CellBox& cell, uint32_t number,
                                          const glm::vec3 (&v)[3]) {
    if (cell.level == grid.levels - 1) {
        return std::set<uint32_t>{number};
    }
    const uint32_t touched = touched_octants(octants_of(grid, cell), v, CenterTest{});
    std::set<uint32_t> leaves;
    for (int slot = 0; slot < 8; ++slot) {
        if (((touched >> slot) & 1u) != 0u) {
            const auto below = descend(grid, child_cell(grid, cell, slot), number * 8 + uint32_t(slot), v);
            if (!below) {
                return std::nullopt;
            }
            leaves.insert(below->begin(), below->end());
        }
    }
    return leaves.empty() ? std::nullopt : std::optional(leaves);
}

class SmallTriangleMaker {
public:
    explicit SmallTriangleMaker(const Grid& grid) : grid_(grid) {}

    /// @param kind  0: any; 1: corners on the borders of cells; 2: slivers; 3: points; 4: flat along an axis
    void make(int kind, glm::vec3 (&v)[3]) {
        const float size_m = grid_.cell_size_m;
        const glm::vec3 half = grid_.box.size * 0.5f;
        const glm::vec3 at = point(1.1f) * half;
        const float reach = std::abs(number(1.0f)) * size_m;
        for (glm::vec3& vertex : v) {
            vertex = at + point(1.0f) * reach;
            if (kind == 1) {
                vertex = round(vertex / size_m) * size_m;
            }
        }
        if (kind == 2) {
            v[2] = (v[0] + v[1]) * 0.5f + point(1e-5f) * size_m;
        } else if (kind == 3) {
            v[1] = v[2] = v[0];
        } else if (kind == 4) {
            const int axis = int(std::abs(number(2.999f)));
            v[1][axis] = v[2][axis] = v[0][axis];
        }
    }

private:
    static glm::vec3 round(const glm::vec3& p) { return {std::round(p.x), std::round(p.y), std::round(p.z)}; }
    float number(float range) { return std::uniform_real_distribution<float>(-range, range)(random_); }
    glm::vec3 point(float range) { return {number(range), number(range), number(range)}; }

    const Grid& grid_;
    std::mt19937 random_{31};
};

} // namespace

TEST_SUITE("servers/gi/small_triangles") {
    TEST_CASE("small triangles touch the leaves that descending with the full test finds") {
        const glm::vec3 boxes[] = {
            {1.0f, 1.0f, 1.0f}, {7.3f, 3.1f, 0.9f}, {100.0f, 30.0f, 60.0f}, {3e-6f, 3e-6f, 2e-6f}};
        int found = 0, several = 0;
        for (const glm::vec3& extents_m : boxes) {
            for (const int cells : {64, 512}) {
                const Grid grid = *compute_grid(extents_m, cells);
                const SmallTriangles small(grid);
                SmallTriangleMaker maker(grid);
                for (int i = 0; i < 8'000; ++i) {
                    glm::vec3 v[3];
                    maker.make(i % 5, v);
                    CAPTURE(i);
                    CAPTURE(cells);
                    SmallTriangles::Leaves leaves;
                    if (small.find_leaves(v, leaves)) {
                        const auto expected = descend(grid, root_cell(grid), 0, v);
                        REQUIRE(expected.has_value());
                        REQUIRE(std::vector<uint32_t>(leaves.begin(), leaves.end()) ==
                                std::vector<uint32_t>(expected->begin(), expected->end()));
                        ++found;
                        several += expected->size() > 1;
                    }
                }
            }
        }
        CHECK(found > 40'000);
        CHECK(several > 15'000);
    }

    TEST_CASE("a triangle of more than two cells is not small") {
        const Grid grid = *compute_grid(glm::vec3(1.0f), 64);
        const glm::vec3 v[3] = {{0, 0, 0}, {2.1f * grid.cell_size_m, 0, 0}, {0, 0.01f, 0}};
        SmallTriangles::Leaves leaves;
        CHECK_FALSE(SmallTriangles(grid).find_leaves(v, leaves));
    }

    TEST_CASE("a box deep in a cell lies in that cell, and one across the middle in none but the root") {
        const Grid grid = *compute_grid(glm::vec3(1.0f), 64);
        const CellIntervals intervals(grid);
        const float size_m = grid.cell_size_m;
        const auto cells_from_corner = [&](float n) {
            const float at_m = n * size_m - 1.0f;
            return float4{at_m, at_m, at_m, 0.0f};
        };
        const CellPlace leaf = intervals.cell_around(cells_from_corner(0.25f), cells_from_corner(0.75f));
        CHECK(leaf.level == grid.levels - 1);
        CHECK(leaf.number == 0);
        const CellPlace eight = intervals.cell_around(cells_from_corner(0.25f), cells_from_corner(1.75f));
        CHECK(eight.level == grid.levels - 2);
        CHECK(eight.number == 0);
        CHECK(intervals.cell_around(cells_from_corner(31.9f), cells_from_corner(32.1f)).level == 0);
        CHECK(intervals.cell_around(cells_from_corner(70.0f), cells_from_corner(70.1f)).level == 0);
    }
}
