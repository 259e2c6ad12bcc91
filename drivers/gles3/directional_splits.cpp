#include "drivers/gles3/directional_splits.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

namespace {

/// View depths where splits begin and end: count + 1 of them in use.
struct SplitRange {
    int count = 1;
    std::array<float, kMaxSplits + 1> at_m{};
};

SplitRange split_range(const LightDesc& light, const CameraDesc& camera) noexcept {
    const bool limited =
        camera.projection != Projection::Orthogonal && light.directional_max_distance_m > 0.0f;
    const float near_m = camera.near_m;
    const float far_m = limited ? std::min(light.directional_max_distance_m, camera.far_m) : camera.far_m;
    const float range_m = std::max(far_m - near_m, 0.001f);
    SplitRange out;
    switch (light.directional_mode) {
    case DirectionalShadowMode::Orthogonal:
        out.count = 1;
        break;
    case DirectionalShadowMode::PSSM2:
        out.count = 2;
        break;
    case DirectionalShadowMode::PSSM4:
        out.count = 4;
        break;
    }
    out.at_m[0] = near_m;
    for (int i = 1; i < out.count; ++i) {
        const float at = near_m + light.directional_splits[static_cast<size_t>(i) - 1] * range_m;
        out.at_m[static_cast<size_t>(i)] = std::max(at, out.at_m[static_cast<size_t>(i) - 1]);
    }
    out.at_m[static_cast<size_t>(out.count)] = near_m + range_m;
    return out;
}

/// One tile, two stacked or four in a square.
void place_tile(DirectionalSplit& split, int index, int count) noexcept {
    const MapArea tile = directional_area(index, count);
    split.tile = tile.position;
    split.tile_size = tile.size;
}

/// How much wider than the view Godot's fit is: in perspective it takes the horizontal field of view for the
/// vertical one, and then widens that by the aspect ratio again. Found from the size and place of shadow
/// texels in its pictures (orthogonal, 2 and 4 splits), which this makes equal. In upright pictures its fit
/// is too narrow and loses shadows: there, departed from.
float godots_widening(const CameraDesc& camera, glm::ivec2 frame_size) noexcept {
    const float aspect = static_cast<float>(frame_size.x) / static_cast<float>(std::max(frame_size.y, 1));
    return camera.projection == Projection::Perspective ? std::max(aspect, 1.0f) : 1.0f;
}

struct Sphere {
    glm::vec3 center{0.0f};
    float radius = 0.0f;
};

Sphere sphere_around(const std::array<glm::vec3, 8>& points) noexcept {
    Sphere s;
    for (const glm::vec3& p : points) {
        s.center += p * 0.125f;
    }
    for (const glm::vec3& p : points) {
        s.radius = std::max(s.radius, glm::length(p - s.center));
    }
    return s;
}

/// Corners are given in light space.
void fit_stable(DirectionalSplit& split, const Sphere& sphere, float texels) noexcept {
    const float radius = sphere.radius * texels / std::max(texels - 2.0f, 1.0f);
    const float texel_m = 2.0f * radius / texels;
    const glm::vec2 center = glm::floor(glm::vec2(sphere.center) / texel_m) * texel_m;
    split.low_m = glm::vec3(center - radius, sphere.center.z - sphere.radius);
    split.high_m = glm::vec3(center + radius, sphere.center.z + sphere.radius);
}

void fit_optimized(DirectionalSplit& split, const std::array<glm::vec3, 8>& corners, float texels) noexcept {
    glm::vec3 low = corners[0];
    glm::vec3 high = corners[0];
    for (const glm::vec3& c : corners) {
        low = glm::min(low, c);
        high = glm::max(high, c);
    }
    const glm::vec3 margin(glm::vec2(high - low) / std::max(texels - 2.0f, 1.0f), 0.0f);
    split.low_m = low - margin;
    split.high_m = high + margin;
}

/// Bounds of all casters as the light sees them: tighter than those of the box around them all.
AABB casters_seen(const LightItem& light, const Transform& light_from_world) noexcept {
    AABB bounds = transformed(light_from_world, light.casters[0].world_bounds);
    for (const CasterItem& caster : light.casters.subspan(1)) {
        bounds = bounds.merged(transformed(light_from_world, caster.world_bounds));
    }
    return bounds;
}

/// Where a split spans more than the casters do, it spans the casters. That does not depend on the camera, so
/// edges do not crawl; what is beyond reads the empty margin and is lit.
/// @return true if it spans them all now
bool shrink_to(DirectionalSplit& split, const AABB& casters, float texels) noexcept {
    constexpr float kMargin = 4.0f; // the filter's reach and one more [texels]
    const float widening = texels / std::max(texels - 2.0f * kMargin, 1.0f);
    bool spans_all = true;
    for (int axis = 0; axis < 2; ++axis) {
        const float span_m = split.high_m[axis] - split.low_m[axis];
        const float needed_m = std::max(casters.size[axis] * widening, span_m / texels);
        if (needed_m > span_m) {
            spans_all = false;
        } else {
            const float center_m = casters.position[axis] + 0.5f * casters.size[axis];
            split.low_m[axis] = center_m - 0.5f * needed_m;
            split.high_m[axis] = center_m + 0.5f * needed_m;
        }
    }
    return spans_all;
}

/// The first `count` splits, the last of them up to `end_m`.
SplitRange shortened(SplitRange range, int count, float end_m) noexcept {
    range.count = count;
    range.at_m[static_cast<size_t>(count)] = end_m;
    return range;
}

/// Fits all splits but where the shadow fades.
/// @param out      its light_from_world is set
/// @param casters  bounds in light space
/// @return the first split that spans all casters, where splits are to be tight; else -1
int fit_splits(DirectionalShadow& out, const LightDesc& light, const Frame& frame, glm::ivec2 area_texels,
               const SplitRange& range, const AABB& casters) noexcept {
    out.count = range.count;
    int first_spanning = -1;
    const bool is_tight = frame.shadow_fit == ShadowFit::ByTexel;
    const Transform light_from_view = out.light_from_world * frame.camera.world_from_camera;
    const float widening = is_tight ? 1.0f : godots_widening(frame.camera, frame.size);
    float first_radius = 1.0f;
    for (int i = 0; i < range.count; ++i) {
        DirectionalSplit& split = out.splits[static_cast<size_t>(i)];
        split.begin_m = range.at_m[static_cast<size_t>(i)];
        split.end_m = range.at_m[static_cast<size_t>(i) + 1];
        place_tile(split, i, range.count);
        std::array<glm::vec3, 8> corners = view_corners(frame.camera, frame.size, split.begin_m, split.end_m);
        for (glm::vec3& c : corners) {
            c = light_from_view.xform(c * glm::vec3(widening, widening, 1.0f));
        }
        const Sphere sphere = sphere_around(corners);
        // A tile that is not square is measured by its height on both axes.
        const float texels = static_cast<float>(area_texels.y) * split.tile_size.y;
        if (light.directional_depth_range == DirectionalDepthRange::Stable) {
            fit_stable(split, sphere, texels);
        } else {
            fit_optimized(split, corners, texels);
        }
        if (is_tight && shrink_to(split, casters, texels) && first_spanning < 0) {
            first_spanning = i;
        }
        split.high_m.z = std::max(split.high_m.z, casters.end().z) + 0.001f;
        first_radius = i == 0 ? sphere.radius : first_radius;
        const float scale = glm::mix(1.0f, sphere.radius / first_radius, light.directional_bias_split_scale);
        split.bias =
            shadow_bias(frame, glm::vec2(light.shadow_bias_m, light.directional_normal_bias) * scale);
    }
    return first_spanning;
}

} // namespace

