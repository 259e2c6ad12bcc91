#include "scene/resources/sky.h"
#include "scene/resources/struct_properties.h"

#include "core/object/class_registry.h"
#include "core/threads.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cl::scene {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Easing curve of spec scene-classes section 14.4.
float ease(float x, float c) {
    x = std::clamp(x, 0.0f, 1.0f);
    if (c > 0.0f) {
        return c < 1.0f ? 1.0f - std::pow(1.0f - x, 1.0f / c) : std::pow(x, c);
    }
    if (c < 0.0f) { // in and out
        return x < 0.5f ? std::pow(x * 2.0f, -c) * 0.5f
                        : (1.0f - std::pow(1.0f - (x - 0.5f) * 2.0f, -c)) * 0.5f + 0.5f;
    }
    return 0.0f;
}

/// The value as the shared-exponent format RGB9E5 keeps it (GL_EXT_texture_shared_exponent), since Godot
/// stores its sky so: 9 bits of mantissa each, one exponent, at most 65408.
glm::vec3 rounded_to_rgb9e5(glm::vec3 c) {
    constexpr float kLargest = 65408.0f;
    c = glm::clamp(c, glm::vec3(0.0f), glm::vec3(kLargest));
    const float largest = std::max({c.r, c.g, c.b});
    if (largest <= 0.0f) {
        return glm::vec3(0.0f);
    }
    int exponent = std::max(-16, static_cast<int>(std::floor(std::log2(largest)))) + 1;
    if (std::floor(std::ldexp(largest, 9 - exponent) + 0.5f) >= 512.0f) {
        ++exponent;
    }
    const glm::vec3 mantissa = glm::floor(c * std::ldexp(1.0f, 9 - exponent) + 0.5f);
    return mantissa * std::ldexp(1.0f, exponent - 9);
}

/// Everything about a sky that does not depend on the pixel.
struct SkyGradient {
    explicit SkyGradient(const ProceduralSkyParams& params)
        : p(params), top(linear_from_srgb(p.sky_top_color.rgb())),
          horizon(linear_from_srgb(p.sky_horizon_color.rgb())),
          ground_bottom(linear_from_srgb(p.ground_bottom_color.rgb())),
          ground_horizon(linear_from_srgb(p.ground_horizon_color.rgb())),
          sun(p.sun_color.rgb() * p.sun_energy), // not linearised: spec scene-classes section 14.4
          to_sun(basis_from_euler_yxz(
                     {glm::radians(p.sun_latitude_deg), glm::radians(p.sun_longitude_deg), 0.0f}) *
                 glm::vec3(0, 0, -1)) {}

    [[nodiscard]] glm::vec3 ground(float angle_from_zenith) const {
        const float c = (angle_from_zenith - kPi * 0.5f) / (kPi * 0.5f);
        return glm::mix(ground_horizon, ground_bottom, ease(c, p.ground_curve)) * p.ground_energy;
    }
    [[nodiscard]] glm::vec3 sky(const glm::vec3& n, float angle_from_zenith) const {
        const float c = angle_from_zenith / (kPi * 0.5f);
        const glm::vec3 color = glm::mix(horizon, top, ease(1.0f - c, p.sky_curve)) * p.sky_energy;
        const float from_sun_deg = glm::degrees(std::acos(std::clamp(glm::dot(to_sun, n), -1.0f, 1.0f)));
        if (from_sun_deg < p.sun_angle_min_deg) {
            return sun;
        }
        if (from_sun_deg < p.sun_angle_max_deg) {
            const float t =
                (from_sun_deg - p.sun_angle_min_deg) / (p.sun_angle_max_deg - p.sun_angle_min_deg);
            return glm::mix(sun, color, ease(t, p.sun_curve));
        }
        return color;
    }

    const ProceduralSkyParams& p;
    glm::vec3 top, horizon, ground_bottom, ground_horizon, sun, to_sun;
};

} // namespace

