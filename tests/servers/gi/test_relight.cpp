#include "tests/servers/gi/hand_made_octree.h"

#include "servers/gi/relight.h"

#include "core/threads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace {

using namespace cl;
using tests::HandMadeLeaf;
using tests::kMinusX;
using tests::kPlusX;
using tests::kPlusY;
using tests::kPlusZ;

using Sums = std::vector<int32_t>;

/// Columns x, y, z with z opposite to the direction of travel.
glm::mat3 facing(const glm::vec3& travel) {
    const glm::vec3 z = -glm::normalize(travel);
    const glm::vec3 x = glm::normalize(glm::cross(std::abs(z.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), z));
    return {x, glm::cross(z, x), z};
}

/// Cells are metres here: cells_from_light has no scale.
gi::CachedLight omni(const glm::vec3& position, float range) {
    gi::CachedLight light;
    light.cells_from_light.origin = position;
    light.range_m = range;
    return light;
}
gi::CachedLight sun(const glm::vec3& travel) {
    gi::CachedLight light;
    light.type = LightType::Directional;
    light.cells_from_light.basis = facing(travel);
    return light;
}
gi::CachedLight spot(const glm::vec3& position, const glm::vec3& travel, float angle_deg, float range) {
    gi::CachedLight light = omni(position, range);
    light.type = LightType::Spot;
    light.cells_from_light.basis = facing(travel);
    light.spot_angle_deg = angle_deg;
    return light;
}

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

/// A floor, a wall and a sphere's shell of leaves: 64^3 cells, all kinds of normals.
gi::Octree busy_octree() {
    std::vector<HandMadeLeaf> leaves;
    for (int z = 0; z < 64; ++z) {
        for (int x = 0; x < 64; ++x) {
            leaves.push_back({{x, 2, z}, kPlusY, 0xC0A080, (x + z) % 17 == 0 ? 0xFF8000A0u : 0u});
            if (x > 2 && z < 40) {
                leaves.push_back({{40, x, z}, kMinusX, 0x4080FF});
            }
        }
    }
    for (int z = 20; z < 40; ++z) {
        for (int y = 20; y < 40; ++y) {
            for (int x = 10; x < 30; ++x) {
                const glm::vec3 n = (glm::vec3(x, y, z) - glm::vec3(19.5f, 29.5f, 29.5f)) / 9.5f;
                if (std::abs(glm::length(n) - 0.95f) < 0.05f) {
                    const auto byte = [](float v) { return uint32_t((v * 0.5f + 0.5f) * 255.0f); };
                    leaves.push_back({{x, y, z}, byte(n.x) << 16 | byte(n.y) << 8 | byte(n.z), 0x808080});
                }
            }
        }
    }
    return tests::make_octree(leaves);
}

std::vector<gi::CachedLight> busy_lights() {
    std::vector<gi::CachedLight> lights = {omni({20.3f, 50.1f, 10.7f}, 80.0f), sun({0.3f, -1.0f, 0.2f}),
                                           spot({5.5f, 40.2f, 5.1f}, {0.5f, -1.0f, 0.6f}, 40.0f, 90.0f),
                                           omni({200.0f, 90.0f, -30.0f}, 400.0f), sun({-1.0f, -0.01f, 0.0f})};
    lights[0].color = {1.0f, 0.7f, 0.31f};
    lights[1].energy = 3.7f;
    lights[2].attenuation = 1.7f;
    lights[2].spot_attenuation = 0.6f;
    lights[3].energy = 20.0f;
    return lights;
}

