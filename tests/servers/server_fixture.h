#pragma once

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include <doctest/doctest.h>

#include <memory>
#include <utility>
#include <vector>

namespace cl::tests {

inline Transform at(float x, float y, float z) {
    Transform t;
    t.origin = {x, y, z};
    return t;
}

/// A box mesh of 12 triangles, centred.
inline MeshSurface box_surface(glm::vec3 half_m = glm::vec3(0.5f)) {
    SurfaceArrays arrays;
    for (int corner = 0; corner < 8; ++corner) {
        arrays.positions.push_back(half_m * glm::vec3(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f,
                                                      corner & 4 ? 1.0f : -1.0f));
    }
    arrays.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                      2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    Expected<MeshSurface> surface = encode_surface(arrays, PrimitiveType::Triangles);
    REQUIRE(surface);
    return std::move(surface).value();
}

/// A server over the recording rasteriser that finds GI by cones unless told otherwise, with every call
/// checked on its way; one world with one camera at (0, 0, 10) that looks along -Z.
struct ServerFixture {
    dummy::DummyRasterizer* dummy; ///< owned by the server
    VisualServer server;
    RID scenario, camera, viewport;

    ServerFixture() : ServerFixture(std::make_unique<dummy::DummyRasterizer>()) {}

    void set_gi(GIMode mode) {
        RenderSettings settings = server.settings();
        settings.gi_mode = mode;
        server.set_settings(settings);
    }
    RID mesh(glm::vec3 half_m = glm::vec3(0.5f), int surfaces = 1) {
        Expected<RID> made =
            server.mesh_create(std::vector<MeshSurface>(static_cast<size_t>(surfaces), box_surface(half_m)));
        REQUIRE(made);
        return *made;
    }
    RID place(RID base, const Transform& world_from_local = {}) {
        const RID instance = server.instance_create(base, scenario);
        REQUIRE(server.instance_set_transform(instance, world_from_local));
        return instance;
    }
    RID place_box(float x, float y, float z) { return place(mesh(), at(x, y, z)); }
    RID place_light(const LightDesc& desc, const Transform& world_from_local = {}) {
        return place(server.light_create(desc), world_from_local);
    }
    const dummy::RecordedFrame& draw() {
        const Status drawn = server.draw();
        REQUIRE_MESSAGE(drawn.ok(), (drawn.ok() ? std::string() : drawn.error().message));
        REQUIRE(dummy->last_frame());
        return *dummy->last_frame();
    }

private:
    explicit ServerFixture(std::unique_ptr<dummy::DummyRasterizer> recorder)
        : dummy(recorder.get()), server(std::make_unique<RasterizerChecked>(std::move(recorder))) {
        set_gi(GIMode::Cones);
        scenario = server.scenario_create();
        CameraDesc desc;
        desc.world_from_camera = at(0.0f, 0.0f, 10.0f);
        camera = server.camera_create(desc);
        viewport = server.viewport_create({64, 64});
        REQUIRE(server.viewport_set_scenario(viewport, scenario));
        REQUIRE(server.viewport_set_camera(viewport, camera));
    }
};

} // namespace cl::tests
