#include "demo/cli/fly_camera.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>

namespace cl::demo {

namespace {

using drivers::InputState;
using drivers::Key;

constexpr float kSpeed_m_per_s = 3.0f;
constexpr float kFastFactor = 4.0f;
constexpr float kTurn_rad_per_px = 0.004f;
constexpr float kTurn_rad_per_s = 1.5f;
constexpr float kMaxPitch_rad = 0.5f * std::numbers::pi_v<float> - 0.01f; // straight up would lose the yaw

float axis(const InputState& input, Key positive, Key negative) {
    return static_cast<float>(input.is_down(positive)) - static_cast<float>(input.is_down(negative));
}

} // namespace

FlyCamera::FlyCamera(const Transform& world_from_camera) : world_from_camera_(world_from_camera) {
    const glm::vec3 euler_rad = euler_yxz_from_basis(world_from_camera.basis);
    pitch_rad_ = euler_rad.x;
    yaw_rad_ = euler_rad.y;
}

bool FlyCamera::update(const InputState& input, float delta_s) {
    const bool turned = turn(input, delta_s);
    const bool moved = move(input, delta_s);
    return turned || moved;
}

bool FlyCamera::turn(const InputState& input, float delta_s) {
    glm::vec2 turn_rad(axis(input, Key::Left, Key::Right), axis(input, Key::Up, Key::Down));
    turn_rad *= kTurn_rad_per_s * delta_s;
    if (input.is_down(drivers::MouseButton::Right)) {
        turn_rad -= input.mouse_motion_px * kTurn_rad_per_px;
    }
    if (turn_rad == glm::vec2(0.0f)) {
        return false;
    }
    yaw_rad_ += turn_rad.x;
    pitch_rad_ = std::clamp(pitch_rad_ + turn_rad.y, -kMaxPitch_rad, kMaxPitch_rad);
    world_from_camera_.basis = basis_from_euler_yxz({pitch_rad_, yaw_rad_, 0.0f});
    return true;
}

bool FlyCamera::move(const InputState& input, float delta_s) {
    const glm::vec3 wish(axis(input, Key::D, Key::A), axis(input, Key::E, Key::Q),
                         axis(input, Key::S, Key::W));
    if (wish == glm::vec3(0.0f)) {
        return false;
    }
    const float speed = kSpeed_m_per_s * (input.is_down(Key::Shift) ? kFastFactor : 1.0f);
    world_from_camera_.origin += world_from_camera_.basis * glm::normalize(wish) * (speed * delta_s);
    return true;
}

} // namespace cl::demo
