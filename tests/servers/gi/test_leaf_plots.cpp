#include "servers/gi/leaf_plots.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <tuple>

using namespace cl::gi;

TEST_SUITE("servers/gi/leaf_plots") {
    TEST_CASE("each brick gets its plots, by leaf and then by triangle, however they were dealt out") {
        constexpr int kLevels = 8;
        constexpr uint32_t kLeavesPerBrick = 1u << (3 * (kLevels - 1 - kBakeBrickLevel));
        std::mt19937 random{5};
        const auto below = [&](uint32_t n) { return uint32_t(random()) % n; };
        std::vector<std::vector<LeafPlot>> parts(7);
        std::vector<LeafPlot> all;
        uint32_t triangle = 0;
        for (std::vector<LeafPlot>& part : parts) {
            for (uint32_t left = below(2000); left > 0; --left, ++triangle) {
                for (uint32_t leaves = below(3); leaves > 0; --leaves) {
                    const uint32_t brick = below(20) * 25;
                    part.push_back({brick * kLeavesPerBrick + below(kLeavesPerBrick), triangle});
                }
            }
            all.insert(all.end(), part.begin(), part.end());
        }
        const std::vector<std::span<const LeafPlot>> spans(parts.begin(), parts.end());
        const LeafPlots plots(spans, kLevels);
        std::vector<LeafPlot> sorted;
        for (uint32_t brick = 0; brick < kBakeBricks; ++brick) {
            const std::vector<LeafPlot> of_brick = plots.sorted_by_leaf(brick);
            CHECK(of_brick.size() == plots.of_brick(brick).size());
            sorted.insert(sorted.end(), of_brick.begin(), of_brick.end());
        }
        const auto key = [](const LeafPlot& p) { return std::tuple(p.leaf, p.triangle); };
        std::stable_sort(all.begin(), all.end(), [&](auto& a, auto& b) { return key(a) < key(b); });
        REQUIRE(sorted.size() == all.size());
        CHECK(std::equal(sorted.begin(), sorted.end(), all.begin(),
                         [&](auto& a, auto& b) { return key(a) == key(b); }));
    }

    TEST_CASE("without plots no brick is touched") {
        const LeafPlots plots({}, 7);
        CHECK(plots.of_brick(0).empty());
        CHECK(plots.sorted_by_leaf(kBakeBricks - 1).empty());
    }
}
