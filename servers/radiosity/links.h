#pragma once

#include "servers/radiosity/patches.h"
#include "servers/radiosity/ray_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

/// Where the rays of many gather points end: per point first those that end on patches, then those that end
/// in the sky. Rays that end on nothing that shines (backs of surfaces) count but are not listed.
struct Links {
    struct Point {
        uint32_t first = 0;       ///< of its targets
        uint32_t patch_count = 0; ///< patches ...
        uint32_t sky_count = 0;   ///< ... followed by sky bins
        uint32_t ray_count = 0;   ///< all rays: what sums are divided by
    };
    std::vector<Point> points;
    std::vector<uint32_t> targets;

    [[nodiscard]] std::span<const uint32_t> patches_of(const Point& p) const noexcept {
        return std::span(targets).subspan(p.first, p.patch_count);
    }
    [[nodiscard]] std::span<const uint32_t> skies_of(const Point& p) const noexcept {
        return std::span(targets).subspan(p.first + p.patch_count, p.sky_count);
    }
};

/// What the rays of one gather point met.
struct RayFan {
    std::vector<uint32_t> patches, skies;
    std::vector<uint8_t> patch_rays, sky_rays; ///< number of each one's ray, modulo 256
    /// Rays that end on patches that shine by themselves.
    struct EmitterHit {
        uint32_t patch;
        float distance_m, cosine; ///< at the patch, to its normal
        glm::vec3 direction;
    };
    std::vector<EmitterHit> emitters;
    uint32_t ray_count = 0, back_count = 0;
    float inverse_distance_sum = 0.0f; ///< [1/m]; rays that leave add 0
    /// Harmonic mean of the distances to what the rays met [m]: the scale on which irradiance changes.
    /// Source: Ward and Heckbert 1992.
    [[nodiscard]] float mean_distance_m() const noexcept {
        return inverse_distance_sum > 0.0f ? float(ray_count) / inverse_distance_sum : 1e30f;
    }
};

/// Traces rays and adds where they end.
void add_rays(const RayScene& rays, const Patches& patches, std::span<const Ray> asked, RayFan& fan);

/// Sorts numbers of patches, of which there are `patch_count`: a relight reads them faster so, and parts of
/// the list are parts of the scene. Radix sort of two digits: a third of the time of std::sort.
void sort_patches(std::span<uint32_t> patches, size_t patch_count);

/// Appends a fan as the next point.
void append_point(Links& links, const RayFan& fan);

} // namespace cl::radiosity
