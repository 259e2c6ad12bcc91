#include "servers/gi/center_test.h"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <random>

using namespace cl::gi;

namespace {

std::mt19937 g_random{20};

float uniform(float from, float to) {
    return std::uniform_real_distribution<float>(from, to)(g_random);
}

/// A multiple of 1/8, so that faces fall on the borders of boxes, or any number.
float coordinate(bool on_border, float reach) {
    const float any = uniform(-reach, reach);
    return on_border ? std::round(any * 8.0f) / 8.0f : any;
}

int main_axis(const glm::vec3 (&v)[3]) {
    const glm::vec3 n = glm::abs(glm::cross(v[1] - v[0], v[2] - v[0]));
    return n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
}

/// Four boxes of one size near the origin.
Boxes<float4> four_boxes(float half) {
    Boxes<float4> boxes;
    for (int lane = 0; lane < 4; ++lane) {
        for (int axis = 0; axis < 3; ++axis) {
            boxes.center[axis][lane] = std::round(uniform(-8.0f, 8.0f)) * half;
            boxes.half[axis][lane] = half;
        }
    }
    return boxes;
}

} // namespace

TEST_SUITE("servers/gi/center_test") {
    TEST_CASE("the cheap test never says anything else than the separating-axis test") {
        int settled = 0, touching = 0;
        for (int i = 0; i < 200'000; ++i) {
            const bool on_border = i % 2 == 0;
            const float reach = i % 3 == 0 ? 1.0f : 40.0f;
            glm::vec3 v[3];
            for (glm::vec3& vertex : v) {
                vertex = {coordinate(on_border, reach), coordinate(on_border, reach),
                          coordinate(on_border, reach)};
            }
            if (i % 5 < 2) { // flat along some axis
                v[1][i % 3] = v[2][i % 3] = v[0][i % 3] = coordinate(on_border, 1.0f);
            }
            const CenterTest test = make_center_test(v, main_axis(v));
            const float half = uniform(0.0f, 1.0f) < 0.5f ? 0.125f : 0.03f;
            const Boxes<float4> boxes = four_boxes(half);
            const uint32_t full = overlapping_boxes(boxes, v);
            REQUIRE(overlapping_boxes(boxes, v, test, half) == full);
            if (half >= test.least_half_m) {
                const uint32_t sure = lane_bits(surely_touches(test, boxes)) &
                                      ~lane_bits(separated_by_box_axis(boxes, v)) & 15u;
                REQUIRE((sure & ~full) == 0u); // also where other lanes called for the full test
                settled += int(sure != 0);
            }
            touching += int(full != 0);
        }
        CHECK(touching > 10'000);
        CHECK(settled > 5'000); // so that the law above says something
    }

    TEST_CASE("slivers and points are left to the full test") {
        const glm::vec3 sliver[3] = {{0, 0, 0}, {10, 0, 0.5f}, {5, 1e-4f, 0.25f}};
        CHECK(make_center_test(sliver, 2).least_half_m == 1e30f);
        const glm::vec3 point[3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
        CHECK(make_center_test(point, 0).least_half_m == 1e30f);
    }
}
