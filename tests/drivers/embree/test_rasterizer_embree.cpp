#include "tests/drivers/embree/traced_world.h"

#include "servers/shading/tone_map.h"

#include <doctest/doctest.h>

#include <limits>
#include <utility>

using namespace cl;
using namespace cl::tests;
using embree::PathOptions;
using embree::RasterizerEmbree;

TEST_SUITE("drivers/embree/rasterizer_embree") {
    TEST_CASE("the picture shown is the radiance after exposure, tone mapper, sRGB and adjustments") {
        PathOptions options;
        options.samples = 2;
        TracedWorld world(options);
        EnvironmentDesc e;
        e.background_mode = BackgroundMode::Color;
        e.background_color = encoded({0.9f, 0.4f, 0.1f});
        e.tone_mapper = ToneMapper::Filmic;
        e.exposure = 1.7f;
        e.white = 3.0f;
        e.adjustment_enabled = true;
        e.contrast = 1.2f;
        REQUIRE(world.server.environment_set(world.environment, e));
        const Image radiance = world.radiance();
        const Image shown = world.server.viewport_read(world.viewport, TargetFormat::Srgb8).value();
        REQUIRE(shown.format == PixelFormat::RGBA8);
        const auto v = std::as_const(radiance).floats();
        const glm::vec3 linear(v[0], v[1], v[2]);
        CHECK(linear.x == doctest::Approx(0.9f).epsilon(1e-4)); // exposure is not in it
        const glm::vec3 curve = srgb_from_linear(shading::tone_map(1.7f * linear, ToneMapper::Filmic, 3.0f));
        const glm::vec3 expected = shading::adjust(curve, {1.0f, 1.2f, 1.0f});
        for (int c = 0; c < 3; ++c) {
            CHECK(shown.data[static_cast<size_t>(c)] == shading::byte_from_encoded(expected[c]));
        }
        CHECK(shown.data[3] == 255);
    }

    TEST_CASE("GI data is refused, stale RIDs too, and everything made can be freed once") {
        RasterizerEmbree rasterizer(PathOptions{});
        CHECK(rasterizer.gi_volume_create({{8, 8, 8}, 1}).error().code == ErrorCode::Unsupported);
        CHECK(rasterizer.gi_field_create({}).error().code == ErrorCode::Unsupported);
        const MeshSurface surface = square(1.0f);
        const RID mesh = rasterizer.mesh_create(std::span(&surface, 1)).value();
        const RID target = rasterizer.target_create({2, 2}).value();
        Frame frame;
        frame.size = {3, 3};
        CHECK_FALSE(rasterizer.draw(target, frame));
        frame.size = {2, 2};
        const MaterialDesc material;
        WorldItem item;
        item.mesh = mesh;
        item.material = &material;
        frame.world = std::span(&item, 1);
        CHECK(rasterizer.draw(target, frame));
        CHECK(rasterizer.last_stats().triangles == 2);
        CHECK(rasterizer.last_stats().rays >= 2 * 2 * PathOptions{}.samples);
        CHECK(rasterizer.free(mesh));
        CHECK_FALSE(rasterizer.free(mesh));
        CHECK_FALSE(rasterizer.draw(target, frame));
        CHECK(rasterizer.free(target));
    }

    TEST_CASE("an empty scene, one of lines and one of corners at infinity are the background") {
        const float far = std::numeric_limits<float>::infinity();
        SurfaceArrays line, broken;
        line.positions = {{-1, 0, 0}, {1, 0, 0}};
        broken.positions = {{far, 0, 0}, {0, far, 0}, {0, 0, -far}};
        for (const MeshSurface& surface : {encode_surface(line, PrimitiveType::Lines, 0).value(),
                                           encode_surface(broken, PrimitiveType::Triangles, 0).value()}) {
            PathOptions options;
            options.samples = 1;
            TracedWorld world(options);
            world.set_ambient({0.0f, 0.5f, 0.0f});
            world.look({0, 0, 5}, {0, 0, 0}, 1.0f);
            CHECK(world.mean().y == doctest::Approx(0.5f).epsilon(1e-4));
            world.add(surface, lambert(glm::vec3(1.0f)));
            CHECK(world.mean().y == doctest::Approx(0.5f).epsilon(1e-4));
        }
    }

    TEST_CASE("strips and fans show the same faces as single triangles") {
        SurfaceArrays strip, fan;
        strip.positions = {{-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {1, 0, 1}};
        fan.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
        for (const MeshSurface& surface :
             {encode_surface(strip, PrimitiveType::TriangleStrip, 0).value(),
              encode_surface(fan, PrimitiveType::TriangleFan, 0).value(), square(1.0f)}) {
            PathOptions options;
            options.samples = 1;
            TracedWorld world(options);
            MaterialDesc white;
            white.unshaded = true;
            world.add(surface, white);
            world.look({0, 1, 0}, {0, 0, 0}, 1.0f);
            CHECK(world.mean().x == 1.0f);
            world.look({0, -1, 0}, {0, 0, 0}, 1.0f); // the culled side
            CHECK(world.mean().x == 0.0f);
        }
    }

    TEST_CASE("a picture is upright and not mirrored, in perspective and in parallel view") {
        for (Projection projection : {Projection::Perspective, Projection::Orthogonal}) {
            PathOptions options;
            options.samples = 16;
            TracedWorld world(options, {4, 4});
            MaterialDesc white;
            white.unshaded = true;
            white.cull_mode = CullMode::Disabled;
            // To the right and up, upright before a camera that looks along -z.
            world.add(cube(), white, placed({1.0f, 1.0f, 0}, glm::mat3(1.0f)));
            CameraDesc camera;
            camera.projection = projection;
            camera.fov_deg = 43.6f; // 4 m at 5 m
            camera.size_m = 4.0f;
            camera.world_from_camera = placed({0, 0, 5});
            REQUIRE(world.server.camera_set(world.camera, camera));
            const Image image = world.radiance();
            const auto v = std::as_const(image).floats();
            float upper_right = 0.0f, elsewhere = 0.0f;
            for (size_t y = 0; y < 4; ++y) {
                for (size_t x = 0; x < 4; ++x) {
                    (x >= 2 && y < 2 ? upper_right : elsewhere) += v[(y * 4 + x) * 3];
                }
            }
            CHECK(upper_right > 0.9f); // a quarter of each of four pixels, more in perspective
            CHECK(upper_right < 1.6f);
            CHECK(elsewhere == 0.0f);
        }
    }
}
