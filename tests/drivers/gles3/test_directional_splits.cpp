#include "drivers/gles3/directional_splits.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <vector>

using namespace cl;
using namespace cl::gles3;

namespace {

Transform looking(const glm::vec3& eye, const glm::vec3& target) {
    const glm::mat4 m = glm::inverse(glm::lookAt(eye, target, glm::vec3(0, 1, 0)));
    return {glm::mat3(m), glm::vec3(m[3])};
}

/// A sun with casters of the given boxes.
struct Sun {
    explicit Sun(const std::vector<AABB>& boxes) {
        for (const AABB& box : boxes) {
            casters.emplace_back().world_bounds = box;
        }
        desc.type = LightType::Directional;
        light.desc = &desc;
        light.casters = casters;
        light.world_from_light = looking({3, 5, 2}, {0, 0, 0});
        light.world_from_light.origin = {};
    }
    DirectionalShadow fit(const glm::vec3& eye, ShadowFit shadow_fit) {
        Frame frame;
        frame.size = {480, 270};
        frame.camera.world_from_camera = looking(eye, {0, 0.5f, 0});
        frame.shadow_fit = shadow_fit;
        frame.casters_bounds = casters[0].world_bounds;
        return fit_directional_shadow(light, frame, {4096, 4096});
    }

    LightDesc desc;
    LightItem light;
    std::vector<CasterItem> casters;
};

} // namespace

TEST_SUITE("drivers/gles3/directional_splits") {
    TEST_CASE("a scene smaller than the first split has the map to itself, wherever the camera is") {
        Sun sun({{glm::vec3(-2, 0, -2), glm::vec3(4, 2, 4)}});
        const DirectionalShadow a = sun.fit({4, 2, 1}, ShadowFit::ByTexel);
        const DirectionalShadow b = sun.fit({-30, 9, 20}, ShadowFit::ByTexel);
        CHECK(a.count == 1);
        const DirectionalSplit& split = a.splits[0];
        CHECK(split.tile_size == glm::vec2(1.0f));
        CHECK(glm::vec2(split.low_m) == glm::vec2(b.splits[0].low_m));
        CHECK(glm::vec2(split.high_m) == glm::vec2(b.splits[0].high_m));
        // Every corner is inside, and the margin is a few texels.
        const AABB seen = transformed(a.light_from_world, sun.casters[0].world_bounds);
        for (int axis = 0; axis < 2; ++axis) {
            const float texel_m = (split.high_m[axis] - split.low_m[axis]) / 4096.0f;
            CHECK(split.low_m[axis] < seen.position[axis] - 3.0f * texel_m);
            CHECK(split.high_m[axis] > seen.end()[axis] + 3.0f * texel_m);
            CHECK(seen.size[axis] / texel_m > 4080.0f);
        }
        CHECK(a.fade_begin_m > split.end_m);
    }

    TEST_CASE("a scene wider than all splits is cut into as many as the light asks for") {
        Sun sun({{glm::vec3(-400, 0, -400), glm::vec3(800, 2, 800)}});
        CHECK(sun.fit({4, 2, 1}, ShadowFit::ByTexel).count == 4);
        sun.desc.directional_mode = DirectionalShadowMode::PSSM2;
        CHECK(sun.fit({4, 2, 1}, ShadowFit::ByTexel).count == 2);
    }

    TEST_CASE("as set, biases grow with the splits; by texel there are none") {
        Sun sun({{glm::vec3(-400, 0, -400), glm::vec3(800, 2, 800)}});
        const DirectionalShadow set = sun.fit({4, 2, 1}, ShadowFit::AsSet);
        const DirectionalShadow texel = sun.fit({4, 2, 1}, ShadowFit::ByTexel);
        CHECK(set.splits[0].bias.caster_m ==
              glm::vec2(sun.desc.shadow_bias_m, sun.desc.directional_normal_bias));
        CHECK(set.splits[3].bias.caster_m.x > set.splits[0].bias.caster_m.x);
        CHECK(set.splits[3].bias.step_texels == 0.0f);
        CHECK(texel.splits[3].bias.caster_m == glm::vec2(0.0f));
        CHECK(texel.splits[3].bias.step_texels > 0.0f);
    }
}
