#include "servers/gi/probe_data.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <functional>
#include <limits>
#include <random>
#include <string>

namespace {

using namespace cl;

std::string error_of(const glm::vec3& extents_m, int subdivision) {
    const Expected<gi::Grid> grid = gi::compute_grid(extents_m, subdivision);
    return grid ? "no error" : grid.error().message;
}

float six_digits_of(float v) {
    return std::stof(fmt::format("{:.6g}", v));
}

glm::vec3 six_digits_of(const glm::vec3& v) {
    return {six_digits_of(v.x), six_digits_of(v.y), six_digits_of(v.z)};
}

/// What is left of a bake's numbers in a text resource of Godot's.
gi::ProbeData six_digits_of(const gi::Grid& grid) {
    const Transform& t = grid.cells_from_local;
    gi::ProbeData data;
    data.bounds = {six_digits_of(grid.box.position), six_digits_of(grid.box.size)};
    data.cell_size_m = six_digits_of(grid.cell_size_m);
    data.cells_from_local.origin = six_digits_of(t.origin);
    for (int i = 0; i < 3; ++i) {
        data.cells_from_local.basis[i] = six_digits_of(t.basis[i]);
    }
    return data;
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

    TEST_CASE("a grid whose numbers were saved with six digits gets the others back") {
        std::mt19937 random(5);
        std::uniform_int_distribution<int> centimetres(30, 2000);
        const auto extent = [&] { return float(centimetres(random)) / 100.0f; };
        for (int i = 0; i < 200; ++i) {
            const glm::vec3 extents(extent(), extent(), extent());
            CAPTURE(extents.x);
            CAPTURE(extents.y);
            CAPTURE(extents.z);
            const Expected<gi::Grid> grid = gi::compute_grid(extents, 256);
            REQUIRE(grid.has_value());
            const gi::GridScale scale = gi::grid_scale(six_digits_of(*grid), grid->levels);
            CHECK(scale.cell_size_m == grid->cell_size_m);
            CHECK(scale.cells_from_local == grid->cells_from_local);
        }
    }

    TEST_CASE("a grid that is not the one of its box stays as it was saved") {
        const Expected<gi::Grid> grid = gi::compute_grid({4.5f, 1.1f, 1.8f}, 128);
        REQUIRE(grid.has_value());
        const auto stays = [&](const std::function<void(gi::ProbeData&)>& change) {
            gi::ProbeData data = six_digits_of(*grid);
            change(data);
            const gi::GridScale scale = gi::grid_scale(data, grid->levels);
            return scale.cell_size_m == data.cell_size_m && scale.cells_from_local == data.cells_from_local;
        };
        CHECK(!stays([](gi::ProbeData&) {}));
        CHECK(stays([](gi::ProbeData& d) { d.cells_from_local.origin.x += 0.001f; }));
        CHECK(stays([](gi::ProbeData& d) { d.cells_from_local.basis[1].x = 0.001f; }));
        CHECK(stays([](gi::ProbeData& d) { d.cell_size_m *= 1.0001f; }));
        CHECK(stays([](gi::ProbeData& d) { d.bounds.size = glm::vec3(0.0f); }));
        CHECK(stays([](gi::ProbeData& d) { d.bounds.size = glm::vec3(1e-30f); }));
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
