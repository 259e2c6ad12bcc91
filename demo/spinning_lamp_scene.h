#pragma once

#include "scene/3d/camera.h"
#include "scene/3d/gi_probe.h"
#include "scene/3d/mesh_instance.h"
#include "scene/3d/omni_light.h"
#include "scene/resources/primitive_meshes.h"
#include "scene/resources/spatial_material.h"

#include "core/object/class_registry.h"

#include <cmath>
#include <memory>
#include <numbers>

// The scene of demo/spinning_lamp.cpp, which tests/scene/test_scripted_probe.cpp runs without graphics.
namespace cl::demo {

/// Swings its node about where it was when ready, and halves or restores a probe's propagation at each turn.
class Swing final : public scene::ScriptInstance {
public:
    static constexpr std::string_view kClassName = "Swing";
    static void bind(ClassBuilder<Swing>& c) {
        c.property(
             "reach", [](const Swing& s) { return s.reach_m_; }, [](Swing& s, float v) { s.reach_m_ = v; })
            .doc("Greatest distance from the middle [m].");
        c.property(
             "period", [](const Swing& s) { return s.period_s_; }, [](Swing& s, float v) { s.period_s_ = v; })
            .doc("Time of a swing to and fro [s].");
    }
    void ready(scene::Node& node) override {
        middle_ = dynamic_cast<scene::Spatial&>(node).translation();
        probe_ = node.get_node_as<scene::GIProbe>("../Probe");
    }
    void process(scene::Node& node, double delta_s) override {
        time_s_ += delta_s;
        const double turns = time_s_ / period_s_;
        const auto offset_m = static_cast<float>(reach_m_ * std::sin(2.0 * std::numbers::pi * turns));
        dynamic_cast<scene::Spatial&>(node).set_translation(middle_ + glm::vec3(offset_m, 0.0f, 0.0f));
        if (probe_) {
            probe_->set_propagation(std::fmod(turns, 1.0) < 0.5 ? 0.7f : 0.35f);
        }
    }

private:
    float reach_m_ = 1.0f;
    float period_s_ = 2.0f;
    double time_s_ = 0.0;
    glm::vec3 middle_{0.0f};
    scene::GIProbe* probe_ = nullptr; // a sibling, which lives as long as this node's parent
};

inline void add_wall(scene::Node& room, const glm::vec3& center_m, const glm::vec3& size_m,
                     const Color& color) {
    auto material = make_ref<scene::SpatialMaterial>();
    scene::SpatialParams params;
    params.albedo = color;
    material->set_params(params);
    auto& wall = room.add_new<scene::MeshInstance>("Wall");
    wall.set_mesh(make_ref<scene::CubeMesh>(scene::CubeShape{.size = size_m}));
    wall.set_surface_material(0, material);
    wall.set_translation(center_m);
    wall.set_use_in_baked_light(true);
}

/// A room of 4 x 4 x 4 m, open to the front, red on the left and green on the right, with a lamp that swings.
/// @param subdiv  how fine its probe is; not yet baked.
inline std::unique_ptr<scene::Spatial> make_spinning_lamp_scene(scene::GIProbeSubdiv subdiv) {
    ClassRegistry::instance().add<Swing, scene::ScriptInstance>();
    auto room = std::make_unique<scene::Spatial>();
    room->set_name("Room");
    const Color white{0.85f, 0.85f, 0.85f, 1.0f};
    add_wall(*room, {0.0f, -0.1f, 0.0f}, {4.4f, 0.2f, 4.0f}, white);
    add_wall(*room, {0.0f, 4.1f, 0.0f}, {4.4f, 0.2f, 4.0f}, white);
    add_wall(*room, {0.0f, 2.0f, -2.1f}, {4.4f, 4.0f, 0.2f}, white);
    add_wall(*room, {-2.1f, 2.0f, 0.0f}, {0.2f, 4.0f, 4.0f}, {0.8f, 0.15f, 0.15f, 1.0f});
    add_wall(*room, {2.1f, 2.0f, 0.0f}, {0.2f, 4.0f, 4.0f}, {0.2f, 0.7f, 0.2f, 1.0f});
    add_wall(*room, {0.3f, 0.6f, -0.4f}, {1.2f, 1.2f, 1.2f}, white);

    auto& probe = room->add_new<scene::GIProbe>("Probe");
    probe.set_translation({0.0f, 2.0f, 0.0f});
    probe.set_extents({2.3f, 2.3f, 2.3f});
    probe.set_subdiv(subdiv);
    probe.set_interior(true);

    auto& lamp = room->add_new<scene::OmniLight>("Lamp");
    lamp.set_translation({0.0f, 3.0f, 0.3f});
    lamp.edit([](LightDesc& d) {
        d.range_m = 7.0f;
        d.energy = 1.2f;
        d.shadow = true;
    });
    lamp.set_script_instance(std::make_unique<Swing>());
    lamp.set("reach", 1.4);

    auto& camera = room->add_new<scene::Camera>("Camera");
    camera.set_translation({0.0f, 2.0f, 6.5f});
    camera.set_fov(45.0f);
    return room;
}

} // namespace cl::demo
