#include "scene/3d/camera.h"

#include "scene/3d/server_call.h"
#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"

#include "servers/visual_server.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void Camera::bind(ClassBuilder<Camera>& c) {
    c.doc("An eye: looks along -Z with +Y up.");
    c.property("keep_aspect", &Camera::keep_aspect, &Camera::set_keep_aspect)
        .doc("Which extent of the picture fov and size mean.")
        .enumeration("Keep Width,Keep Height")
        .default_value(1);
    c.property("cull_mask", &Camera::cull_mask, &Camera::set_cull_mask)
        .doc("Bit mask of the layers that are seen.")
        .hint(PropertyHint::Flags, "20 layers")
        .default_value(1048575);
    c.property("environment", &Camera::environment, &Camera::set_environment)
        .doc("Replaces the world's environment.")
        .default_value(Variant());
    c.property("h_offset", &Camera::h_offset, &Camera::set_h_offset)
        .doc("Moves the eye along its X axis [m].")
        .default_value(0.0);
    c.property("v_offset", &Camera::v_offset, &Camera::set_v_offset)
        .doc("Moves the eye along its Y axis [m].")
        .default_value(0.0);
    c.property(
         "doppler_tracking", [](const Camera& o) { return o.doppler_tracking_; },
         [](Camera& o, int mode) { o.doppler_tracking_ = mode; })
        .doc("Sound only: kept for saving.")
        .enumeration("Disabled,Idle,Physics")
        .default_value(0);
    c.property("projection", &Camera::projection, &Camera::set_projection)
        .doc("How the picture is formed.")
        .enumeration("Perspective,Orthogonal,Frustum")
        .default_value(0);
    c.property("current", &Camera::wants_current, &Camera::set_wants_current)
        .doc("Made the viewport's camera. The first camera of a tree is current anyway.")
        .default_value(false);
    c.property("fov", &Camera::fov, &Camera::set_fov)
        .doc("Full angle of view [degrees].")
        .range("1,179,0.1")
        .default_value(70.0);
    c.property("size", &Camera::size, &Camera::set_size)
        .doc("Extent of an orthogonal or frustum picture [m].")
        .range("0.1,16384,0.01")
        .default_value(1.0);
    c.property("frustum_offset", &Camera::frustum_offset, &Camera::set_frustum_offset)
        .doc("Shifts a frustum picture on the near plane [m].")
        .default_value(glm::vec2(0.0f));
    c.property("near", &Camera::near, &Camera::set_near)
        .doc("Distance of the near clip plane [m].")
        .range("0.01,8192,0.01")
        .default_value(0.05);
    c.property("far", &Camera::far, &Camera::set_far)
        .doc("Distance of the far clip plane [m].")
        .range("0.1,8192,0.1")
        .default_value(100.0);
    c.method("make_current", &Camera::make_current, "Shows this camera in the viewport.");
    c.method("is_current", &Camera::is_current, "Whether the viewport shows this camera.");
}

Camera::Camera() {
    ignore_scale();
}

CameraDesc Camera::desc() const {
    CameraDesc desc = lens_;
    desc.world_from_camera = global_transform();
    const glm::mat3& axes = desc.world_from_camera.basis;
    desc.world_from_camera.origin += axes[0] * h_offset_m_ + axes[1] * v_offset_m_;
    return desc;
}

void Camera::push() {
    if (rid_.get()) {
        CameraDesc pushed = desc();
        pushed.environment = environment_ ? environment_->rid(*server()) : RID{};
        tell(server()->camera_set(rid_.get(), pushed));
    }
}

SetResult Camera::set_keep_aspect(KeepAspect keep) {
    if (keep > KeepAspect::Height) {
        return SetResult::Refused;
    }
    lens_.keep_aspect = keep;
    push();
    return SetResult::Done;
}

void Camera::set_cull_mask(uint32_t mask) {
    lens_.cull_mask = mask;
    push();
}

void Camera::set_environment(Ref<Environment> environment) {
    environment_ = std::move(environment);
    push();
}

void Camera::set_h_offset(float offset_m) {
    h_offset_m_ = offset_m;
    push();
}

void Camera::set_v_offset(float offset_m) {
    v_offset_m_ = offset_m;
    push();
}

SetResult Camera::set_projection(Projection projection) {
    if (projection > Projection::Frustum) {
        return SetResult::Refused;
    }
    lens_.projection = projection;
    push();
    return SetResult::Done;
}

SetResult Camera::set_fov(float fov_deg) {
    if (!(fov_deg >= 1.0f && fov_deg <= 179.0f)) {
        return SetResult::Refused;
    }
    lens_.fov_deg = fov_deg;
    push();
    return SetResult::Done;
}

SetResult Camera::set_size(float size_m) {
    if (!(size_m >= 0.001f && size_m <= 16384.0f)) {
        return SetResult::Refused;
    }
    lens_.size_m = size_m;
    push();
    return SetResult::Done;
}

void Camera::set_frustum_offset(glm::vec2 offset_m) {
    lens_.frustum_offset = offset_m;
    push();
}

void Camera::set_near(float near_m) {
    lens_.near_m = near_m;
    push();
}

void Camera::set_far(float far_m) {
    lens_.far_m = far_m;
    push();
}

bool Camera::is_current() const {
    return is_inside_tree() && tree()->world().current_camera() == this;
}

void Camera::set_wants_current(bool wanted) {
    wants_current_ = wanted;
    if (!wanted || !is_inside_tree()) {
        return;
    }
    World& world = tree()->world();
    Camera* before = world.current_camera();
    if (before && before != this) {
        before->wants_current_ = false; // only the last choice is saved
    }
    world.set_current_camera(*this);
}

void Camera::notification(Notification what) {
    Spatial::notification(what);
    switch (what) {
    case Notification::EnterTree:
        if (VisualServer* s = server()) {
            rid_.adopt(*s, s->camera_create());
            push();
        }
        tree()->world().camera_entered(*this);
        break;
    case Notification::ExitTree:
        tree()->world().camera_exited(*this);
        rid_.reset();
        break;
    case Notification::TransformChanged:
        push();
        break;
    default:
        break;
    }
}

} // namespace cl::scene
