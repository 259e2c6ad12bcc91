#include "servers/gi/clip_planes.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <random>
#include <vector>

namespace {

using namespace cl;

const glm::ivec3 kDims(64, 32, 64);

gi::ClipPlanes turned_to(const glm::vec3& direction) {
    gi::ClipPlanes planes;
    planes.turn_to(kDims, direction);
    return planes;
}

TEST_SUITE("servers/gi/clip_planes") {
    TEST_CASE("at a light's first leaf a start outside the grid moves in to the margins, one inside stays") {
        const glm::vec3 down(0, -1, 0);
        CHECK(turned_to(down).clipped_start({5, 100, 5}, {5, 3, 5}) == glm::vec3(5, 33, 5));
        CHECK(turned_to(down).clipped_start({5, 30, 5}, {5, 3, 5}) == glm::vec3(5, 30, 5));
        CHECK(turned_to({1, 0, 0}).clipped_start({-40, 2, 2}, {10, 2, 2}) == glm::vec3(-1, 2, 2));
        // A diagonal from far away: no axis is left beyond its plane.
        const glm::vec3 from(500, 400, -300);
        const glm::vec3 to(10.5f, 10.5f, 10.5f);
        const glm::vec3 start = turned_to(glm::normalize(to - from)).clipped_start(from, to);
        CHECK(start.x <= 65.01f);
        CHECK(start.y <= 33.01f);
        CHECK(start.z >= -1.01f);
        CHECK(glm::length(glm::cross(glm::normalize(start - to), glm::normalize(from - to))) < 1e-4f);
    }

    TEST_CASE("a rising axis lowers its plane by one each turn, a falling one puts it back outside") {
        gi::ClipPlanes planes;
        const glm::vec3 from(-200, 2, 2);
        const glm::vec3 to(63, 2, 2);
        for (int turn = 1; turn <= 3; ++turn) {
            planes.turn_to(kDims, {1, 0, 0});
            CHECK(planes.clipped_start(from, to).x == doctest::Approx(-turn));
        }
        planes.turn_to(kDims, {-1, 0, 0});
        CHECK(planes.clipped_start({200, 2, 2}, {1, 2, 2}).x == doctest::Approx(65));
        // 64, 63, ... lie inside: the march would start there, whatever is before.
        for (int plane = 64; plane > 40; --plane) {
            planes.turn_to(kDims, {1, 0, 0});
            if (plane <= 63) {
                CHECK(planes.clipped_start({10, 2, 2}, to).x == doctest::Approx(plane));
            }
        }
    }

    TEST_CASE("planes go to the axes in use, in order, and keep the axes of former turns") {
        gi::ClipPlanes planes;
        planes.turn_to(kDims, {0, -1, 0}); // plane 0: y = 33
        planes.turn_to(kDims, {-1, 0, 0}); // plane 0: x + y = 65
        CHECK(planes.clipped_start({100, 15, 2}, {0, 15, 2}) == glm::vec3(50, 15, 2));
        // Along z plane 0 is x + y + z = 64: one less than 65.
        planes.turn_to(kDims, {0, 0, 1});
        CHECK(planes.clipped_start({10, 10, 0}, {10, 10, 60}) == glm::vec3(10, 10, 44));
    }

    TEST_CASE("the turns of runs of leaves, put together, are the turns of all leaves in order") {
        std::mt19937 random(3);
        std::normal_distribution<float> n;
        for (int round = 0; round < 50; ++round) {
            gi::ClipPlanes all;
            gi::ClipPlanes joined;
            for (int run = 0; run < 4; ++run) {
                gi::ClipPlanes of_run;
                for (size_t turns = random() % 40; turns > 0; --turns) {
                    glm::vec3 d(n(random), n(random), n(random));
                    d[int(random() % 3)] *= float(random() % 4 != 0); // an axis that is not used
                    d = glm::normalize(d);
                    all.turn_to(kDims, d);
                    of_run.turn_to(kDims, d);
                }
                joined.then(of_run);
            }
            const glm::vec3 last(-0.6f, 0.48f, 0.64f);
            all.turn_to(kDims, last);
            joined.turn_to(kDims, last);
            for (int i = 0; i < 20; ++i) {
                const glm::vec3 to(n(random) * 30, n(random) * 30, n(random) * 30);
                const glm::vec3 from = to - last * 150.0f;
                REQUIRE(all.clipped_start(from, to) == joined.clipped_start(from, to));
            }
        }
    }
}

} // namespace
