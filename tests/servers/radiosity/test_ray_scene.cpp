#include "servers/radiosity/ray_scene.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

using namespace cl;
using namespace cl::radiosity;

namespace {

/// One triangle in the plane z = 0, its front towards +z.
StillScene one_triangle() {
    StillScene scene;
    scene.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    scene.uvs.assign(3, glm::vec2(0.0f));
    scene.triangles = {{0, 1, 2}};
    scene.surface_of = {0};
    scene.surfaces = {{}};
    return scene;
}

} // namespace

TEST_SUITE("servers/radiosity/ray_scene") {
    TEST_CASE(
        "a ray that is not a number or out of all reach meets nothing, and its neighbours what they do") {
        const StillScene scene = one_triangle();
        const Expected<RayScene> rays = RayScene::create(scene);
        REQUIRE(rays.has_value());
        const glm::vec3 before{0.0f, 0.0f, 2.0f}, towards{0.0f, 0.0f, -1.0f};
        const std::array<Ray, 7> asked{{
            {before, towards},
            {{NAN, 0.0f, 2.0f}, towards},
            {before, {0.0f, INFINITY, -1.0f}},
            {{0.0f, 0.0f, 1e30f}, towards},
            {before, towards, NAN},
            {before, towards, -1.0f},
            {before, towards},
        }};
        std::array<Hit, asked.size()> hits;
        rays->trace(asked, hits);
        for (size_t i = 0; i < asked.size(); ++i) {
            CAPTURE(i);
            const bool is_sound = i == 0 || i + 1 == asked.size();
            CHECK((hits[i].triangle == 0) == is_sound);
            CHECK(rays->is_blocked(asked[i]) == is_sound);
        }
        CHECK(hits[0].t == doctest::Approx(2.0f));
    }
}
