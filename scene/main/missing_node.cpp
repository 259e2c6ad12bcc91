#include "scene/main/missing_node.h"

#include "scene/3d/camera.h"
#include "scene/3d/geometry_instance.h"
#include "scene/3d/mesh_instance.h"
#include "scene/3d/spatial.h"
#include "scene/3d/visual_instance.h"

#include "core/object/class_registry.h"

#include <string_view>
#include <unordered_map>

namespace cl::scene {

namespace {

enum class Base : uint8_t { Node, Spatial, VisualInstance, GeometryInstance, MeshInstance, Camera };

/// Public node classes of Godot 3.2 that we do not have, by the nearest base that we have.
const std::unordered_map<std::string_view, Base>& bases_of_missing_classes() {
    using enum Base;
    // clang-format off
    static const std::unordered_map<std::string_view, Base> kTable{
        {"ARVRCamera", Camera}, {"ClippedCamera", Camera}, {"InterpolatedCamera", Camera},
        {"SoftBody", MeshInstance},
        {"AnimatedSprite3D", GeometryInstance}, {"CPUParticles", GeometryInstance},
        {"CSGBox", GeometryInstance}, {"CSGCombiner", GeometryInstance}, {"CSGCylinder", GeometryInstance},
        {"CSGMesh", GeometryInstance}, {"CSGPolygon", GeometryInstance}, {"CSGPrimitive", GeometryInstance},
        {"CSGShape", GeometryInstance}, {"CSGSphere", GeometryInstance}, {"CSGTorus", GeometryInstance},
        {"ImmediateGeometry", GeometryInstance}, {"MultiMeshInstance", GeometryInstance},
        {"Particles", GeometryInstance}, {"Sprite3D", GeometryInstance}, {"SpriteBase3D", GeometryInstance},
        {"BakedLightmap", VisualInstance}, {"ReflectionProbe", VisualInstance},
        {"ARVRAnchor", Spatial}, {"ARVRController", Spatial}, {"ARVROrigin", Spatial}, {"Area", Spatial},
        {"AudioStreamPlayer3D", Spatial}, {"BoneAttachment", Spatial}, {"CollisionObject", Spatial},
        {"CollisionPolygon", Spatial}, {"CollisionShape", Spatial}, {"ConeTwistJoint", Spatial},
        {"Generic6DOFJoint", Spatial}, {"GridMap", Spatial}, {"HingeJoint", Spatial}, {"Joint", Spatial},
        {"KinematicBody", Spatial}, {"Listener", Spatial}, {"Navigation", Spatial},
        {"NavigationMeshInstance", Spatial}, {"Path", Spatial}, {"PathFollow", Spatial}, {"PhysicalBone", Spatial},
        {"PhysicsBody", Spatial}, {"PinJoint", Spatial}, {"Position3D", Spatial}, {"ProximityGroup", Spatial},
        {"RayCast", Spatial}, {"RemoteTransform", Spatial}, {"RigidBody", Spatial}, {"Room", Spatial},
        {"Skeleton", Spatial}, {"SliderJoint", Spatial}, {"SpringArm", Spatial}, {"StaticBody", Spatial},
        {"VehicleBody", Spatial}, {"VehicleWheel", Spatial}, {"VisibilityEnabler", Spatial},
        {"VisibilityNotifier", Spatial},
        {"AnimatedSprite", Node}, {"AnimationPlayer", Node}, {"AnimationTree", Node}, {"AnimationTreePlayer", Node},
        {"Area2D", Node}, {"AudioStreamPlayer", Node}, {"AudioStreamPlayer2D", Node}, {"Bone2D", Node},
        {"Button", Node}, {"CanvasItem", Node}, {"CanvasLayer", Node}, {"CanvasModulate", Node},
        {"CenterContainer", Node}, {"CheckBox", Node}, {"CheckButton", Node}, {"Camera2D", Node},
        {"CollisionPolygon2D", Node}, {"CollisionShape2D", Node}, {"ColorRect", Node}, {"Container", Node},
        {"Control", Node}, {"FileDialog", Node}, {"GridContainer", Node}, {"HBoxContainer", Node},
        {"HScrollBar", Node}, {"HSlider", Node}, {"HSplitContainer", Node}, {"HTTPRequest", Node},
        {"InstancePlaceholder", Node}, {"ItemList", Node}, {"KinematicBody2D", Node}, {"Label", Node},
        {"Light2D", Node}, {"Line2D", Node}, {"LineEdit", Node}, {"MarginContainer", Node}, {"MenuButton", Node},
        {"MeshInstance2D", Node}, {"Navigation2D", Node}, {"NinePatchRect", Node}, {"Node2D", Node},
        {"OptionButton", Node}, {"Panel", Node}, {"PanelContainer", Node}, {"ParallaxBackground", Node},
        {"ParallaxLayer", Node}, {"Particles2D", Node}, {"Path2D", Node}, {"PathFollow2D", Node}, {"Polygon2D", Node},
        {"Popup", Node}, {"PopupMenu", Node}, {"Position2D", Node}, {"ProgressBar", Node}, {"RayCast2D", Node},
        {"ResourcePreloader", Node}, {"RichTextLabel", Node}, {"RigidBody2D", Node}, {"ScrollContainer", Node},
        {"Skeleton2D", Node}, {"SkeletonIK", Node}, {"SpinBox", Node}, {"Sprite", Node}, {"StaticBody2D", Node},
        {"TabContainer", Node}, {"Tabs", Node}, {"TextEdit", Node}, {"TextureButton", Node},
        {"TextureProgress", Node}, {"TextureRect", Node}, {"TileMap", Node}, {"Timer", Node}, {"Tree", Node},
        {"Tween", Node}, {"VBoxContainer", Node}, {"VScrollBar", Node}, {"VSlider", Node}, {"VSplitContainer", Node},
        {"VideoPlayer", Node}, {"Viewport", Node}, {"ViewportContainer", Node}, {"VisibilityNotifier2D", Node},
        {"YSort", Node},
    };
    // clang-format on
    return kTable;
}

std::unique_ptr<Node> make_base(Base base) {
    switch (base) {
    case Base::Camera:
        return std::make_unique<Camera>();
    case Base::MeshInstance:
        return std::make_unique<MeshInstance>();
    case Base::GeometryInstance:
        return std::make_unique<GeometryInstance>();
    case Base::VisualInstance:
        return std::make_unique<VisualInstance>();
    case Base::Spatial:
        return std::make_unique<Spatial>();
    case Base::Node:
        break;
    }
    return std::make_unique<Node>();
}

CreatedNode stand_in(const StringName& class_name, Base base, NodeSupport support) {
    CreatedNode created{make_base(base), support};
    created.node->set_declared_class(class_name);
    return created;
}

} // namespace

CreatedNode create_node(const ClassRegistry& registry, const StringName& class_name, TransformHint hint) {
    static const StringName kSpatial(Spatial::kClassName);
    if (const ClassInfo* info = registry.find(class_name)) {
        std::unique_ptr<Object> object = info->create ? info->create() : nullptr;
        if (auto* node = dynamic_cast<Node*>(object.get())) {
            static_cast<void>(object.release());
            return {std::unique_ptr<Node>(node), NodeSupport::Full};
        }
        return stand_in(class_name, info->is_a(kSpatial) ? Base::Spatial : Base::Node, NodeSupport::StandIn);
    }
    const auto known = bases_of_missing_classes().find(class_name.view());
    if (known != bases_of_missing_classes().end()) {
        return stand_in(class_name, known->second, NodeSupport::StandIn);
    }
    return stand_in(class_name, hint == TransformHint::HasTransform ? Base::Spatial : Base::Node,
                    NodeSupport::Unknown);
}

} // namespace cl::scene
