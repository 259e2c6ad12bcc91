#pragma once

#include "drivers/window.h"

#include "core/math/transform.h"

namespace cl::demo {

/// Flies a camera by keys and mouse: WASD along the view, Q and E down and up, Shift four times as fast, the
/// right mouse button (or the arrow keys) to look around. Roll stays zero.
class FlyCamera {
public:
    /// Starts where `world_from_camera` looks; its roll is dropped by the first turn.
    explicit FlyCamera(const Transform& world_from_camera);

    /// One frame of input. @return true if the camera moved.
    bool update(const drivers::InputState& input, float delta_s);
    [[nodiscard]] const Transform& world_from_camera() const noexcept { return world_from_camera_; }

private:
    bool turn(const drivers::InputState& input, float delta_s);
    bool move(const drivers::InputState& input, float delta_s);

    Transform world_from_camera_;
    float yaw_rad_ = 0.0f;
    float pitch_rad_ = 0.0f;
};

} // namespace cl::demo
