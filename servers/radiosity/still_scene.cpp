#include "servers/radiosity/still_scene.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace cl::radiosity {

AABB StillScene::bounds() const noexcept {
    AABB box{positions.empty() ? glm::vec3(0.0f) : positions[0], glm::vec3(0.0f)};
    for (const glm::vec3& p : positions) {
        box = box.expanded_to(p);
    }
    return box;
}

glm::vec3 StillScene::normal(uint32_t triangle) const noexcept {
    const glm::uvec3 t = triangles[triangle];
    const glm::vec3 n = glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
    const float length = glm::length(n);
    return length > 0.0f ? n / length : glm::vec3(0.0f);
}

glm::vec2 StillScene::uv(uint32_t triangle, glm::vec2 barycentric) const noexcept {
    const glm::uvec3 t = triangles[triangle];
    const glm::vec2 mixed = uvs[t.x] * (1.0f - barycentric.x - barycentric.y) + uvs[t.y] * barycentric.x +
                            uvs[t.z] * barycentric.y;
    const Surface& s = surfaces[surface_of[triangle]];
    return mixed * s.uv_scale + s.uv_offset;
}

glm::vec3 StillScene::albedo(uint32_t triangle, glm::vec2 barycentric, float footprint_uv) const noexcept {
    const Surface& s = surfaces[surface_of[triangle]];
    if (!s.albedo_map) {
        return s.albedo;
    }
    return s.albedo * glm::vec3(s.albedo_map->sample(uv(triangle, barycentric), footprint_uv));
}

glm::vec3 StillScene::emission(uint32_t triangle, glm::vec2 barycentric, float footprint_uv) const noexcept {
    const Surface& s = surfaces[surface_of[triangle]];
    if (!s.emission_map) {
        return s.emission;
    }
    const glm::vec3 map(s.emission_map->sample(uv(triangle, barycentric), footprint_uv));
    return s.emission_multiplies ? s.emission * map : s.emission + map * s.emission_energy;
}

bool StillScene::is_hole(uint32_t triangle, glm::vec2 barycentric) const noexcept {
    const Surface& s = surfaces[surface_of[triangle]];
    return s.alpha_cutoff > 0.0f && s.albedo_map &&
           s.albedo_map->sample(uv(triangle, barycentric), 0.0f).a < s.alpha_cutoff;
}

float StillScene::uv_per_m(uint32_t triangle) const noexcept {
    const glm::uvec3 t = triangles[triangle];
    const glm::vec3 e1 = positions[t.y] - positions[t.x], e2 = positions[t.z] - positions[t.x];
    const glm::vec2 scale = surfaces[surface_of[triangle]].uv_scale;
    const glm::vec2 f1 = (uvs[t.y] - uvs[t.x]) * scale, f2 = (uvs[t.z] - uvs[t.x]) * scale;
    const float area_m2 = glm::length(glm::cross(e1, e2));
    const float area_uv = std::abs(f1.x * f2.y - f1.y * f2.x);
    return area_m2 > 0.0f ? std::sqrt(area_uv / area_m2) : 0.0f;
}

} // namespace cl::radiosity
