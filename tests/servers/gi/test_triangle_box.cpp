#include "servers/gi/triangle_box.h"
#include "servers/gi/voxelizer.h"

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include <cmath>
#include <random>

namespace {

using namespace cl;

struct RandomTriangles {
    std::mt19937 random{11};
    float number(float range) { return std::uniform_real_distribution<float>(-range, range)(random); }
    glm::vec3 point(float range) { return {number(range), number(range), number(range)}; }
};

/// Least distance, over all axes the largest, from the box to points spread over the triangle: 0 if one is
/// inside.
float least_gap(const glm::vec3 (&v)[3], const glm::vec3& center, const glm::vec3& half, int steps) {
    float least = 1e9f;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            const float s = float(i) / float(steps);
            const float t = float(j) / float(steps);
            const glm::vec3 p = v[0] + s * (v[1] - v[0]) + t * (v[2] - v[0]);
            const glm::vec3 out = glm::abs(p - center) - half;
            least = std::min(least, std::max(0.0f, std::max(out.x, std::max(out.y, out.z))));
        }
    }
    return least;
}

TEST_SUITE("servers/gi/triangle_box") {
    TEST_CASE("the test agrees with points spread over the triangle") {
        RandomTriangles r;
        constexpr int kSteps = 40;
        int overlapping = 0;
        for (int i = 0; i < 3000; ++i) {
            const glm::vec3 center = r.point(1.0f);
            const glm::vec3 half = glm::abs(r.point(0.5f)) + 0.05f;
            const glm::vec3 v[3] = {r.point(1.5f), r.point(1.5f), r.point(1.5f)};
            const float gap = least_gap(v, center, half, kSteps);
            const bool overlaps = gi::triangle_overlaps_box(center, half, v[0], v[1], v[2]);
            overlapping += overlaps;
            if (gap < 1e-6f) {
                CHECK(overlaps);
            }
            // Points are nowhere farther apart than this, so a larger gap cannot hide a contact.
            const float spacing = 3.0f * std::sqrt(3.0f) / float(kSteps);
            if (gap > spacing) {
                CHECK_FALSE(overlaps);
            }
        }
        CHECK(overlapping > 300);
    }

    TEST_CASE(
        "a triangle within a box touches it, also where its corners lie on the border to the last bit") {
        RandomTriangles r;
        int on_border = 0;
        for (int i = 0; i < 20'000; ++i) {
            const glm::vec3 center = r.point(10.0f), half = glm::abs(r.point(0.5f));
            glm::vec3 v[3] = {center + r.point(0.5f), center + r.point(0.5f), center + r.point(0.5f)};
            for (glm::vec3& corner : v) {
                corner = glm::clamp(corner, center - half, center + half);
            }
            const gi::Boxes<float> box{{center.x, center.y, center.z}, {half.x, half.y, half.z}};
            if (gi::lies_within(box, v)) { // rounding leaves some out
                REQUIRE(gi::triangle_overlaps_box(center, half, v[0], v[1], v[2]));
                on_border += v[0].x == center.x - half.x || v[0].x == center.x + half.x;
            }
        }
        CHECK(on_border > 500);
    }

    TEST_CASE("four boxes at once give what each gives alone, to the last bit") {
        RandomTriangles r;
        int touching = 0;
        for (int i = 0; i < 5000; ++i) {
            // Coordinates on a coarse lattice make exact contacts common.
            const auto lattice = [&] { return glm::round(r.point(8.0f)) * 0.125f; };
            const glm::vec3 v[3] = {lattice(), lattice(), lattice()};
            gi::Boxes<gi::float4> boxes;
            glm::vec3 centers[4];
            glm::vec3 halves[4];
            for (int lane = 0; lane < 4; ++lane) {
                centers[lane] = i % 2 ? lattice() : r.point(1.0f);
                halves[lane] = i % 3 ? glm::vec3(0.125f) : glm::abs(r.point(0.3f));
                for (int axis = 0; axis < 3; ++axis) {
                    boxes.center[axis][lane] = centers[lane][axis];
                    boxes.half[axis][lane] = halves[lane][axis];
                }
            }
            const uint32_t together = gi::overlapping_boxes(boxes, v);
            uint32_t alone = 0;
            for (int lane = 0; lane < 4; ++lane) {
                alone |= uint32_t(gi::triangle_overlaps_box(centers[lane], halves[lane], v[0], v[1], v[2]))
                         << lane;
            }
            touching += alone != 0;
            CHECK(together == alone);
        }
        CHECK(touching > 500);
    }

    TEST_CASE("touching a face, an edge or a corner counts as overlap") {
        const glm::vec3 c(0.0f);
        const glm::vec3 h(0.5f);
        CHECK(gi::triangle_overlaps_box(c, h, {0.5f, -3, -3}, {0.5f, 3, -3}, {0.5f, 0, 3}));
        CHECK_FALSE(gi::triangle_overlaps_box(c, h, {0.5001f, -3, -3}, {0.5001f, 3, -3}, {0.5001f, 0, 3}));
        CHECK(gi::triangle_overlaps_box(c, h, {0.5f, 0.5f, 0.5f}, {1, 1, 1}, {2, 1, 1}));
        CHECK_FALSE(gi::triangle_overlaps_box(c, h, {0.51f, 0.51f, 0.51f}, {1, 1, 1}, {2, 1, 1}));
        // Along the edge x = y = 0.5, from outside.
        CHECK(gi::triangle_overlaps_box(c, h, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}));
        CHECK_FALSE(gi::triangle_overlaps_box(c, h, {1.01f, 0, 0}, {0, 1.01f, 0}, {1, 1, 0}));
    }

    TEST_CASE("a triangle that swallows the box's cross-section but passes beside its corner is no overlap") {
        // The bounding boxes overlap and no vertex separates them: only the plane and edge axes can tell.
        CHECK_FALSE(gi::triangle_overlaps_box(glm::vec3(0.0f), glm::vec3(0.5f), {1.6f, 0, 0}, {0, 1.6f, 0},
                                              {0, 0, 1.6f}));
        CHECK(gi::triangle_overlaps_box(glm::vec3(0.0f), glm::vec3(0.5f), {1.4f, 0, 0}, {0, 1.4f, 0},
                                        {0, 0, 1.4f}));
    }
}

} // namespace
