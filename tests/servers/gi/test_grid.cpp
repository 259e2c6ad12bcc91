#include "servers/gi/probe_data.h"

#include <doctest/doctest.h>

#include <limits>
#include <random>

namespace {

using namespace cl;

std::string error_of(const glm::vec3& extents_m, int subdivision) {
    const Expected<gi::Grid> grid = gi::compute_grid(extents_m, subdivision);
    return grid ? "no error" : grid.error().message;
}

TEST_SUITE("servers/gi/grid") {
    TEST_CASE("the specification's examples come out of its rules") {
        const Expected<gi::Grid> tall = gi::compute_grid({3.0f, 1.4f, 1.7f}, 64);
        REQUIRE(tall.has_value());
        CHECK(tall->dims == glm::ivec3(64, 32, 64));
        CHECK(tall->cell_size_m == 0.09375f);
        CHECK(tall->levels == 7);
        CHECK(tall->box == AABB{glm::vec3(-3.0f, -1.4f, -1.7f), glm::vec3(6.0f, 2.8f, 3.4f)});
        CHECK(tall->cubic_box == AABB{glm::vec3(-3.0f, -1.4f, -1.7f), glm::vec3(6.0f)});

        const Expected<gi::Grid> cube = gi::compute_grid(glm::vec3(2.5f), 128);
        REQUIRE(cube.has_value());
        CHECK(cube->levels == 8);
        CHECK(cube->cells_from_local.basis[0].x == 25.6f);
        CHECK(cube->cells_from_local.origin == glm::vec3(64.0f));
    }

    TEST_CASE("levels follow from the subdivision") {
        CHECK(gi::compute_grid(glm::vec3(1.0f), 64)->levels == 7);
        CHECK(gi::compute_grid(glm::vec3(1.0f), 128)->levels == 8);
        CHECK(gi::compute_grid(glm::vec3(1.0f), 256)->levels == 9);
        CHECK(gi::compute_grid(glm::vec3(1.0f), 512)->levels == 10);
    }

    TEST_CASE("each axis is covered by the fewest power-of-two cells") {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> extent(0.3f, 10.0f);
        for (int i = 0; i < 200; ++i) {
            const glm::vec3 extents(extent(random), extent(random), extent(random));
            CAPTURE(extents.x);
            CAPTURE(extents.y);
            CAPTURE(extents.z);
            const Expected<gi::Grid> grid = gi::compute_grid(extents, 128);
            REQUIRE(grid.has_value());
            const float longest = 2.0f * std::max(extents.x, std::max(extents.y, extents.z));
            for (int a = 0; a < 3; ++a) {
                const float covered = float(grid->dims[a]) * longest / 128.0f;
                CHECK(covered >= 2.0f * extents[a]);
                CHECK(0.5f * covered < 2.0f * extents[a]);
                CHECK((grid->dims[a] & (grid->dims[a] - 1)) == 0);
            }
        }
    }

    TEST_CASE("the box's corners map to the corners of the grid") {
        const Expected<gi::Grid> grid = gi::compute_grid({4.0f, 2.0f, 1.0f}, 256);
        REQUIRE(grid.has_value());
        CHECK(grid->dims == glm::ivec3(256, 128, 64));
        CHECK(grid->cells_from_local.xform(grid->box.position) == glm::vec3(0.0f));
        CHECK(grid->cells_from_local.xform(grid->box.end()) == glm::vec3(256.0f, 128.0f, 64.0f));
    }

    TEST_CASE("extents that hang Godot or leave an axis without cells are refused") {
        CHECK(error_of({1.0f, 0.0f, 1.0f}, 64) == "extents: expected y in 1e-6 to 1e9, found 0");
        CHECK(error_of({-2.0f, 1.0f, 1.0f}, 64) == "extents: expected x in 1e-6 to 1e9, found -2");
        const float infinity = std::numeric_limits<float>::infinity();
        CHECK(error_of({1.0f, 1.0f, infinity}, 64) == "extents: expected z in 1e-6 to 1e9, found inf");
        CHECK(error_of({1.0f, 1.0f, std::numeric_limits<float>::quiet_NaN()}, 64) ==
              "extents: expected z in 1e-6 to 1e9, found nan");
        CHECK(error_of({10.0f, 0.05f, 10.0f}, 64) ==
              "extents: expected y above 1/128 of the longest extent 10, found 0.05");
        CHECK(error_of({10.0f, 0.08f, 10.0f}, 64) == "no error");
        CHECK(error_of(glm::vec3(1.0f), 100) == "subdivision: expected 64, 128, 256 or 512, found 100");
    }
}

} // namespace
