#include "demo/offscreen_server.h"

#include "drivers/embree/rasterizer_embree.h"

#include "core/image.h"
#include "core/math/color.h"

#include <doctest/doctest.h>

#include <memory>
#include <utility>

namespace {

using namespace cl;

/// A quad that fills the picture, one colour on its left edge and another on its right.
MeshSurface gradient(float left, float right) {
    SurfaceArrays a;
    a.positions = {{-1, -1, 0}, {-1, 1, 0}, {1, -1, 0}, {1, 1, 0}};
    a.normals.assign(4, {0.0f, 0.0f, 1.0f});
    a.colors = {
        {left, left, left, 1}, {left, left, left, 1}, {right, right, right, 1}, {right, right, right, 1}};
    a.indices = {0, 1, 2, 1, 3, 2};
    Expected<MeshSurface> surface = encode_surface(a, PrimitiveType::Triangles, 0);
    REQUIRE(surface);
    return *std::move(surface);
}

/// Radiance of the pixel in the middle of the picture.
float middle_of(VisualServer& server, const MeshSurface& surface, bool is_srgb) {
    MaterialDesc material;
    material.unshaded = true;
    material.cull_mode = CullMode::Disabled;
    material.vertex_color_use_as_albedo = true;
    material.vertex_color_is_srgb = is_srgb;
    CameraDesc camera;
    camera.projection = Projection::Orthogonal;
    camera.size_m = 2.0f;
    camera.world_from_camera.origin.z = 1.0f;
    const RID scenario = server.scenario_create(), mesh = server.mesh_create({surface}).value();
    REQUIRE(server.mesh_surface_set_material(mesh, 0, server.material_create(material)));
    server.instance_create(mesh, scenario);
    const RID viewport = server.viewport_create({65, 65});
    REQUIRE(server.viewport_set_scenario(viewport, scenario));
    REQUIRE(server.viewport_set_camera(viewport, server.camera_create(camera)));
    REQUIRE(server.draw());
    const Image image = server.viewport_read(viewport, TargetFormat::LinearFloat).value();
    REQUIRE(server.free(viewport));
    return image.floats()[(32 * 65 + 32) * 3];
}

void check_gradients(VisualServer& server) {
    const MeshSurface surface = gradient(0.2f, 0.8f);
    const float of_light = 0.5f * (linear_from_srgb(0.2f) + linear_from_srgb(0.8f));
    CHECK(middle_of(server, surface, true) == doctest::Approx(of_light).epsilon(0.01)); // 8-bit colours
    CHECK(middle_of(server, surface, false) == doctest::Approx(0.5f).epsilon(0.01));
}

} // namespace

TEST_SUITE("demo/vertex_colors") {
    // Godot 3.2.3 draws 187 in the middle between codes 0 and 255, which is half the light.
    TEST_CASE("[gl] between vertices of sRGB colours their light is mixed, not their codes") {
        const Expected<std::unique_ptr<VisualServer>> server = demo::make_offscreen_server();
        REQUIRE(server);
        check_gradients(**server);
    }

    TEST_CASE("the path tracer mixes vertex colours in the same way") {
        embree::PathOptions options;
        options.samples = 16;
        VisualServer server(
            std::make_unique<RasterizerChecked>(std::make_unique<embree::RasterizerEmbree>(options)));
        check_gradients(server);
    }
}
