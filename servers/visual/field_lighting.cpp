#include "servers/visual/field_lighting.h"

#include "servers/radiosity/sky_bins.h"

#include "core/math/color.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace cl {
namespace {

radiosity::Source source_of(const LightDesc& light, const Transform& world_from_light) {
    radiosity::Source s;
    s.type =
        light.type == LightType::Directional
            ? radiosity::SourceType::Directional
            : (light.type == LightType::Omni ? radiosity::SourceType::Omni : radiosity::SourceType::Spot);
    const float sign = light.negative ? -1.0f : 1.0f;
    s.radiance = linear_from_srgb(light.color.rgb()) * (sign * light.energy * light.indirect_energy);
    s.position = world_from_light.origin;
    s.to_light = glm::normalize(world_from_light.basis[2]);
    s.range_m = light.range_m;
    s.attenuation = light.attenuation;
    s.cos_spot_angle = std::cos(glm::radians(light.spot_angle_deg));
    s.spot_attenuation = light.spot_angle_attenuation;
    s.shadow = light.shadow;
    return s;
}

bool is_finite(const radiosity::Source& s) noexcept {
    const glm::vec3 sum = s.radiance + s.position + s.to_light;
    return std::isfinite(sum.x + sum.y + sum.z + s.range_m + s.attenuation + s.spot_attenuation);
}

/// Radiance of the ambient light and the sky (spec scene-classes section 14.3), without occlusion.
std::vector<glm::vec3> sky_of(const Storage& storage, const EnvironmentDesc* e) {
    std::vector<glm::vec3> sky(radiosity::kSkyBins, glm::vec3(0.0f));
    if (!e) {
        return sky;
    }
    const glm::vec3 flat = linear_from_srgb(e->ambient_color.rgb());
    const bool shows_sky =
        e->background_mode == BackgroundMode::Sky || e->background_mode == BackgroundMode::ColorSky;
    const std::span<const glm::vec3> bins =
        shows_sky ? storage.skies.bins(e->sky) : std::span<const glm::vec3>{};
    const glm::mat3 sky_from_world = glm::inverse(e->sky_orientation);
    for (uint32_t bin = 0; bin < radiosity::kSkyBins; ++bin) {
        glm::vec3 radiance = flat;
        if (!bins.empty()) {
            const glm::vec3 direction = glm::normalize(sky_from_world * radiosity::sky_direction(bin));
            radiance = glm::mix(flat, bins[radiosity::sky_bin(direction)] * e->background_energy,
                                e->ambient_sky_contribution);
        }
        sky[bin] = radiance * e->ambient_energy;
    }
    return sky;
}

} // namespace

radiosity::Lighting lighting_of(const Storage& storage, InstanceStorage& instances, RID scenario) {
    radiosity::Lighting lighting;
    instances.for_each([&](RID, const Instance& instance) {
        const bool is_light =
            instance.kind == InstanceKind::DirectionalLight || instance.kind == InstanceKind::LocalLight;
        const Light* light = is_light ? storage.lights.get(instance.base) : nullptr;
        if (!light || instance.scenario != scenario || !instance.visible ||
            light->desc.bake_mode == LightBakeMode::Disabled) {
            return;
        }
        const radiosity::Source source = source_of(light->desc, InstanceStorage::placement(instance));
        if (is_finite(source)) {
            lighting.sources.push_back(source);
        }
    });
    const Scenario* world = instances.scenario(scenario);
    lighting.sky = sky_of(storage, world ? storage.environments.get(world->environment) : nullptr);
    return lighting;
}

} // namespace cl
