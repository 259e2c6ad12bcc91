#include "drivers/gles3/sky_filter.h"

#include "core/threads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

namespace {

constexpr float kPi = 3.14159265359f;

/// Runs f(direction) for every texel's direction.
template <typename F>
ParaboloidMap fill_map(int width, const F& f) {
    ParaboloidMap map{width, std::vector<glm::vec3>(static_cast<size_t>(width) * width * 2)};
    parallel_for(static_cast<size_t>(width) * 2, 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::ivec2 texel(x, static_cast<int>(y));
                map.texels[y * static_cast<size_t>(width) + static_cast<size_t>(x)] =
                    f(ParaboloidMap::direction_at(texel, width));
            }
        }
    });
    return map;
}

/// One direction of a filter, in the frame of the lobe's axis.
struct LobeSample {
    glm::vec3 direction{0.0f};
    float weight = 0.0f;
    float lod = 0.0f; ///< of the panorama
};

float radical_inverse_2(uint32_t i) noexcept {
    i = (i << 16) | (i >> 16);
    i = ((i & 0x00FF00FFu) << 8) | ((i & 0xFF00FF00u) >> 8);
    i = ((i & 0x0F0F0F0Fu) << 4) | ((i & 0xF0F0F0F0u) >> 4);
    i = ((i & 0x33333333u) << 2) | ((i & 0xCCCCCCCCu) >> 2);
    i = ((i & 0x55555555u) << 1) | ((i & 0xAAAAAAAAu) >> 1);
    return static_cast<float>(i) * 2.3283064e-10f;
}

/// Mirror directions of GGX-distributed half vectors for an eye along the axis; each covers its share of the
/// lobe, and its lod makes the panorama's texels as wide as that.
std::vector<LobeSample> ggx_lobe(float roughness, uint32_t count, int panorama_width) {
    const float a4 = roughness * roughness * roughness * roughness;
    const float quarter = 0.25f * static_cast<float>(panorama_width);
    const float texel_sr = 4.0f * kPi / (6.0f * quarter * quarter);
    std::vector<LobeSample> out;
    for (uint32_t i = 0; i < count; ++i) {
        const float phi = 2.0f * kPi * static_cast<float>(i) / static_cast<float>(count);
        const float xi = radical_inverse_2(i);
        const float cos_h = std::sqrt((1.0f - xi) / (1.0f + (a4 - 1.0f) * xi));
        const float sin_h = std::sqrt(std::max(0.0f, 1.0f - cos_h * cos_h));
        const glm::vec3 h(sin_h * std::cos(phi), sin_h * std::sin(phi), cos_h);
        const glm::vec3 l = 2.0f * cos_h * h - glm::vec3(0.0f, 0.0f, 1.0f);
        if (l.z <= 0.0f) {
            continue;
        }
        const float base = cos_h * cos_h * (a4 - 1.0f) + 1.0f;
        const float pdf = a4 / (kPi * base * base) / 4.0f + 1e-4f;
        const float sample_sr = 1.0f / (static_cast<float>(count) * pdf + 1e-4f);
        out.push_back({l, l.z, std::max(0.0f, 0.5f * std::log2(sample_sr / texel_sr))});
    }
    return out;
}

/// Weighted mean of what `look` finds along a lobe around an axis.
template <typename Look>
glm::vec3 blur(const std::vector<LobeSample>& lobe, const glm::vec3& axis, const Look& look) {
    const glm::vec3 up = std::abs(axis.z) < 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(up, axis));
    const glm::vec3 y = glm::cross(axis, x);
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    for (const LobeSample& s : lobe) {
        sum += s.weight * look(s.direction.x * x + s.direction.y * y + s.direction.z * axis, s.lod);
        weights += s.weight;
    }
    return sum / weights;
}

/// Godot sums pi cos sin over polar angles of 0, 0.03 .. rad and divides by their number: the last one stops
/// short of the horizon, so that a uniform sky gives a little less than its radiance.
float share_of_uniform_sky() {
    constexpr float kStep = 0.03f; // [rad]
    float sum = 0.0f;
    int count = 0;
    for (; static_cast<float>(count) * kStep < 0.5f * kPi; ++count) {
        const float theta = static_cast<float>(count) * kStep;
        sum += std::cos(theta) * std::sin(theta);
    }
    return kPi * sum / static_cast<float>(count);
}