TEST_SUITE("servers/gi/relight") {
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
            CHECK(e.r == doctest::Approx(1024.0f * (std::cos(angle) - std::sin(angle) / 255.0f)).epsilon(0.002));
        }
        CHECK(energy_of_one(leaf, sun({1, 0, 0})) == glm::ivec3(0));
        CHECK(energy_of_one(leaf, sun({0, 0, 1})).r == 4); // the normal's -1/255 on z faces it: int(1024 / 255)
    }

    TEST_CASE("a lamp falls off with the distance plus a step over its range, to the power of its attenuation") {
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
            CHECK(energy_of_one(leaf, light).r == doctest::Approx(1024.0f * (1.0f - off_deg / 30.0f)).epsilon(0.01));
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
        // The slanting sun gets under the wall's lower edges: up to 28 * 0.3 and 28 * 0.1 cells at the last wall.
        const auto light_behind = [&](const Sums& sums, int from_x) {
            int64_t total = 0;
            for (size_t i = 0; i < layout.leaves.size(); ++i) {
                const glm::u16vec3 v = layout.leaves[i].voxel;
                total += v.x >= from_x && v.y >= 10 && v.z >= 4 ? sums[3 * i] : 0;
            }
            return total;
        };
        const glm::vec3 lamp(20.5f, 32.2f, 30.3f);
        for (const gi::CachedLight& light : {omni(lamp, 200.0f), spot(lamp, {1, 0, 0}, 60.0f, 200.0f), //
                                             sun({1.0f, 0.3f, 0.1f})}) {
            const Sums sums = lit(layout, light);
            CAPTURE(int(light.type));
            CHECK(light_behind(sums, light.type == LightType::Directional ? 10 : 32) > 100000); // before the wall
            CHECK(light_behind(sums, 33) == 0);
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
             {omni({20.2f, 40.3f, 30.6f}, 500.0f), omni({300.0f, 90.0f, 90.0f}, 5000.0f), sun({0.3f, -1.0f, 0.4f})}) {
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
        std::vector<gi::CachedLight> lights = {omni({1e30f, 1e30f, 1e30f}, 1e38f), omni({1e9f, 5e8f, 3.0f}, 1e10f),
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

    TEST_CASE("emission is where the sums start: 1024 times what the word decodes to") {
        // Direction (1, 0x80 / 255, 0), length 8 * 0x40 / 255.
        const gi::CellLayout layout =
            gi::make_layout(tests::make_octree({{{1, 2, 3}, kPlusZ, 0xFFFFFF, 0xFF800040}}));
        const float length = float(0x40) / 255.0f * 8.0f;
        CHECK(gi::emission_energies(layout) ==
              Sums{int32_t(length * 1024.0f), int32_t(float(0x80) / 255.0f * length * 1024.0f), 0});
    }

    TEST_CASE("leaves come in slot order with their own words and places") {
        const gi::CellLayout layout = gi::make_layout(
            tests::make_octree({{{63, 63, 63}, kPlusX}, {{0, 1, 0}, kPlusY, 0x123456}, {{1, 0, 0}, kPlusZ}}));
        REQUIRE(layout.leaves.size() == 3);
        CHECK(layout.leaves[0].voxel == glm::u16vec3(1, 0, 0));
        CHECK(layout.leaves[1].voxel == glm::u16vec3(0, 1, 0));
        CHECK(layout.leaves[2].voxel == glm::u16vec3(63, 63, 63));
        CHECK(layout.leaves[1].albedo == glm::u8vec3(0x12, 0x34, 0x56));
        CHECK(layout.leaves[1].normal.y == 1.0f);
        CHECK(layout.leaves[1].normal.x == doctest::Approx(-1.0 / 255.0));
        for (int level = 0; level < 7; ++level) {
            for (const uint32_t cell : layout.cells_of_level[size_t(level)]) {
                CHECK((layout.cells[cell].level_alpha >> 16) == uint32_t(level));
                CHECK(int(layout.voxels[cell].x) < (1 << level));
            }
        }
        CHECK(layout.leaf_bitmap.contains(63, 63, 63));
        CHECK_FALSE(layout.leaf_bitmap.contains(0, 0, 0));
    }
}

TEST_SUITE("servers/gi/downsample") {
    /// Two leaves, alone in a parent that is alone in its own, and so on to the root.
    struct Pair {
        gi::CellLayout layout = gi::make_layout(tests::make_octree({{{0, 0, 0}, kPlusX}, {{1, 0, 0}, kPlusX}}));
        gi::CellEnergies energies;

        int red_of_level(int level) const {
            return energies.rgb[size_t(layout.cells_of_level[size_t(level)][0]) * 3];
        }
    };

    TEST_CASE("propagation 0 is the mean over eight, black where there is no child") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{1000, 0, 0, 3001, 0, 0}, 0.0f, p.energies);
        CHECK(p.red_of_level(6) == 1000);
        CHECK(p.red_of_level(5) == 500); // 4001 / 8 = 500.125
        CHECK(p.red_of_level(4) == 63);  // 62.5 rounds away from zero
        CHECK(p.red_of_level(3) == 8);
    }

    TEST_CASE("propagation 1 is the mean over the children that exist: light does not dim upward") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{1000, 0, 0, 3001, 0, 0}, 1.0f, p.energies);
        CHECK(p.red_of_level(5) == 2001); // 2000.5 rounds away from zero
        CHECK(p.red_of_level(4) == 2001);
        CHECK(p.red_of_level(0) == 2001);
    }

    TEST_CASE("propagation 0.7 divides by 8 + (n - 8) * 0.7") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{1000, 0, 0, 3001, 0, 0}, 0.7f, p.energies);
        CHECK(p.red_of_level(5) == 1053); // 4001 / 3.8 = 1052.9
        CHECK(p.red_of_level(4) == 340);  // 1053 / 3.1 = 339.7
    }

    TEST_CASE("sums clamp to what an energy can hold, where Godot wraps") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{70000, -5, 65535, 1 << 24, 0, 0}, 1.0f, p.energies);
        const size_t leaf = size_t(p.layout.leaves[0].cell) * 3;
        CHECK(p.energies.rgb[leaf] == 65535);
        CHECK(p.energies.rgb[leaf + 1] == 0);
        CHECK(p.energies.rgb[leaf + 2] == 65535);
        CHECK(p.red_of_level(5) == 65535);
    }

    TEST_CASE("a root alone and any propagation give black, not a division by zero") {
        const gi::CellLayout layout = gi::make_layout(tests::make_octree({}));
        for (const float propagation : {0.0f, 1.0f, 2.0f, -3.0f, std::numeric_limits<float>::quiet_NaN()}) {
            gi::CellEnergies energies;
            gi::energies_from_leaves(layout, {}, propagation, energies);
            CHECK(energies.rgb == std::vector<gi::Energy>{0, 0, 0});
        }
    }

    TEST_CASE("inner energies do not depend on threads or on what was there before") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        Sums sums = gi::emission_energies(layout);
        gi::inject_light(layout, busy_lights()[0], 1, sums);
        gi::CellEnergies one;
        set_thread_count(1);
        gi::energies_from_leaves(layout, sums, 0.7f, one);
        gi::CellEnergies four;
        four.rgb.assign(layout.cells.size() * 3, 12345);
        set_thread_count(4);
        gi::energies_from_leaves(layout, sums, 0.7f, four);
        set_thread_count(0);
        CHECK(one.rgb == four.rgb);
    }
}