glm::mat4 DirectionalShadow::clip_from_light(int i) const noexcept {
    const DirectionalSplit& s = splits[static_cast<size_t>(i)];
    const glm::vec3 size = s.high_m - s.low_m;
    glm::mat4 m(1.0f);
    m[0][0] = 2.0f / size.x;
    m[1][1] = 2.0f / size.y;
    m[2][2] = -2.0f / size.z;
    m[3] = glm::vec4(-(s.high_m.x + s.low_m.x) / size.x, -(s.high_m.y + s.low_m.y) / size.y,
                     (s.high_m.z + s.low_m.z) / size.z, 1.0f);
    return m;
}

std::array<glm::vec3, 8> view_corners(const CameraDesc& camera, glm::ivec2 frame_size, float begin_m,
                                      float end_m) noexcept {
    const glm::mat4 view_from_clip = glm::inverse(projection_matrix(camera, frame_size));
    std::array<glm::vec3, 8> out{};
    for (size_t i = 0; i < 4; ++i) {
        const glm::vec2 at(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f);
        const glm::vec4 a4 = view_from_clip * glm::vec4(at, -1.0f, 1.0f);
        const glm::vec4 b4 = view_from_clip * glm::vec4(at, 1.0f, 1.0f);
        const glm::vec3 a = glm::vec3(a4) / a4.w;
        const glm::vec3 b = glm::vec3(b4) / b4.w;
        // Along a corner's ray depth grows evenly, in perspective as in parallel projection.
        const float length_m = std::max(a.z - b.z, 1e-6f);
        out[i] = glm::mix(a, b, (begin_m + a.z) / length_m);
        out[i + 4] = glm::mix(a, b, (end_m + a.z) / length_m);
    }
    return out;
}

DirectionalShadow fit_directional_shadow(const LightItem& light, const Frame& frame,
                                         glm::ivec2 area_texels) noexcept {
    DirectionalShadow out;
    out.light_from_world = {glm::transpose(light.world_from_light.basis), glm::vec3(0.0f)};
    const bool by_caster = frame.shadow_fit == ShadowFit::ByTexel && !light.casters.empty();
    const AABB casters = by_caster ? casters_seen(light, out.light_from_world)
                                   : transformed(out.light_from_world, frame.casters_bounds);
    const SplitRange range = split_range(*light.desc, frame.camera);
    const float end_m = range.at_m[static_cast<size_t>(range.count)];
    const bool fades = range.count > 1;
    out.fade_begin_m = fades ? range.at_m[static_cast<size_t>(range.count) - 1] : end_m * 2.0f;
    out.fade_end_m = fades ? end_m : end_m * 3.0f;
    const int spanning = fit_splits(out, *light.desc, frame, area_texels, range, casters);
    if (spanning >= 0) {
        // It serves as far as can be seen; those after it would only make it coarser.
        const float far_m = std::max(frame.camera.far_m, end_m);
        fit_splits(out, *light.desc, frame, area_texels, shortened(range, spanning + 1, far_m), casters);
        out.fade_begin_m = far_m * 2.0f;
        out.fade_end_m = far_m * 3.0f;
    }
    return out;
}

MapArea directional_area(int index, int count) noexcept {
    if (count <= 1) {
        return {};
    }
    if (count == 2) {
        return {{0.0f, 0.5f * static_cast<float>(index)}, {1.0f, 0.5f}};
    }
    int edge = 2;
    while (edge * edge < count) {
        edge *= 2;
    }
    const float size = 1.0f / static_cast<float>(edge);
    return {glm::vec2(index % edge, index / edge) * size, glm::vec2(size)};
}

} // namespace cl::gles3
