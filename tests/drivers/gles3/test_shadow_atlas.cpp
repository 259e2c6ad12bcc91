#include "drivers/gles3/shadow_atlas.h"

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include <vector>

namespace {

using namespace cl;
using namespace cl::gles3;

constexpr int kSize = 4096;

/// The `number`th light made.
RID light(uint32_t number) {
    return {number, 1};
}

/// Edges of the slots that lights get, by request; 0: none.
std::vector<int> edges(ShadowAtlas& atlas, const std::vector<ShadowAtlas::Request>& requests) {
    std::vector<int> out;
    for (const std::optional<gl::Rect>& rect : atlas.assign(requests)) {
        out.push_back(rect ? rect->size.x : 0);
    }
    return out;
}

TEST_SUITE("drivers/gles3/shadow_atlas") {
    TEST_CASE("85 lights get slots inside the atlas that do not overlap, the 86th gets none") {
        ShadowAtlas atlas(kSize);
        std::vector<ShadowAtlas::Request> requests;
        for (uint32_t i = 0; i < 86; ++i) {
            requests.push_back({light(i), 256, 1.0f});
        }
        std::vector<gl::Rect> given;
        for (const std::optional<gl::Rect>& rect : atlas.assign(requests)) {
            if (rect) {
                given.push_back(*rect);
            }
        }
        CHECK(given.size() == 85);
        for (size_t i = 0; i < given.size(); ++i) {
            const glm::ivec2 end = given[i].position + given[i].size;
            CHECK(glm::min(given[i].position, glm::ivec2(0)) == glm::ivec2(0));
            CHECK(glm::max(end, glm::ivec2(kSize)) == glm::ivec2(kSize));
            for (size_t k = 0; k < i; ++k) {
                const glm::ivec2 low = glm::max(given[i].position, given[k].position);
                const glm::ivec2 high = glm::min(end, given[k].position + given[k].size);
                CHECK((low.x >= high.x || low.y >= high.y));
            }
        }
    }

    TEST_CASE("the smallest slot that is large enough is taken, and a smaller one where none is") {
        ShadowAtlas atlas(kSize);
        CHECK(edges(atlas, {{light(0), 512, 1.0f}, {light(1), 1024, 1.0f}, {light(2), 256, 1.0f}}) ==
              std::vector<int>{512, 1024, 256});
        const ShadowAtlas::Request large{light(0), 2048, 1.0f};
        std::vector<int> got = edges(atlas, {large, {light(1), 2048, 1.0f}, {light(2), 2048, 1.0f}});
        CHECK(got == std::vector<int>{1024, 1024, 2048});
    }

    TEST_CASE(
        "of lights that want one size the larger box chooses first, by powers of two, then the last made") {
        const auto given = [](const std::vector<ShadowAtlas::Request>& requests) {
            ShadowAtlas atlas(kSize);
            return edges(atlas, requests);
        };
        // Boxes of 16 and 10 m, and of 14 and 12 m, in pictures of Godot's.
        CHECK(given({{light(0), 2048, 16.0f}, {light(1), 2048, 10.0f}}) == std::vector<int>{2048, 1024});
        CHECK(given({{light(0), 2048, 14.0f}, {light(1), 2048, 12.0f}}) == std::vector<int>{1024, 2048});
        CHECK(given({{light(0), 1024, 99.0f}, {light(1), 2048, 1.0f}}) == std::vector<int>{1024, 2048});
    }

    TEST_CASE("a light keeps its slot while it wants the same size, whoever comes or goes") {
        ShadowAtlas atlas(kSize);
        const ShadowAtlas::Request kept{light(5), 2048, 1.0f};
        const gl::Rect first = *atlas.assign(std::vector{kept})[0];
        const std::vector<ShadowAtlas::Request> more{{light(9), 2048, 99.0f}, kept};
        CHECK(*atlas.assign(more)[1] == first);
        CHECK(*atlas.assign(std::vector{kept})[0] == first);
        const ShadowAtlas::Request smaller{light(5), 512, 1.0f};
        CHECK(atlas.assign(std::vector{smaller})[0]->size.x == 512);
    }

    TEST_CASE(
        "a light wants the edge that its coverage of the picture asks for, and no more than a quadrant") {
        CHECK(wanted_slot_size(9.0f, kSize) == 2048);
        CHECK(wanted_slot_size(0.6f, kSize) == 2048);
        CHECK(wanted_slot_size(0.5f, kSize) == 1024);
        CHECK(wanted_slot_size(0.01f, kSize) == 256);
        CHECK(wanted_slot_size(1.0f, 0) == 8);
    }
}

} // namespace
