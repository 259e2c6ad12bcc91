#pragma once

#include "scene/3d/spatial.h"
#include "scene/resources/environment.h"
#include "scene/resources/server_rid.h"

#include "servers/render_types.h"

#include <glm/vec2.hpp>

#include <cstdint>

namespace cl::scene {

/// An eye: looks along -Z with +Y up. The first camera of a tree is the current one until another is made so.
class Camera : public Spatial {
public:
    static constexpr std::string_view kClassName = "Camera";
    static void bind(ClassBuilder<Camera>& c);
    Camera();

    /// The camera as the server takes it, but for the environment: place with the offsets applied,
    /// projection.
    [[nodiscard]] CameraDesc desc() const;

    [[nodiscard]] KeepAspect keep_aspect() const noexcept { return lens_.keep_aspect; }
    SetResult set_keep_aspect(KeepAspect keep);
    [[nodiscard]] uint32_t cull_mask() const noexcept { return lens_.cull_mask; }
    void set_cull_mask(uint32_t mask);
    /// Replaces the world's; null: the world's is shown.
    [[nodiscard]] const Ref<Environment>& environment() const noexcept { return environment_; }
    void set_environment(Ref<Environment> environment);
    /// Moves the eye along its own X and Y [m].
    [[nodiscard]] float h_offset() const noexcept { return h_offset_m_; }
    void set_h_offset(float offset_m);
    [[nodiscard]] float v_offset() const noexcept { return v_offset_m_; }
    void set_v_offset(float offset_m);
    [[nodiscard]] Projection projection() const noexcept { return lens_.projection; }
    SetResult set_projection(Projection projection);
    /// Full angle [degrees], vertical or horizontal as keep_aspect says; refused outside 1..179.
    [[nodiscard]] float fov() const noexcept { return lens_.fov_deg; }
    SetResult set_fov(float fov_deg);
    /// Extent of the picture in orthogonal and frustum projection [m]; refused unless in 0.001..16384.
    [[nodiscard]] float size() const noexcept { return lens_.size_m; }
    SetResult set_size(float size_m);
    [[nodiscard]] glm::vec2 frustum_offset() const noexcept { return lens_.frustum_offset; }
    void set_frustum_offset(glm::vec2 offset_m);
    /// Distances of the clip planes [m].
    [[nodiscard]] float near() const noexcept { return lens_.near_m; }
    void set_near(float near_m);
    [[nodiscard]] float far() const noexcept { return lens_.far_m; }
    void set_far(float far_m);

    /// Whether the viewport shows this camera.
    [[nodiscard]] bool is_current() const;
    /// Asked for by the property `current`: taken at once inside a tree, else on entering one.
    [[nodiscard]] bool wants_current() const noexcept { return wants_current_; }
    void set_wants_current(bool wanted);
    void make_current() { set_wants_current(true); }

    /// The camera in the tree's server; null outside a tree or without a server.
    [[nodiscard]] RID camera_rid() const noexcept { return rid_.get(); }

protected:
    void notification(Notification what) override;

private:
    void push();

    CameraDesc lens_; // environment and place are filled in by desc()
    Ref<Environment> environment_;
    float h_offset_m_ = 0.0f;
    float v_offset_m_ = 0.0f;
    int doppler_tracking_ = 0; // sound only: kept for saving
    bool wants_current_ = false;
    ServerRID rid_;
};

} // namespace cl::scene
