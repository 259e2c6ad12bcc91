#include "servers/radiosity/air_light.h"

#include "servers/radiosity/for_all.h"
#include "servers/radiosity/gather.h"
#include "servers/radiosity/half4.h"

#include "core/threads.h"

#include <algorithm>
#include <cstring>

namespace cl::radiosity {
namespace {

constexpr float kMaxRadiance = 65408.0f;

void write_texel(Rgb4 value, uint16_t* texel) noexcept {
    const uint64_t halves =
        pack_halves(gi::lesser(gi::greater(value, gi::splat(-kMaxRadiance)), gi::splat(kMaxRadiance)));
    std::memcpy(texel, &halves, sizeof halves);
}

/// Reach along an axis to both sides, quarters of a cell: 32 * below + above, a number that a half holds
/// exactly.
float packed_reach(const std::array<float, 6>& reach, int axis) noexcept {
    const auto quarters = [](float cells) { return float(int(std::clamp(cells * 4.0f, 0.0f, 31.0f))); };
    return 32.0f * quarters(reach[size_t(axis) * 2]) + quarters(reach[size_t(axis) * 2 + 1]);
}

/// @param sky  of each bin; empty: the points see none
std::vector<AirLight> gather_air(const AirPoints& air, std::span<const Rgb4> sky,
                                 std::span<const Rgb4> leaving) {
    std::vector<AirLight> own(air.links.points.size());
    for_all(own.size(), [&](size_t i) {
        const Links::Point& point = air.links.points[i];
        Rgb4 mean{}, x{}, y{}, z{};
        const auto add = [&](std::span<const uint32_t> targets, uint32_t first, std::span<const Rgb4> light) {
            for (size_t k = 0; k < targets.size(); ++k) {
                const glm::vec3& d = air.directions[air.rays[first + k]];
                const Rgb4 radiance = light[targets[k]];
                mean += radiance;
                x += radiance * gi::splat(d.x);
                y += radiance * gi::splat(d.y);
                z += radiance * gi::splat(d.z);
            }
        };
        add(air.links.patches_of(point), point.first, leaving);
        if (!sky.empty()) {
            add(air.links.skies_of(point), point.first + point.patch_count, sky);
        }
        const Rgb4 scale = gi::splat(1.0f / float(std::max(point.ray_count, 1u)));
        own[i] = {rgb(mean * scale), {rgb(x * scale), rgb(y * scale), rgb(z * scale)}};
    });
    std::vector<AirLight> shown(own.size());
    for_all(own.size(), [&](size_t i) { shown[i] = own[air.stand_in[i]]; });
    return shown;
}

} // namespace

std::vector<std::vector<AirLight>> light_air(std::span<const AirPoints> air, const Lighting& lighting,
                                             const Solution& solution) {
    const std::vector<Rgb4> sky = sky_lanes(lighting);
    std::vector<std::vector<AirLight>> light;
    for (size_t i = 0; i < air.size(); ++i) {
        const bool is_interior = i < lighting.interior.size() && lighting.interior[i];
        light.push_back(gather_air(air[i], is_interior ? std::span<const Rgb4>{} : sky, solution.leaving));
    }
    return light;
}

std::vector<uint16_t> encode_air(std::span<const AirPoints> air, const FieldMap& map,
                                 std::span<const std::vector<AirLight>> light) {
    std::vector<uint16_t> out(size_t(map.air.x) * size_t(map.air.y) * size_t(map.air.z) * 4);
    for (size_t p = 0; p < map.probes.size(); ++p) {
        const glm::ivec3 dims = map.probes[p].bricks;
        const auto texel_of = [&](int n, int slab) {
            const int x = n % dims.x, y = n / dims.x % dims.y, z = n / (dims.x * dims.y);
            const glm::ivec3 at = map.probes[p].air_at + glm::ivec3(x, y, slab * dims.z + z);
            return out.data() +
                   4 * ((size_t(at.z) * size_t(map.air.y) + size_t(at.y)) * size_t(map.air.x) + size_t(at.x));
        };
        constexpr size_t kGrain = 1024;
        parallel_for(light[p].size(), kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const AirLight& at = light[p][i];
                write_texel(rgb4(at.mean), texel_of(int(i), 0));
                for (int axis = 0; axis < 3; ++axis) {
                    Rgb4 slope = rgb4(at.slope[size_t(axis)]);
                    slope[3] = packed_reach(air[p].reach[i], axis);
                    write_texel(slope, texel_of(int(i), 1 + axis));
                }
            }
        });
    }
    return out;
}

} // namespace cl::radiosity
