#include "tests/drivers/embree/traced_world.h"

#include <doctest/doctest.h>

using namespace cl;
using namespace cl::tests;
using embree::PathOptions;

namespace {

PathOptions many_samples() {
    PathOptions options;
    options.samples = 256;
    return options;
}

/// 2x1 texels: nothing, and half of a white one.
Image half_image() {
    Image image{{2, 1}, PixelFormat::RGBA8, {255, 255, 255, 0, 255, 255, 255, 128}};
    return image;
}

} // namespace

TEST_SUITE("drivers/embree/see_through") {
    TEST_CASE("a surface of opacity a shows a of itself and 1 - a of what is behind, several in a row too") {
        MaterialDesc glass;
        glass.unshaded = true;
        glass.transparent = true;
        glass.albedo = {1, 1, 1, 0.25f};
        TracedWorld world(many_samples(), {16, 16});
        world.set_ambient({0.0f, 0.0f, 0.5f});
        world.add(square(5.0f), glass);
        world.look({0, 1, 0}, {0, 0, 0}, 1.0f);
        CHECK(world.mean().x == doctest::Approx(0.25f).epsilon(0.01));
        CHECK(world.mean().z == doctest::Approx(0.25f + 0.75f * 0.5f).epsilon(0.01));
        world.add(square(5.0f), glass, placed({0, -1, 0}));
        CHECK(world.mean().x == doctest::Approx(1.0f - 0.75f * 0.75f).epsilon(0.01));
    }

    TEST_CASE("its shadow takes its opacity of the light") {
        MaterialDesc veil = lambert(glm::vec3(0.0f));
        veil.transparent = true;
        veil.albedo.a = 0.3f;
        TracedWorld world(many_samples(), {16, 16});
        world.add(square(5.0f), lambert(glm::vec3(1.0f)));
        world.add(square(1.0f), veil, placed({0, 1, 0}));
        LightDesc sun;
        sun.type = LightType::Directional;
        sun.shadow = true;
        world.add(sun, placed({}, looking({0, -1, 0})));
        world.look({2, 0.5f, 0}, {0, 0, 0}, 0.1f);
        CHECK(world.mean().x == doctest::Approx(0.7f).epsilon(0.02));
    }

    TEST_CASE("alpha scissor cuts holes where the texture is below it and is solid elsewhere") {
        MaterialDesc leaf;
        leaf.unshaded = true;
        leaf.alpha_scissor = true;
        leaf.alpha_scissor_threshold = 0.4f;
        TracedWorld world(many_samples(), {2, 1});
        TextureParams params;
        params.filter = params.repeat = false;
        leaf.albedo_texture = world.server.texture_create(half_image(), params);
        world.set_ambient({0.0f, 0.0f, 0.5f});
        world.add(square(1.0f), leaf);
        // Straight down: x of the picture is x of the world.
        world.look({0, 1, 0}, {0, 0, 0}, 0.5f);
        const Image image = world.radiance();
        const auto v = std::as_const(image).floats();
        CHECK(v[0] == 0.0f);
        CHECK(v[2] == doctest::Approx(0.5f));
        CHECK(v[3] == 1.0f);
    }

    TEST_CASE("the camera's cull mask hides a surface from the eye, not from light") {
        TracedWorld world(many_samples());
        world.set_ambient(glm::vec3(1.0f));
        world.add(square(1.0f), lambert(glm::vec3(1.0f)));
        const RID roof = world.add(cube(), lambert(glm::vec3(0.0f)), placed({0, 1.5f, 0}, glm::mat3(2.0f)));
        CameraDesc camera;
        camera.projection = Projection::Orthogonal;
        camera.size_m = 0.1f;
        camera.cull_mask = 1;
        camera.world_from_camera = placed({0, 5, 0}, looking({0, -1, 0}));
        REQUIRE(world.server.camera_set(world.camera, camera));
        CHECK(world.mean().x == 0.0f); // the black roof
        REQUIRE(world.server.instance_set_layers(roof, 2));
        const float under_roof = world.mean().x;
        CHECK(under_roof > 0.05f); // the floor, in the roof's shade
        CHECK(under_roof < 0.8f);
    }
}
