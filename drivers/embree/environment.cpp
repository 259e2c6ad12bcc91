#include "drivers/embree/environment.h"

#include "servers/shading/background.h"

#include "core/math/transform.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace cl::embree {

namespace {

bool lights_by_sky(const Frame& frame) noexcept {
    const BackgroundMode mode = frame.environment.background_mode;
    return frame.has_environment && (mode == BackgroundMode::Sky || mode == BackgroundMode::ColorSky);
}

} // namespace

Environment::Environment(const Frame& frame, const SkyPanorama* sky)
    : background_(shading::background_color(frame)), ambient_(background_), reflected_(background_) {
    if (!frame.has_environment) {
        return;
    }
    const EnvironmentDesc& e = frame.environment;
    ambient_ = linear_from_srgb(e.ambient_color.rgb());
    ambient_energy_ = e.ambient_energy;
    reflected_ = background_ * e.background_energy;
    if (sky && lights_by_sky(frame)) {
        sky_ = sky;
        shows_sky_ = e.background_mode == BackgroundMode::Sky;
        world_from_sky_ = Transform{e.sky_orientation, glm::vec3(0.0f)}.orthonormalized().basis;
        sky_from_world_ = glm::transpose(world_from_sky_);
        sky_energy_ = e.background_energy;
        sky_share_ = e.ambient_sky_contribution;
    }
}

glm::vec3 Environment::sky_radiance(const glm::vec3& direction) const noexcept {
    return sky_->radiance(sky_from_world_ * direction) * sky_energy_;
}

glm::vec3 Environment::background(const glm::vec3& direction) const noexcept {
    return shows_sky_ ? sky_radiance(direction) : background_;
}

glm::vec3 Environment::ambient(const glm::vec3& direction) const noexcept {
    return ambient_energy_ * (sky_ ? glm::mix(ambient_, sky_radiance(direction), sky_share_) : ambient_);
}

glm::vec3 Environment::reflected(const glm::vec3& direction) const noexcept {
    return sky_ ? sky_radiance(direction) : reflected_;
}

SkyPanorama::Sample Environment::sample(const glm::vec2& u) const noexcept {
    SkyPanorama::Sample sample = sky_->sample(u);
    sample.direction = world_from_sky_ * sample.direction;
    return sample;
}

float Environment::pdf(const glm::vec3& direction) const noexcept {
    return has_bright_parts() ? sky_->pdf(sky_from_world_ * direction) : 0.0f;
}

} // namespace cl::embree
