#include "tests/servers/radiosity/still_rooms.h"

#include "servers/radiosity/sky_bins.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/matrix.hpp>

#include <atomic>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace cl::tests {

using namespace radiosity;

uint32_t RoomBuilder::material(const glm::vec3& albedo, const glm::vec3& emission) {
    Surface s;
    s.albedo = albedo;
    s.emission = emission;
    scene_.surfaces.push_back(s);
    return uint32_t(scene_.surfaces.size() - 1);
}

void RoomBuilder::triangle(uint32_t material, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const uint32_t first = uint32_t(scene_.positions.size());
    for (const glm::vec3& p : {a, b, c}) {
        scene_.positions.push_back(world_from_room_.xform(p));
        scene_.uvs.emplace_back(0.0f);
    }
    const bool mirrored = glm::determinant(world_from_room_.basis) < 0.0f;
    scene_.triangles.push_back(mirrored ? glm::uvec3(first, first + 2, first + 1)
                                        : glm::uvec3(first, first + 1, first + 2));
    scene_.surface_of.push_back(material);
}

void RoomBuilder::box(uint32_t material, const glm::vec3& center, const glm::vec3& size) {
    for (int axis = 0; axis < 3; ++axis) {
        for (float side : {-0.5f, 0.5f}) {
            glm::vec3 n(0.0f), u(0.0f), v(0.0f);
            n[axis] = side * size[axis];
            u[(axis + 1) % 3] = 0.5f * size[(axis + 1) % 3];
            v[(axis + 2) % 3] = std::copysign(0.5f, side) * size[(axis + 2) % 3];
            const glm::vec3 at = center + n;
            triangle(material, at - u - v, at + u - v, at + u + v);
            triangle(material, at - u - v, at + u + v, at - u + v);
        }
    }
}

void RoomBuilder::shell(uint32_t material, float inner_m, float thick_m) {
    const float outer_m = inner_m + 2.0f * thick_m, apart_m = 0.5f * (inner_m + thick_m);
    for (float side : {-1.0f, 1.0f}) {
        box(material, {0, side * apart_m, 0}, {outer_m, thick_m, outer_m});
        box(material, {0, 0, side * apart_m}, {outer_m, inner_m, thick_m});
        box(material, {side * apart_m, 0, 0}, {thick_m, inner_m, inner_m});
    }
}

void RoomBuilder::ball(uint32_t material, const glm::vec3& center, float radius_m) {
    constexpr int kRings = 24, kSegments = 48;
    const auto point = [&](int ring, int segment) {
        const float theta = std::numbers::pi_v<float> * float(ring) / kRings;
        const float phi = 2.0f * std::numbers::pi_v<float> * float(segment % kSegments) / kSegments;
        return center + radius_m * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                             std::sin(theta) * std::sin(phi));
    };
    for (int ring = 0; ring < kRings; ++ring) {
        for (int s = 0; s < kSegments; ++s) {
            const glm::vec3 a = point(ring, s), b = point(ring, s + 1), c = point(ring + 1, s + 1),
                            d = point(ring + 1, s);
            if (ring > 0) {
                triangle(material, a, b, c);
            }
            if (ring + 1 < kRings) {
                triangle(material, a, c, d);
            }
        }
    }
}

std::shared_ptr<const StillScene> RoomBuilder::take() {
    return std::make_shared<const StillScene>(std::move(scene_));
}

LitRoom::LitRoom(std::shared_ptr<const StillScene> scene, std::span<const ProbeBox> probes) {
    const std::atomic<bool> stop{false};
    auto made = make_transport(std::move(scene), probes, stop);
    REQUIRE(made);
    transport = *made;
    map = make_field_map(*transport);
}

Solution LitRoom::solve(const Lighting& lighting) const {
    const std::atomic<bool> stop{false};
    return radiosity::solve(*transport, lighting, stop);
}

ProbeBox probe_with_cells(float cell_m, float height_m, const Transform& world_from_probe) {
    const glm::vec3 size(cell_m * float(128 - 2 * kProbeMargin), height_m, height_m);
    return {world_from_probe, {-0.5f * size, size}};
}

Lighting darkness(size_t probes) {
    Lighting lighting;
    lighting.sky.assign(kSkyBins, glm::vec3(0.0f));
    lighting.interior.assign(probes, false);
    return lighting;
}

Source omni_source(const glm::vec3& position, float range_m) {
    Source s;
    s.position = position;
    s.range_m = range_m;
    return s;
}

namespace {

/// The field as the shader reads it.
class FieldReader {
public:
    FieldReader(const LitRoom& room, size_t probe, const Solution& solution)
        : map_(room.map), probe_(room.map.probes[probe]), light_(encode_field(room.map, solution)) {}