SkyDesc make_procedural_panorama(const ProceduralSkyParams& params) {
    const int exponent = std::clamp(params.texture_size, 0, 4);
    SkyDesc desc;
    desc.size = {256 << exponent, 128 << exponent};
    desc.radiance.resize(static_cast<size_t>(desc.size.x) * static_cast<size_t>(desc.size.y) * 3);
    const SkyGradient gradient(params);

    const auto rows = [&](size_t first, size_t last) {
        for (size_t j = first; j < last; ++j) {
            const float theta = static_cast<float>(j) / static_cast<float>(desc.size.y - 1) * kPi;
            float* out = desc.radiance.data() + j * static_cast<size_t>(desc.size.x) * 3;
            for (int i = 0; i < desc.size.x; ++i, out += 3) {
                const float phi = static_cast<float>(i) / static_cast<float>(desc.size.x - 1) * kPi * 2.0f;
                const glm::vec3 n{-std::sin(phi) * std::sin(theta), std::cos(theta),
                                  -std::cos(phi) * std::sin(theta)};
                const float angle = std::acos(std::clamp(n.y, -1.0f, 1.0f));
                const glm::vec3 color =
                    rounded_to_rgb9e5(n.y < 0.0f ? gradient.ground(angle) : gradient.sky(n, angle));
                out[0] = color.r;
                out[1] = color.g;
                out[2] = color.b;
            }
        }
    };
    parallel_for(static_cast<size_t>(desc.size.y), 16, rows);
    return desc;
}

void ProceduralSky::bind(ClassBuilder<ProceduralSky>& c) {
    c.doc("Gradients above and below the horizon and a sun with a halo.");
    using P = ProceduralSkyParams;
    StructProperties<ProceduralSky, P> p(c, &ProceduralSky::params, &ProceduralSky::set_params);
    p.field("sky_top_color", &P::sky_top_color).doc("Colour at the zenith, sRGB-encoded.");
    p.field("sky_horizon_color", &P::sky_horizon_color).doc("Colour above the horizon, sRGB-encoded.");
    p.field("sky_curve", &P::sky_curve).range("0,1,0.001").doc("Easing from horizon to zenith.");
    p.field("sky_energy", &P::sky_energy).range("0,64,0.01").doc("Factor on the sky.");
    p.field("ground_bottom_color", &P::ground_bottom_color).doc("Colour at the nadir, sRGB-encoded.");
    p.field("ground_horizon_color", &P::ground_horizon_color).doc("Colour below the horizon, sRGB-encoded.");
    p.field("ground_curve", &P::ground_curve).range("0,1,0.001").doc("Easing from horizon to nadir.");
    p.field("ground_energy", &P::ground_energy).range("0,64,0.01").doc("Factor on the ground.");
    p.field("sun_color", &P::sun_color).doc("Colour of the sun, used as linear.");
    p.field("sun_latitude", &P::sun_latitude_deg)
        .range("-180,180,0.01")
        .doc("Height above the horizon [degrees].");
    p.field("sun_longitude", &P::sun_longitude_deg)
        .range("-180,180,0.01")
        .doc("From -z towards +x [degrees].");
    p.field("sun_angle_min", &P::sun_angle_min_deg).range("0,360,0.01").doc("Radius of the disk [degrees].");
    p.field("sun_angle_max", &P::sun_angle_max_deg).range("0,360,0.01").doc("Radius of the halo [degrees].");
    p.field("sun_curve", &P::sun_curve).range("0,1,0.001").doc("Easing of the halo.");
    p.field("sun_energy", &P::sun_energy).range("0,64,0.01").doc("Factor on the sun.");
    p.choice("texture_size", &P::texture_size, "256,512,1024,2048,4096")
        .doc("Width of the panorama [texels].");
}

void ProceduralSky::set_params(const ProceduralSkyParams& params) {
    params_ = params;
    sky_changed();
}

SkyDesc ProceduralSky::describe() const {
    return make_procedural_panorama(params_);
}

} // namespace cl::scene