TEST_SUITE("servers/gi/mips") {
    TEST_CASE("levels halve until one side is 1") {
        CHECK(gi::mip_count({64, 32, 64}) == 6);
        CHECK(gi::mip_count({128, 128, 128}) == 8);
        CHECK(gi::mip_count({64, 1, 64}) == 1);
        const gi::CellLayout layout = gi::make_layout(tests::make_octree({{{1, 2, 3}, kPlusX}}, {64, 32, 64}));
        gi::CellEnergies energies;
        std::vector<gi::MipLevel> levels;
        gi::energies_from_leaves(layout, Sums{0, 0, 0}, 0.7f, energies);
        gi::encode_mips(layout, energies, 4, levels);
        REQUIRE(levels.size() == 6);
        CHECK(levels[0].size == glm::ivec3(64, 32, 64));
        CHECK(levels[5].size == glm::ivec3(2, 1, 2));
        CHECK(levels[5].rgba8.size() == 16);
    }

    TEST_CASE("a texel is energy over the dynamic range, then over four, clipped; empty texels are zero") {
        const gi::CellLayout layout = gi::make_layout(tests::make_octree({{{3, 2, 1}, kPlusX}}));
        gi::CellEnergies energies;
        std::vector<gi::MipLevel> levels;
        const auto texel = [&](int dynamic_range, int32_t energy) {
            gi::energies_from_leaves(layout, Sums{energy, 0, 0}, 1.0f, energies);
            gi::encode_mips(layout, energies, dynamic_range, levels);
            return int(levels[0].rgba8[((1 * 64 + 2) * 64 + 3) * 4]);
        };
        CHECK(texel(1, 1024) == 255); // 256, clipped
        CHECK(texel(1, 1023) == 255);
        CHECK(texel(1, 1019) == 254);
        CHECK(texel(4, 1024) == 64);
        CHECK(texel(4, 1039) == 64); // 1039 / 4 = 259, 259 >> 2 = 64
        CHECK(texel(3, 1024) == 85);
        CHECK(texel(16, 65535) == 255);
        CHECK(texel(0, 512) == 128); // counts as 1
        size_t occupied = 0;
        for (size_t i = 0; i < levels[0].rgba8.size(); i += 4) {
            occupied += levels[0].rgba8[i + 3] != 0;
        }
        CHECK(occupied == 1);
        CHECK(levels[0].rgba8[((1 * 64 + 2) * 64 + 3) * 4 + 3] == 255);
        // The same leaf in every mip, thinned to an eighth each time: 65535 / 8 = 8191 -> 31, then 3.
        CHECK(levels[1].rgba8[((0 * 32 + 1) * 32 + 1) * 4 + 3] == 31);
        CHECK(levels[2].rgba8[3] == 3);
    }

    TEST_CASE("encoding into the levels of a former relight leaves no trace of it") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        gi::CellEnergies energies;
        std::vector<gi::MipLevel> reused;
        Sums sums = gi::emission_energies(layout);
        for (const gi::CachedLight& light : busy_lights()) {
            gi::inject_light(layout, light, 1, sums);
        }
        gi::energies_from_leaves(layout, sums, 0.7f, energies);
        gi::encode_mips(layout, energies, 1, reused);
        const std::vector<uint8_t> bright = reused[0].rgba8;
        sums = gi::emission_energies(layout);
        gi::energies_from_leaves(layout, sums, 0.3f, energies);
        std::vector<gi::MipLevel> fresh;
        gi::encode_mips(layout, energies, 4, fresh);
        gi::encode_mips(layout, energies, 4, reused);
        CHECK(bright != fresh[0].rgba8);
        for (size_t m = 0; m < fresh.size(); ++m) {
            CHECK(fresh[m].rgba8 == reused[m].rgba8);
        }
    }
}

} // namespace