    [[nodiscard]] int cell(int facing, const glm::ivec3& c) const {
        const glm::ivec3 b = c >> 2, n = probe_.bricks, in = c & 3;
        if (glm::any(glm::lessThan(b, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(b, n))) {
            return -1;
        }
        const int brick = int(probe_.first_brick) + ((facing * n.z + b.z) * n.y + b.y) * n.x + b.x;
        const uint32_t* words = &map_.brick_words[size_t(brick) * 4];
        const int bit = in.x | (in.y << 2) | (in.z << 4);
        const uint32_t word = bit < 32 ? words[0] : words[1], mask = 1u << (bit & 31);
        if ((word & mask) == 0) {
            return -1;
        }
        return int(words[2] + (bit < 32 ? 0u : words[3]) + uint32_t(std::popcount(word & (mask - 1))));
    }
    [[nodiscard]] glm::uvec2 joint(int slot) const {
        return {map_.joints[size_t(slot) * 2], map_.joints[size_t(slot) * 2 + 1]};
    }
    [[nodiscard]] glm::vec3 light(int slot) const { return glm::unpackF3x9_E1x5(light_[size_t(slot)]); }

private:
    const FieldMap& map_;
    const FieldMap::Probe& probe_;
    std::vector<uint32_t> light_;
};

glm::vec3 place_of(const glm::uvec2& joint) {
    const uint32_t bits = (joint.x >> 27) | (((joint.y >> 27) & 15u) << 5);
    return (glm::vec3(bits & 7u, (bits >> 3) & 7u, (bits >> 6) & 7u) + 0.5f) / 8.0f;
}

float misfit(const glm::vec3& within, const glm::vec3& normal, const glm::uvec2& joint) {
    const bool by_normal = ((joint.y >> 13) & 1u) != 0u;
    const glm::vec3 apart = (by_normal ? 0.5f + 0.5f * normal : within) - place_of(joint);
    const float rise = by_normal ? 0.0f : glm::dot(apart, normal);
    return glm::dot(apart, apart) + 8.0f * rise * rise;
}

int facing_of(const glm::vec3& normal) {
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return axis * 2 + (normal[axis] < 0.0f ? 1 : 0);
}

PixelLight read(const FieldReader& field, const glm::vec3& at, const glm::vec3& normal) {
    const int facing = facing_of(normal);
    const glm::vec3 behind = at - 0.002f * normal;
    const glm::ivec3 home(glm::floor(behind));
    const int home_cell = field.cell(facing, home);
    glm::uvec2 joint(0xFFFFFFFFu, 0u);
    if (home_cell >= 0) {
        const glm::uvec2 first = field.joint(home_cell * 2), other = field.joint(home_cell * 2 + 1);
        const glm::vec3 within = behind - glm::vec3(home);
        const bool second =
            (first.y >> 31) != 0u && misfit(within, normal, other) < misfit(within, normal, first);
        joint = second ? other : first;
        joint.y = (joint.y & ~(1u << 13)) | (second ? 1u << 13 : 0u);
    }
    const glm::vec3 corner = glm::floor(behind - 0.5f), f = behind - 0.5f - corner;
    glm::vec4 sum(0.0f);
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, (i >> 1) & 1, i >> 2), c = glm::ivec3(corner) + step,
                                                            from = c - home + 1;
        const uint32_t bit = 1u << (from.x + 3 * from.y + 9 * from.z);
        const int number = field.cell(facing, c);
        if (number < 0 || (joint.x & bit) == 0) {
            continue;
        }
        const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(step));
        sum += glm::vec4(field.light(number * 2 + ((joint.y & bit) != 0u ? 1 : 0)), 1.0f) * (w.x * w.y * w.z);
    }
    return {sum.w > 1e-4f, sum.w > 1e-4f ? glm::vec3(sum) / sum.w : glm::vec3(0.0f)};
}

} // namespace

std::vector<PixelLight> pixel_lights(const LitRoom& room, size_t probe, const Solution& solution,
                                     std::span<const SurfacePoint> points) {
    const FieldReader field(room, probe, solution);
    const Transform& cells_from_world = room.transport->patches.grids[probe].cells.cells_from_world;
    std::vector<PixelLight> out;
    for (const SurfacePoint& p : points) {
        out.push_back(read(field, cells_from_world.xform(p.position),
                           glm::normalize(cells_from_world.basis * p.normal)));
    }
    return out;
}

std::vector<SurfacePoint> points_inside(const Transform& world_from_room, float inner_m, int per_edge) {
    std::vector<SurfacePoint> points;
    for (int axis = 0; axis < 3; ++axis) {
        for (float side : {-1.0f, 1.0f}) {
            for (int i = 0; i < per_edge * per_edge; ++i) {
                glm::vec3 at(0.0f), n(0.0f);
                at[axis] = 0.5f * side * inner_m;
                at[(axis + 1) % 3] =
                    (float(i % per_edge) + 0.5f) / float(per_edge) * inner_m - 0.5f * inner_m;
                at[(axis + 2) % 3] =
                    (float(i / per_edge) + 0.5f) / float(per_edge) * inner_m - 0.5f * inner_m;
                n[axis] = -side;
                points.push_back({world_from_room.xform(at), glm::normalize(world_from_room.basis * n)});
            }
        }
    }
    return points;
}

float luminance(const glm::vec3& radiance) {
    return glm::dot(radiance, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

float mean_over(const Patches& patches, std::span<const glm::vec3> values,
                const std::function<bool(uint32_t)>& counts) {
    double sum = 0.0, area = 0.0;
    for (uint32_t p = 0; p < patches.size(); ++p) {
        if (counts(p)) {
            sum += double(luminance(values[p]) * patches.area_m2[p]);
            area += double(patches.area_m2[p]);
        }
    }
    return area > 0.0 ? float(sum / area) : 0.0f;
}

std::vector<glm::vec3> received(const Transport& t, const Lighting& lighting, const Solution& solution) {
    std::vector<glm::vec3> out = solution.arriving;
    for (const Source& s : lighting.sources) {
        const std::vector<float> unit = unit_light(t, s);
        for (size_t p = 0; p < out.size(); ++p) {
            out[p] += unit[p] * s.radiance;
        }
    }
    return out;
}

} // namespace cl::tests
