#pragma once

#include "drivers/embree/rasterizer_embree.h"

#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include "core/image.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace cl::tests {

/// A colour that shading sees as this linear one.
inline Color encoded(const glm::vec3& linear) {
    const glm::vec3 c = srgb_from_linear(linear);
    return {c.r, c.g, c.b, 1.0f};
}

/// Diffuse alone: what the closed forms speak of.
inline MaterialDesc lambert(const glm::vec3& albedo) {
    MaterialDesc m;
    m.albedo = encoded(albedo);
    m.diffuse_mode = DiffuseMode::Lambert;
    m.specular_mode = SpecularMode::Disabled;
    return m;
}

/// A black surface that glows.
inline MaterialDesc glowing(const glm::vec3& radiance) {
    MaterialDesc m = lambert(glm::vec3(0.0f));
    m.emission_enabled = true;
    m.emission = encoded(radiance / std::max({radiance.x, radiance.y, radiance.z}));
    m.emission_energy = std::max({radiance.x, radiance.y, radiance.z});
    return m;
}

/// A square in the plane y = 0 whose front is up; uv runs from 0 to 1 along x and z.
inline MeshSurface square(float half_m) {
    SurfaceArrays a;
    a.positions = {{-half_m, 0, -half_m}, {half_m, 0, -half_m}, {half_m, 0, half_m}, {-half_m, 0, half_m}};
    a.normals.assign(4, {0.0f, 1.0f, 0.0f});
    a.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    a.indices = {0, 1, 2, 0, 2, 3};
    return std::move(encode_surface(a, PrimitiveType::Triangles, 0)).value();
}

/// A cube of edge 1 around the origin, fronts outside, sharp edges.
inline MeshSurface cube() {
    SurfaceArrays a;
    for (int axis = 0; axis < 3; ++axis) {
        for (float side : {-0.5f, 0.5f}) {
            const auto base = static_cast<uint32_t>(a.positions.size());
            glm::vec3 n(0.0f), u(0.0f);
            n[axis] = 2.0f * side;
            u[(axis + 1) % 3] = 1.0f;
            const glm::vec3 v = glm::cross(n, u);
            for (glm::vec2 c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                a.positions.push_back(0.5f * (n + c.x * u + c.y * v));
                a.normals.push_back(n);
            }
            a.indices.insert(a.indices.end(), {base, base + 2, base + 1, base, base + 3, base + 2});
        }
    }
    return std::move(encode_surface(a, PrimitiveType::Triangles, 0)).value();
}

inline Transform placed(const glm::vec3& at, const glm::mat3& basis = glm::mat3(1.0f)) {
    return {basis, at};
}
/// Turns up into down, so that a square faces the floor.
inline glm::mat3 upside_down() {
    return glm::mat3(glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1));
}
/// Local -z points along `direction`.
inline glm::mat3 looking(const glm::vec3& direction) {
    const glm::vec3 z = -glm::normalize(direction);
    const glm::vec3 x =
        glm::normalize(glm::cross(std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, -1), z));
    return glm::mat3(x, glm::cross(z, x), z);
}

/// A world, a camera and a server that path traces, with every call checked on its way.
class TracedWorld {
public:
    explicit TracedWorld(const embree::PathOptions& options, glm::ivec2 size = {8, 8})
        : server(std::make_unique<RasterizerChecked>(std::make_unique<embree::RasterizerEmbree>(options))) {
        scenario = server.scenario_create();
        environment = server.environment_create();
        set_ambient(glm::vec3(0.0f));
        REQUIRE(server.scenario_set_environment(scenario, environment));
        camera = server.camera_create();
        viewport = server.viewport_create(size);
        REQUIRE(server.viewport_set_scenario(viewport, scenario));
        REQUIRE(server.viewport_set_camera(viewport, camera));
    }
    /// The same radiance from all around, and as background.
    void set_ambient(const glm::vec3& radiance) {
        EnvironmentDesc e;
        e.background_mode = BackgroundMode::Color;
        e.background_color = e.ambient_color = encoded(radiance);
        e.ambient_sky_contribution = 0.0f;
        REQUIRE(server.environment_set(environment, e));
    }
    /// Looks at one point from `eye`: the picture shows a square of edge `size_m` around it, in parallel
    /// view.
    void look(const glm::vec3& eye, const glm::vec3& at, float size_m) {
        CameraDesc c;
        c.projection = Projection::Orthogonal;
        c.size_m = size_m;
        c.world_from_camera = placed(eye, looking(at - eye));
        REQUIRE(server.camera_set(camera, c));
    }
    RID add(const MeshSurface& surface, const MaterialDesc& material, const Transform& place = {}) {
        const RID mesh = server.mesh_create({surface}).value();
        REQUIRE(server.mesh_surface_set_material(mesh, 0, server.material_create(material)));
        return stand(mesh, place);
    }
    RID add(const LightDesc& light, const Transform& place) {
        return stand(server.light_create(light), place);
    }

    Image radiance() {
        REQUIRE(server.draw());
        return server.viewport_read(viewport, TargetFormat::LinearFloat).value();
    }
    /// Mean radiance of the picture.
    glm::vec3 mean() {
        const Image image = radiance();
        glm::dvec3 sum(0.0);
        const auto values = std::as_const(image).floats();
        for (size_t i = 0; i < values.size(); ++i) {
            sum[static_cast<glm::length_t>(i % 3)] += static_cast<double>(values[i]);
        }
        return glm::vec3(sum * (3.0 / static_cast<double>(values.size())));
    }

    VisualServer server;
    RID scenario, environment, camera, viewport;

private:
    RID stand(RID base, const Transform& place) {
        const RID instance = server.instance_create(base, scenario);
        REQUIRE(server.instance_set_transform(instance, place));
        return instance;
    }
};

} // namespace cl::tests
