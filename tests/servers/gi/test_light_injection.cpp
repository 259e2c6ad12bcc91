#include "tests/servers/gi/hand_made_octree.h"
#include "tests/servers/gi/relight_scene.h"

#include "servers/gi/relight.h"

#include "core/threads.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace cl;
using tests::busy_lights;
using tests::busy_octree;
using tests::facing;
using tests::HandMadeLeaf;
using tests::kMinusX;
using tests::kPlusX;
using tests::kPlusY;
using tests::omni;
using tests::spot;
using tests::sun;

using Sums = std::vector<int32_t>;

Sums lit(const gi::CellLayout& layout, const gi::CachedLight& light) {
    Sums sums(layout.leaves.size() * 3, 0);
    gi::inject_light(layout, light, 1, sums);
    return sums;
}

/// Energy of the only leaf, which lies at `voxel`.
glm::ivec3 energy_of_one(const HandMadeLeaf& leaf, const gi::CachedLight& light) {
    const Sums sums = lit(gi::make_layout(tests::make_octree({leaf})), light);
    return {sums[0], sums[1], sums[2]};
}

TEST_SUITE("servers/gi/light_injection") {
    TEST_CASE("a sun straight on a white leaf gives its energy times the normal's share") {
        gi::CachedLight light = sun({0, -1, 0});
        light.energy = 2.0f;
        light.color = {1.0f, 0.5f, 0.25f};
        const HandMadeLeaf leaf{{10, 10, 10}, kPlusY};
        CHECK(energy_of_one(leaf, light) == glm::ivec3(2048, 1024, 512));
        // Albedo bytes scale: int(2048 * 128 / 255), int(1024 * 64 / 255), 0.
        CHECK(energy_of_one({{10, 10, 10}, kPlusY, 0x804000}, light) == glm::ivec3(1028, 257, 0));
    }

    TEST_CASE("a sun at an angle gives the cosine, and nothing from behind") {
        const HandMadeLeaf leaf{{10, 10, 10}, kPlusX};
        for (const float angle : {0.2f, 0.7f, 1.2f}) {
            const glm::ivec3 e = energy_of_one(leaf, sun({-std::cos(angle), 0.0f, -std::sin(angle)}));
            // The stored normal has -1/255 on its other axes.
            CHECK(e.r ==
                  doctest::Approx(1024.0f * (std::cos(angle) - std::sin(angle) / 255.0f)).epsilon(0.002));
        }
        CHECK(energy_of_one(leaf, sun({1, 0, 0})) == glm::ivec3(0));
        CHECK(energy_of_one(leaf, sun({0, 0, 1})).r ==
              4); // the normal's -1/255 on z faces it: int(1024 / 255)
    }

    TEST_CASE(
        "a lamp falls off with the distance plus a step over its range, to the power of its attenuation") {
        const HandMadeLeaf leaf{{10, 10, 10}, kPlusX};
        gi::CachedLight light = omni({30.97f, 10.97f, 10.97f}, 50.0f);
        // The ray ends 0.47 from the centre, toward the light: straight along x, 20 cells away.
        const float share = 1.0f - 21.0f / 50.0f;
        CHECK(energy_of_one(leaf, light).r == doctest::Approx(1024.0f * share).epsilon(0.002));
        light.attenuation = 2.0f;
        CHECK(energy_of_one(leaf, light).r == doctest::Approx(1024.0f * share * share).epsilon(0.002));
        light.attenuation = 0.0f;
        CHECK(energy_of_one(leaf, light).r == 1024);
    }

    TEST_CASE("a lamp's range counts in metres through the transform, and ends one step early") {
        const HandMadeLeaf leaf{{10, 10, 10}, kPlusX};
        gi::CachedLight light = omni({30.97f, 10.97f, 10.97f}, 0.0f);
        light.attenuation = 0.0f;
        light.cells_from_light.basis = glm::mat3(4.0f); // four cells a metre
        light.range_m = 5.3f;                           // 21.2 cells; distance and step are 21
        CHECK(energy_of_one(leaf, light).r == 1024);
        light.range_m = 5.2f; // 20.8
        CHECK(energy_of_one(leaf, light).r == 0);
    }

    TEST_CASE("a spot lights its cone and fades from its axis to the edge") {
        const HandMadeLeaf leaf{{10, 10, 10}, kPlusX};
        const glm::vec3 lamp(30.97f, 10.97f, 10.97f);
        gi::CachedLight light = spot(lamp, {-1, 0, 0}, 30.0f, 50.0f);
        light.attenuation = 0.0f;
        CHECK(energy_of_one(leaf, light).r == doctest::Approx(1024).epsilon(0.002)); // on the axis
        for (const float off_deg : {10.0f, 20.0f, 29.0f}) {
            const float off = off_deg * 3.14159265f / 180.0f;
            light.cells_from_light.basis = facing({-std::cos(off), std::sin(off), 0.0f});
            CAPTURE(off_deg);
            light.spot_attenuation = 1.0f;
            CHECK(energy_of_one(leaf, light).r ==
                  doctest::Approx(1024.0f * (1.0f - off_deg / 30.0f)).epsilon(0.01));
            light.spot_attenuation = 0.0f;
            CHECK(energy_of_one(leaf, light).r == 1024);
        }
        light.cells_from_light.basis = facing({-std::cos(0.55f), std::sin(0.55f), 0.0f}); // 31.5 degrees
        CHECK(energy_of_one(leaf, light).r == 0);
    }

    TEST_CASE("behind a wall of leaves no light arrives, of any kind") {
        std::vector<HandMadeLeaf> leaves;
        for (int z = 0; z < 64; ++z) {
            for (int y = 0; y < 64; ++y) {
                leaves.push_back({{32, y, z}, kMinusX});
                leaves.push_back({{10, y, z}, y % 2 ? kPlusX : kMinusX});
                leaves.push_back({{50, y, z}, kMinusX});
                leaves.push_back({{60, y, z}, kMinusX});
            }
        }
        const gi::CellLayout layout = gi::make_layout(tests::make_octree(leaves));
        // Slanting rays get under the wall's lower edges: up to 28 * 0.3 and 28 * 0.1 cells at the last wall.
        const auto light_behind = [&](const Sums& sums, int from_x) {
            int64_t total = 0;
            for (size_t i = 0; i < layout.leaves.size(); ++i) {
                const glm::u16vec3 v = layout.leaves[i].voxel;
                total += v.x >= from_x && v.y >= 10 && v.z >= 4 ? sums[3 * i] : 0;
            }
            return total;
        };
        // All leaves lie on one side of the lamps in each axis: there the clip planes stay outside of the
        // grid.
        const glm::vec3 lamp(-20.5f, -1.2f, -1.3f);
        for (const gi::CachedLight& light :
             {omni(lamp, 200.0f), spot(lamp, {1.0f, 0.4f, 0.4f}, 60.0f, 200.0f), sun({1.0f, 0.3f, 0.1f})}) {
            const Sums sums = lit(layout, light);
            CAPTURE(int(light.type));
            CHECK(light_behind(sums, 10) > 100000); // before the wall
            CHECK(light_behind(sums, 33) == 0);
        }
    }

    TEST_CASE("rays of a lamp that start at a clip plane inside the grid pass what is before it") {
        // In tree order: leaves on the lamp's positive side; one on its negative side, which puts the plane
        // at 65; a row on its positive side, which lowers it to 64, 63, ...; a wall; behind it the leaf that
        // counts. 1020 leaves at first have the row cross from one run of leaves to the next.
        const auto with_row = [](int before, int row) {
            std::vector<HandMadeLeaf> all;
            for (int i = 0; i < before; ++i) {
                all.push_back({{8 + i % 8, i / 8 % 8, i / 64}, kMinusX});
            }
            all.push_back({{0, 0, 31}, kPlusX});
            for (int i = 0; i < row; ++i) {
                all.push_back({{8 + i % 8, i / 8, 31}, kMinusX});
            }
            all.push_back({{40, 32, 0}, kMinusX});
            all.push_back({{50, 32, 0}, kMinusX});
            return gi::make_layout(tests::make_octree(all));
        };
        // The last leaf finds the plane at 63 - row. The ray starts there if that is before the leaf's 50.03,
        // and beyond the wall if it is past 40.
        for (const int before : {0, 1020}) {
            for (const auto& [at_row, is_lit] : {std::pair{0, false},
                                                 {12, false},
                                                 {13, true},
                                                 {18, true},
                                                 {22, true},
                                                 {23, false},
                                                 {30, false}}) {
                const int row = at_row; // CAPTURE needs a variable
                const gi::CellLayout layout = with_row(before, row);
                const Sums sums = lit(layout, omni({4.0f, 32.97f, 0.97f}, 500.0f));
                CAPTURE(before);
                CAPTURE(row);
                CHECK((sums[tests::leaf_at(layout, {50, 32, 0}) * 3] > 0) == is_lit);
                CHECK(sums[tests::leaf_at(layout, {40, 32, 0}) * 3] > 0);
            }
        }
    }

    TEST_CASE("nothing is in the way of a lamp in an empty room: every wall leaf that faces it is lit") {
        std::vector<HandMadeLeaf> leaves;
        for (int z = 0; z < 64; ++z) {
            for (int x = 0; x < 64; ++x) {
                leaves.push_back({{x, 0, z}, kPlusY});
            }
        }
        const gi::CellLayout layout = gi::make_layout(tests::make_octree(leaves));
        for (const gi::CachedLight& light :
             {omni({20.2f, 40.3f, 30.6f}, 500.0f), omni({300.0f, 90.0f, 90.0f}, 5000.0f),
              sun({0.3f, -1.0f, 0.4f})}) {
            const Sums sums = lit(layout, light);
            CHECK(std::all_of(sums.begin(), sums.end(), [](int32_t e) { return e > 0; }));
        }
    }

    TEST_CASE("taking every light out restores the numbers from before, in any order, with any threads") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        const std::vector<gi::CachedLight> lights = busy_lights();
        const Sums start = gi::emission_energies(layout);
        Sums forward = start;
        set_thread_count(1);
        for (const gi::CachedLight& light : lights) {
            gi::inject_light(layout, light, 1, forward);
        }
        CHECK(forward != start);
        Sums backward = start;
        set_thread_count(4);
        for (size_t i = lights.size(); i-- > 0;) {
            gi::inject_light(layout, lights[i], 1, backward);
        }
        CHECK(backward == forward);
        for (const size_t i : {2, 0, 4, 1, 3}) {
            gi::inject_light(layout, lights[i], -1, forward);
        }
        set_thread_count(0);
        CHECK(forward == start);
    }

    TEST_CASE("an invisible light and one of numbers that are not finite light nothing") {
        const HandMadeLeaf leaf{{10, 10, 10}, kPlusX};
        const gi::CachedLight good = omni({30.0f, 10.5f, 10.5f}, 50.0f);
        CHECK(energy_of_one(leaf, good).r > 0);
        gi::CachedLight light = good;
        light.visible = false;
        CHECK(energy_of_one(leaf, light) == glm::ivec3(0));
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float infinity = std::numeric_limits<float>::infinity();
        for (float gi::CachedLight::*field :
             {&gi::CachedLight::energy, &gi::CachedLight::range_m, &gi::CachedLight::attenuation}) {
            for (const float bad : {nan, infinity, -infinity}) {
                light = good;
                light.*field = bad;
                CHECK(energy_of_one(leaf, light) == glm::ivec3(0));
            }
        }
        light = good;
        light.cells_from_light.origin.y = nan;
        CHECK(energy_of_one(leaf, light) == glm::ivec3(0));
    }

    TEST_CASE("extreme lights end, stay within their limit and can be taken out again") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        std::vector<gi::CachedLight> lights = {
            omni({1e30f, 1e30f, 1e30f}, 1e38f), omni({1e9f, 5e8f, 3.0f}, 1e10f),
            omni({20.0f, 50.0f, 10.0f}, 1e38f), omni({20.5f, 29.5f, 29.5f}, 80.0f)};
        lights[0].energy = 1e38f;
        lights[2].energy = -1e30f;
        lights[3].attenuation = -1e30f;
        gi::CachedLight flat = sun({0, -1, 0});
        flat.cells_from_light.basis = glm::mat3(0.0f);
        lights.push_back(flat);
        flat.cells_from_light.basis = glm::mat3(1e-30f);
        lights.push_back(flat);
        Sums sums(layout.leaves.size() * 3, 0);
        for (const gi::CachedLight& light : lights) {
            const Sums before = sums;
            gi::inject_light(layout, light, 1, sums);
            int64_t most = 0;
            for (size_t i = 0; i < sums.size(); ++i) {
                most = std::max<int64_t>(most, std::abs(int64_t(sums[i]) - before[i]));
            }
            CHECK(most <= 1 << 24);
            gi::inject_light(layout, light, -1, sums);
            CHECK(sums == before);
        }
    }
}

} // namespace
