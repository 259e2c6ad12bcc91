#pragma once

#include "servers/cones/level.h"

#include <cstddef>
#include <cstdint>

namespace cl::cones {

// What the kernel (kernel_avx2.cpp) works on: plain data, for the reason level.h tells.

/// Points that go through the volumes side by side.
inline constexpr int kLanes = 8;
/// Opacity at which a cone ends.
inline constexpr float kOpaque = 0.95f;
inline constexpr int kMaxCones = 6;

/// The diffuse cones of a surface, and bounds of the specular one.
struct Quality {
    float cones[kMaxCones][4] = {}; ///< xyz: direction in (tangent, binormal, normal), w: weight
    int cone_count = 0;
};

/// One sample of a diffuse cone. All cones of a probe take the same ones.
struct Step {
    float distance = 0.0f; ///< [cells]
    const Level* fine = nullptr;
    const Level* coarse = nullptr; ///< never nullptr
    int32_t coarse_share = 0;      ///< of 256
};

struct Probe {
    float cells_from_view[4][4] = {};     ///< columns; view space in metres
    float bounds[3] = {0.0f, 0.0f, 0.0f}; ///< of the box [cells]; 0: no point lies inside
    float uv_from_cells[3] = {0.0f, 0.0f, 0.0f};
    float multiplier = 0.0f;  ///< radiance from the volume's values
    float bias = 0.0f;        ///< where cones start [cells]
    float normal_bias = 0.0f; ///< [m]
    float reach = 0.0f;       ///< how far cones go [cells]
    bool blend_ambient = false;
    const Step* steps = nullptr; ///< of diffuse cones
    int step_count = 0;
    const Level* levels = nullptr; ///< of the volume, the finest first
    int level_count = 0;
};

struct Points {
    alignas(32) float position[3][kLanes]; ///< view space [m]
    alignas(32) float normal[3][kLanes];   ///< of unit length
    float specular_tan[kLanes];            ///< of half the specular cone's aperture
    int count = 0;                         ///< lanes that are wanted; the others hold copies
};

/// Radiance [W m^-2 sr^-1] in rgb, and in a the share of what is beyond the volume; both times `weight`.
struct Sums {
    alignas(32) float diffuse[kLanes][4] = {};
    alignas(32) float specular[kLanes][4] = {};
    float weight[kLanes] = {};
};

/// Adds what the probes gather at the points. Probes without levels give nothing. Needs AVX2.
void gather_avx2(const Quality& quality, const Probe* probes, int probe_count, const Points& points,
                 Sums& sums);

} // namespace cl::cones
