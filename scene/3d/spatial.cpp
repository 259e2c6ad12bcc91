#include "scene/3d/spatial.h"

#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"
#include "scene/resources/mesh.h"

#include "core/object/class_registry.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace cl::scene {

namespace {

bool is_singular(const glm::mat3& m) {
    const float d = glm::determinant(m);
    return !(std::abs(d) > 0.0f) || !std::isfinite(d); // NaN is singular too
}

} // namespace

void Spatial::bind(ClassBuilder<Spatial>& c) {
    c.doc("A node with a place in space.");
    c.property("transform", &Spatial::transform, &Spatial::set_transform)
        .doc("Parent from this node.")
        .default_value(Transform());
    c.property("global_transform", &Spatial::global_transform, &Spatial::set_global_transform)
        .doc("World from this node.")
        .default_value(Transform())
        .not_stored();
    c.property("translation", &Spatial::translation, &Spatial::set_translation)
        .doc("Position in the parent [m].")
        .default_value(glm::vec3(0.0f))
        .not_stored();
    c.property("rotation_degrees", &Spatial::rotation_degrees, &Spatial::set_rotation_degrees)
        .doc("Euler angles in YXZ order [degrees].")
        .default_value(glm::vec3(0.0f))
        .not_stored();
    c.property("scale", &Spatial::scale, &Spatial::set_scale)
        .doc("Factors along the local axes.")
        .default_value(glm::vec3(1.0f))
        .not_stored();
    c.property("visible", &Spatial::is_visible, &Spatial::set_visible)
        .doc("False hides this node and the Spatials chained below it.")
        .default_value(true);
    c.signal("visibility_changed", {}, "is_visible_in_tree() may have changed.");
    c.method("is_visible_in_tree", &Spatial::is_visible_in_tree, "No Spatial up the chain is hidden.");
    c.method("look_at", &Spatial::look_at, "Turns -Z towards a point in the world.");
}

void Spatial::set_transform(const Transform& parent_from_local) {
    transform_ = parent_from_local;
    pose_valid_ = false;
    transform_changed();
}

void Spatial::set_translation(const glm::vec3& position_m) {
    transform_.origin = position_m;
    transform_changed();
}

glm::vec3 Spatial::rotation_degrees() const {
    update_pose();
    return glm::degrees(euler_rad_);
}

void Spatial::set_rotation_degrees(const glm::vec3& euler_deg) {
    update_pose();
    set_pose(glm::radians(euler_deg), scale_);
}

glm::vec3 Spatial::scale() const {
    update_pose();
    return scale_;
}

void Spatial::set_scale(const glm::vec3& factors) {
    update_pose();
    set_pose(euler_rad_, factors);
}

void Spatial::update_pose() const {
    if (pose_valid_) {
        return;
    }
    const glm::mat3& b = transform_.basis;
    const float sign = glm::determinant(b) < 0.0f ? -1.0f : 1.0f;
    scale_ = sign * glm::vec3(glm::length(b[0]), glm::length(b[1]), glm::length(b[2]));
    glm::mat3 rotation = is_singular(b) ? glm::mat3(1.0f) : transform_.orthonormalized().basis;
    rotation *= glm::determinant(rotation) < 0.0f ? -1.0f : 1.0f;
    euler_rad_ = euler_yxz_from_basis(rotation);
    pose_valid_ = true;
}

void Spatial::set_pose(const glm::vec3& euler_rad, const glm::vec3& scale) {
    euler_rad_ = euler_rad;
    scale_ = scale;
    const glm::mat3 rotation = basis_from_euler_yxz(euler_rad);
    transform_.basis = glm::mat3(rotation[0] * scale.x, rotation[1] * scale.y, rotation[2] * scale.z);
    transform_changed();
}

const Transform& Spatial::global_transform() const {
    if (!global_valid_) {
        const Spatial* above = parent_spatial();
        global_ = above ? above->global_transform() * transform_ : transform_;
        if (scale_ignored_) {
            global_ = global_.orthonormalized();
        }
        global_valid_ = true;
    }
    return global_;
}

SetResult Spatial::set_global_transform(const Transform& world_from_local) {
    const Spatial* above = parent_spatial();
    if (!above) {
        set_transform(world_from_local);
        return SetResult::Done;
    }
    const Transform& world_from_parent = above->global_transform();
    if (is_singular(world_from_parent.basis)) {
        return SetResult::Refused;
    }
    set_transform(world_from_parent.inverse() * world_from_local);
    return SetResult::Done;
}

void Spatial::look_at(const glm::vec3& target_m, const glm::vec3& up) {
    const glm::vec3 kept_scale = scale();
    Transform world = global_transform();
    const glm::vec3 back = world.origin - target_m;
    const glm::vec3 right = glm::cross(up, back);
    if (!(glm::length(back) > 0.0f) || !(glm::length(right) > 1e-6f * glm::length(back) * glm::length(up))) {
        return;
    }
    const glm::vec3 z = glm::normalize(back);
    const glm::vec3 x = glm::normalize(right);
    world.basis = glm::mat3(x, glm::cross(z, x), z);
    if (set_global_transform(world) == SetResult::Done) {
        set_scale(kept_scale);
    }
}

void Spatial::transform_changed() {
    if (!global_valid_ && (transform_queued_ || !is_inside_tree())) {
        return; // so are those below, and they are queued
    }
    global_valid_ = false;
    if (is_inside_tree() && !transform_queued_) {
        transform_queued_ = true;
        tree()->world().queue_transform(*this);
    }
    for (const std::unique_ptr<Node>& child : children()) {
        if (auto* spatial = dynamic_cast<Spatial*>(child.get())) {
            spatial->transform_changed();
        }
    }
}

void Spatial::tell_transform_changed() {
    if (!transform_queued_) {
        return; // it left the tree and came back: told once is enough
    }
    transform_queued_ = false;
    static_cast<void>(global_transform()); // valid from here on, so that the next change is noticed
    notify(Notification::TransformChanged);
}

void Spatial::set_visible(bool visible) {
    if (visible_ == visible) {
        return;
    }
    visible_ = visible;
    if (is_inside_tree()) {
        tell_visibility_changed();
    }
}

void Spatial::tell_visibility_changed() {
    static const StringName kVisibilityChanged("visibility_changed");
    notify(Notification::VisibilityChanged);
    emit_signal(kVisibilityChanged);
    const ChildrenLock lock(*this);
    for (const std::unique_ptr<Node>& child : children()) {
        auto* spatial = dynamic_cast<Spatial*>(child.get());
        if (spatial && spatial->visible_) { // a hidden one stays hidden, and all below it
            spatial->tell_visibility_changed();
        }
    }
}

bool Spatial::is_visible_in_tree() const noexcept {
    for (const Spatial* s = this; s; s = s->parent_spatial()) {
        if (!s->visible_) {
            return false;
        }
    }
    return true;
}

Spatial* Spatial::parent_spatial() const noexcept {
    return dynamic_cast<Spatial*>(parent());
}

std::vector<BakeMesh> Spatial::bake_meshes() const {
    return {};
}

VisualServer* Spatial::server() const noexcept {
    return is_inside_tree() ? tree()->world().server() : nullptr;
}

void Spatial::notification(Notification what) {
    Node::notification(what);
    switch (what) {
    case Notification::Parented:
    case Notification::Unparented:
        transform_changed();
        break;
    case Notification::EnterTree:
        if (!transform_queued_) {
            transform_queued_ = true;
            tree()->world().queue_transform(*this);
        }
        break;
    case Notification::ExitTree:
        transform_queued_ = false;
        break;
    default:
        break;
    }
}

} // namespace cl::scene
