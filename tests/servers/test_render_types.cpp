#include "servers/render_types.h"

#include <doctest/doctest.h>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <initializer_list>

using namespace cl;

namespace {

glm::vec3 ndc(const CameraDesc& camera, glm::ivec2 size, glm::vec3 view_point) {
    const glm::vec4 clip = projection_matrix(camera, size) * glm::vec4(view_point, 1.0f);
    return glm::vec3(clip) / clip.w;
}

void check_near(glm::vec3 found, glm::vec3 expected) {
    CHECK(found.x == doctest::Approx(expected.x).epsilon(1e-4));
    CHECK(found.y == doctest::Approx(expected.y).epsilon(1e-4));
    CHECK(found.z == doctest::Approx(expected.z).epsilon(1e-4));
}

} // namespace

TEST_SUITE("servers/render_types") {
    TEST_CASE("near and far planes map to -1 and 1 in every projection") {
        for (Projection projection : {Projection::Perspective, Projection::Orthogonal, Projection::Frustum}) {
            CameraDesc camera;
            camera.projection = projection;
            camera.near_m = 0.5f;
            camera.far_m = 20.0f;
            CHECK(ndc(camera, {300, 200}, {0.0f, 0.0f, -0.5f}).z == doctest::Approx(-1.0));
            CHECK(ndc(camera, {300, 200}, {0.0f, 0.0f, -20.0f}).z == doctest::Approx(1.0));
        }
    }

    TEST_CASE("the field of view reaches the edge of the kept axis, whatever the shape of the viewport") {
        CameraDesc camera;
        camera.fov_deg = 90.0f; // at distance d the edge is d away
        for (glm::ivec2 size : {glm::ivec2(100, 100), glm::ivec2(400, 100), glm::ivec2(100, 300)}) {
            camera.keep_aspect = KeepAspect::Height;
            CHECK(ndc(camera, size, {0.0f, 3.0f, -3.0f}).y == doctest::Approx(1.0));
            camera.keep_aspect = KeepAspect::Width;
            CHECK(ndc(camera, size, {-3.0f, 0.0f, -3.0f}).x == doctest::Approx(-1.0));
        }
    }

    TEST_CASE("pixels are square in every projection") {
        for (Projection projection : {Projection::Perspective, Projection::Orthogonal, Projection::Frustum}) {
            for (KeepAspect keep : {KeepAspect::Width, KeepAspect::Height}) {
                CameraDesc camera;
                camera.projection = projection;
                camera.keep_aspect = keep;
                const glm::vec3 x = ndc(camera, {640, 360}, {0.01f, 0.0f, -1.0f});
                const glm::vec3 y = ndc(camera, {640, 360}, {0.0f, 0.01f, -1.0f});
                CHECK(x.x * 640.0f == doctest::Approx(y.y * 360.0f).epsilon(1e-4));
            }
        }
    }

    TEST_CASE("an orthogonal camera sees `size` metres along the kept axis") {
        CameraDesc camera;
        camera.projection = Projection::Orthogonal;
        camera.size_m = 8.0f;
        check_near(ndc(camera, {200, 100}, {8.0f, 4.0f, -1.0f}),
                   {1.0f, 1.0f, ndc(camera, {200, 100}, {0, 0, -1}).z});
        camera.keep_aspect = KeepAspect::Width;
        check_near(ndc(camera, {200, 100}, {4.0f, 2.0f, -1.0f}),
                   {1.0f, 1.0f, ndc(camera, {200, 100}, {0, 0, -1}).z});
    }

    TEST_CASE("a frustum's offset shifts what is seen on its near plane") {
        CameraDesc camera;
        camera.projection = Projection::Frustum;
        camera.size_m = 2.0f;
        camera.near_m = 1.0f;
        camera.frustum_offset = {0.5f, -0.25f};
        check_near(ndc(camera, {100, 100}, {1.5f, 0.75f, -1.0f}), {1.0f, 1.0f, -1.0f});
        check_near(ndc(camera, {100, 100}, {-0.5f, -1.25f, -1.0f}), {-1.0f, -1.0f, -1.0f});
    }

    TEST_CASE("a light's box holds every point it can reach") {
        for (LightType type : {LightType::Omni, LightType::Spot}) {
            for (float angle_deg : {1.0f, 45.0f, 80.0f, 90.0f, 130.0f, 180.0f}) {
                LightDesc light;
                light.type = type;
                light.range_m = 3.0f;
                light.spot_angle_deg = angle_deg;
                const AABB box = light_bounds(light);
                for (int i = 0; i < 1000; ++i) {
                    const float polar = static_cast<float>(i % 50) / 49.0f * 3.14159265f;
                    const float turn = static_cast<float>(i / 50) / 20.0f * 6.2831853f;
                    if (type == LightType::Spot && polar > glm::radians(angle_deg)) {
                        continue; // polar is the angle to -Z
                    }
                    const glm::vec3 p =
                        2.999f * glm::vec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                           -std::cos(polar));
                    REQUIRE(box.intersects_inclusive({p, glm::vec3(0.0f)}));
                }
            }
        }
    }

    TEST_CASE("a spot's box is Godot's: tan(angle) * range to the sides, range ahead, nothing behind") {
        LightDesc light;
        light.type = LightType::Spot;
        light.range_m = 4.0f;
        light.spot_angle_deg = 45.0f;
        const AABB box = light_bounds(light);
        check_near(box.position, {-4.0f, -4.0f, -4.0f});
        check_near(box.size, {8.0f, 8.0f, 4.0f});
    }

    TEST_CASE(
        "a material casts a shadow unless it is blended or untested, and always if cut out or pre-passed") {
        MaterialDesc opaque;
        CHECK(opaque.casts_shadow());
        for (auto change : std::initializer_list<void (*)(MaterialDesc&)>{
                 [](MaterialDesc& m) { m.transparent = true; },
                 [](MaterialDesc& m) { m.blend_mode = BlendMode::Add; },
                 [](MaterialDesc& m) { m.no_depth_test = true; }}) {
            MaterialDesc material;
            change(material);
            CHECK(!material.casts_shadow());
            material.alpha_scissor = true;
            CHECK(material.casts_shadow());
            material.alpha_scissor = false;
            material.depth_draw_mode = DepthDrawMode::AlphaOpaquePrepass;
            CHECK(material.casts_shadow());
        }
    }
}
