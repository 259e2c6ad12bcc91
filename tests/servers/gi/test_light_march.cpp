#include "servers/gi/light_march.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace cl;

TEST_SUITE("servers/gi/light_march") {
    TEST_CASE("the remainder is fmod's, to the last bit") {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> length(0.0f, 2000.0f);
        std::uniform_real_distribution<float> step(1.0f, 1.7320508f);
        for (int i = 0; i < 100000; ++i) {
            const float b = i % 7 == 0 ? 1.0f : step(random);
            const float a = i % 5 == 0 ? b * float(i % 300) : length(random);
            REQUIRE(gi::remainder_of(a, b) == std::fmod(a, b));
        }
    }

    TEST_CASE("a step of advance_of() moves by one voxel on the dominant axis and by no more on the others") {
        std::mt19937 random(6);
        std::normal_distribution<float> n;
        for (int i = 0; i < 1000; ++i) {
            const glm::vec3 d = glm::normalize(glm::vec3(n(random), n(random), n(random)));
            const glm::vec3 moved = glm::abs(d * gi::advance_of(d));
            const float most = std::max(moved.x, std::max(moved.y, moved.z));
            CHECK(most == doctest::Approx(1.0f));
        }
        CHECK(gi::advance_of({0, 0, -1}) == 1.0f);
        CHECK(gi::advance_of({0, 1, 0}) == 1.0f);
        CHECK(gi::advance_of(glm::vec3(-0.6f, 0.0f, 0.6f)) == 1.0f / 0.6f);
    }

    TEST_CASE("a march reaches a leaf only if it is the first it meets") {
        gi::LeafBitmap leaves(glm::ivec3(64));
        leaves.add(20, 5, 5);
        leaves.add(30, 5, 5);
        const gi::March along_x{{0.5f, 5.5f, 5.5f}, {1, 0, 0}, 30.0f, 1.0f};
        CHECK(gi::reaches(leaves, {along_x, {20, 5, 5}}));
        CHECK_FALSE(gi::reaches(leaves, {along_x, {30, 5, 5}}));
        const gi::March beside{{0.5f, 6.5f, 5.5f}, {1, 0, 0}, 30.0f, 1.0f};
        CHECK_FALSE(gi::reaches(leaves, {beside, {20, 5, 5}}));
        const gi::March backward{{63.5f, 5.5f, 5.5f}, {-1, 0, 0}, 33.0f, 1.0f};
        CHECK(gi::reaches(leaves, {backward, {30, 5, 5}}));
        const gi::March too_short{{0.5f, 5.5f, 5.5f}, {1, 0, 0}, 15.0f, 1.0f};
        CHECK_FALSE(gi::reaches(leaves, {too_short, {20, 5, 5}}));
    }

    TEST_CASE("marches walked together reach what each reaches by one look at each step") {
        const glm::ivec3 dims(64, 32, 48);
        std::mt19937 random(4);
        const auto cell = [&] { return glm::ivec3(random() % 64, random() % 32, random() % 48); };
        size_t reached = 0;
        for (const int leaf_count : {4, 60, 3000}) {
            gi::LeafBitmap leaves(dims);
            std::vector<glm::ivec3> added;
            for (int i = 0; i < leaf_count; ++i) {
                added.push_back(cell());
                leaves.add(uint32_t(added.back().x), uint32_t(added.back().y), uint32_t(added.back().z));
            }
            leaves.measure_free_space();
            const auto one_by_one = [&](const gi::AimedMarch& aimed) {
                glm::vec3 at = aimed.march.from;
                float left = aimed.march.distance;
                for (; left > -aimed.march.step; left -= aimed.march.step) {
                    const glm::ivec3 c(glm::floor(at));
                    if (leaves.look(c.x, c.y, c.z).leaf) {
                        return c == aimed.target;
                    }
                    at += aimed.march.direction * aimed.march.step;
                }
                return false;
            };
            for (int i = 0; i < 2000; ++i) {
                std::array<gi::AimedMarch, gi::kMarchLanes> marches;
                for (gi::AimedMarch& aimed : marches) {
                    aimed.target = added[random() % added.size()];
                    const glm::vec3 to = glm::vec3(aimed.target) + 0.5f;
                    const glm::vec3 from = glm::vec3(cell() * 2 - 20) + 0.3f; // also outside of the grid
                    const glm::vec3 direction = glm::normalize(to - from);
                    aimed.march = {from, direction, glm::length(to - from), gi::advance_of(direction)};
                }
                const uint32_t got = gi::reaches_each(leaves, marches);
                for (size_t lane = 0; lane < marches.size(); ++lane) {
                    REQUIRE((got >> lane & 1u) == uint32_t(one_by_one(marches[lane])));
                    REQUIRE((got >> lane & 1u) == uint32_t(gi::reaches(leaves, marches[lane])));
                }
                reached += size_t(std::popcount(got));
            }
        }
        CHECK(reached > 1000);
    }

    TEST_CASE("free steps never pass a leaf, and save most looks in an empty room") {
        const glm::ivec3 dims(64, 32, 48);
        std::mt19937 random(3);
        for (int leaf_count : {0, 1, 3, 40}) {
            gi::LeafBitmap leaves(dims);
            std::vector<glm::ivec3> added;
            for (int i = 0; i < leaf_count; ++i) {
                added.emplace_back(random() % 64, random() % 32, random() % 48);
                leaves.add(uint32_t(added.back().x), uint32_t(added.back().y), uint32_t(added.back().z));
            }
            leaves.measure_free_space();
            uint32_t most = 0;
            for (int i = 0; i < 2000; ++i) {
                const glm::ivec3 at(random() % 64, random() % 32, random() % 48);
                const uint32_t steps = leaves.look(at.x, at.y, at.z).free_steps;
                most = std::max(most, steps);
                for (const glm::ivec3& leaf : added) {
                    const glm::ivec3 apart = glm::abs(leaf - at);
                    CHECK(std::max(apart.x, std::max(apart.y, apart.z)) > int(steps));
                }
            }
            CHECK(most >= (leaf_count < 4 ? 20u : 3u));
        }
    }

    TEST_CASE("the bitmap holds what was added, and nothing outside the grid") {
        const glm::ivec3 dims(8, 2, 16);
        gi::LeafBitmap leaves(dims);
        std::mt19937 random(8);
        std::vector<bool> expected(size_t(8 * 2 * 16));
        for (int i = 0; i < 60; ++i) {
            const uint32_t x = uint32_t(random() % 8), y = uint32_t(random() % 2),
                           z = uint32_t(random() % 16);
            leaves.add(x, y, z);
            expected[(z * 2 + y) * 8 + x] = true;
        }
        for (int z = -2; z < 19; ++z) {
            for (int y = -2; y < 5; ++y) {
                for (int x = -2; x < 11; ++x) {
                    const bool inside = x >= 0 && x < 8 && y >= 0 && y < 2 && z >= 0 && z < 16;
                    CHECK(leaves.look(x, y, z).leaf == (inside && expected[size_t((z * 2 + y) * 8 + x)]));
                }
            }
        }
    }
}

} // namespace