/// A layer's largest width when it is computed, and its samples: the rougher, the fewer texels and the wider
/// the lobe.
struct LayerCost {
    int width;
    uint32_t samples;
};
constexpr LayerCost kLayerCosts[kSkyLayers] = {{512, 1},  {128, 32}, {64, 128},
                                               {32, 256}, {32, 256}, {32, 256}};

} // namespace

glm::vec3 ParaboloidMap::sample(const glm::vec3& d) const noexcept {
    const float scale = 1.0f / (1.0f + std::abs(d.z));
    const float v = d.y * scale * 0.25f + 0.25f;
    const glm::vec2 uv(d.x * scale * 0.5f + 0.5f, d.z >= 0.0f ? v : 1.0f - v);
    const glm::ivec2 last(width - 1, 2 * width - 1);
    const glm::vec2 p = glm::clamp(uv * glm::vec2(width, 2 * width) - 0.5f, glm::vec2(0.0f), glm::vec2(last));
    const glm::ivec2 a(p);
    const glm::ivec2 b = glm::min(a + 1, last);
    const glm::vec2 f = p - glm::vec2(a);
    const glm::vec3* lower = texels.data() + static_cast<size_t>(a.y) * width;
    const glm::vec3* upper = texels.data() + static_cast<size_t>(b.y) * width;
    return glm::mix(glm::mix(lower[a.x], lower[b.x], f.x), glm::mix(upper[a.x], upper[b.x], f.x), f.y);
}

glm::vec3 ParaboloidMap::direction_at(glm::ivec2 texel, int width) noexcept {
    const bool is_upper = texel.y >= width;
    const int row = is_upper ? 2 * width - 1 - texel.y : texel.y;
    const glm::vec2 p = (glm::vec2(texel.x, row) + 0.5f) / static_cast<float>(width) * 2.0f - 1.0f;
    const float z = 0.5f - 0.5f * glm::dot(p, p);
    return glm::normalize(glm::vec3(p, is_upper ? -z : z));
}

ParaboloidMap ParaboloidMap::resized(int new_width) const {
    return fill_map(new_width, [this](const glm::vec3& d) { return sample(d); });
}

ParaboloidMap filter_irradiance(const Panorama& sky) {
    constexpr float kStep = 0.1f; // [rad]
    std::vector<LobeSample> directions;
    float weights = 0.0f;
    const float lod =
        std::max(0.0f, std::round(std::log2(kStep * static_cast<float>(sky.size().x) / (2.0f * kPi))));
    for (float theta = 0.5f * kStep; theta < 0.5f * kPi; theta += kStep) {
        for (float phi = 0.0f; phi < 2.0f * kPi; phi += kStep) {
            const float weight = std::cos(theta) * std::sin(theta);
            directions.push_back(
                {{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
                 weight,
                 lod});
            weights += weight;
        }
    }
    const float scale = share_of_uniform_sky() / weights;
    return fill_map(kIrradianceWidth, [&](const glm::vec3& n) {
        const glm::vec3 x = glm::cross(glm::vec3(0, 1, 0), n); // not normalised, as the header says
        const glm::vec3 y = glm::cross(n, x);
        glm::vec3 sum(0.0f);
        for (const LobeSample& s : directions) {
            sum += s.weight * sky.sample(s.direction.x * x + s.direction.y * y + s.direction.z * n, s.lod);
        }
        return sum * scale;
    });
}

std::array<ParaboloidMap, kSkyLayers> filter_radiance(const Panorama& sky, int width) {
    std::array<ParaboloidMap, kSkyLayers> out;
    ParaboloidMap previous;
    for (size_t layer = 0; layer < kSkyLayers; ++layer) {
        const LayerCost& cost = kLayerCosts[layer];
        const int computed = std::min(width, cost.width);
        const float roughness = static_cast<float>(layer) / (kSkyLayers - 1);
        const std::vector<LobeSample> lobe = ggx_lobe(roughness, cost.samples, sky.size().x);
        ParaboloidMap map;
        if (layer == 0) {
            map = fill_map(computed, [&](const glm::vec3& d) { return sky.sample(d, 0.0f); });
        } else if (layer <= 2) {
            map = fill_map(computed, [&](const glm::vec3& d) {
                return blur(lobe, d, [&](const glm::vec3& l, float lod) { return sky.sample(l, lod); });
            });
        } else {
            // Rough layers blur the layer before them once more.
            map = fill_map(computed, [&](const glm::vec3& d) {
                return blur(lobe, d, [&](const glm::vec3& l, float) { return previous.sample(l); });
            });
        }
        out[layer] = computed == width ? map : map.resized(width);
        previous = std::move(map);
    }
    return out;
}

} // namespace cl::gles3
