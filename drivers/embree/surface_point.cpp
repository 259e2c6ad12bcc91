#include "drivers/embree/surface_point.h"

#include "servers/shading/brdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace cl::embree {

namespace {

/// `v` with unit length, or `otherwise` if it has none.
glm::vec3 normalize_or(const glm::vec3& v, const glm::vec3& otherwise) noexcept {
    const float length2 = glm::dot(v, v);
    return length2 > 0.0f && std::isfinite(length2) ? v / std::sqrt(length2) : otherwise;
}

/// As shaders/lib/material.glsl bends it. @param normal  of the surface, unit length, on the side that is
/// seen
glm::vec3 mapped_normal(const TracedItem& item, const Hit& hit, const SurfaceCoordinates& at,
                        const glm::vec3& local_normal, const glm::vec3& normal) noexcept {
    const auto& tangents = item.surface->arrays.tangents;
    const glm::uvec3& t = item.surface->triangles[hit.triangle];
    const glm::vec4 tangent = interpolate(tangents[t.x], tangents[t.y], tangents[t.z], hit.barycentric);
    const glm::vec3 local_tangent(tangent);
    const glm::vec3 local_binormal = glm::cross(local_normal, local_tangent) * tangent.w;
    const float side = hit.front ? 1.0f : -1.0f;
    const glm::vec3 slopes = item.material.tangent_normal(at);
    const glm::vec3 zero(0.0f);
    const glm::vec3 mapped =
        normalize_or(item.normals_from_local * local_tangent, zero) * (side * slopes.x) +
        normalize_or(item.normals_from_local * local_binormal, zero) * (side * slopes.y) + normal * slopes.z;
    return normalize_or(glm::mix(normal, mapped, item.material.desc().normal_scale), normal);
}

glm::vec3 shading_normal(const TracedItem& item, const Hit& hit, const SurfaceCoordinates& at,
                         const glm::vec3& geometric_normal) noexcept {
    const SurfaceArrays& arrays = item.surface->arrays;
    if (arrays.normals.empty()) {
        return geometric_normal;
    }
    const glm::uvec3& t = item.surface->triangles[hit.triangle];
    const glm::vec3 local =
        interpolate(arrays.normals[t.x], arrays.normals[t.y], arrays.normals[t.z], hit.barycentric);
    const float side = hit.front ? 1.0f : -1.0f; // a back face shows its normals turned
    const glm::vec3 normal = normalize_or(item.normals_from_local * local * side, geometric_normal);
    return item.material.has_normal_map() && !arrays.tangents.empty()
               ? mapped_normal(item, hit, at, local, normal)
               : normal;
}

/// A material without specular light from lamps keeps what makes it a metal: what it mirrors.
float gloss_of(const Material& material, float metallic) noexcept {
    return material.specular_mode() == SpecularMode::Disabled ? metallic : 1.0f;
}

} // namespace

glm::vec3 SurfacePoint::start_of(const glm::vec3& direction) const noexcept {
    return offset_point(position, is_outside(direction) ? geometric_normal : -geometric_normal);
}

bool SurfacePoint::is_outside(const glm::vec3& direction) const noexcept {
    return glm::dot(geometric_normal, direction) > 0.0f;
}

SurfacePoint surface_point(const TracedItem& item, const Hit& hit, const glm::vec3& direction) noexcept {
    const Material& material = item.material;
    const SurfaceCoordinates at = item.coordinates(hit.triangle, hit.barycentric);
    const TracedItem::Corners corners = item.corners(hit.triangle);
    const float side = hit.front ? 1.0f : -1.0f;
    SurfacePoint p;
    p.item = &item;
    p.position = interpolate(corners.a, corners.b, corners.c, hit.barycentric);
    p.to_eye = -direction;
    p.geometric_normal = normalize_or(item.front_normal(hit.triangle) * side, p.to_eye);
    p.emission = material.emission(at);
    if (material.desc().unshaded) {
        return p;
    }
    p.albedo = material.albedo(at);
    p.metallic = material.metallic(at);
    p.occlusion = material.ambient_occlusion(at);
    p.occlusion_lamp = glm::mix(1.0f, p.occlusion, material.desc().ao_light_affect);
    p.bsdf.normal = shading_normal(item, hit, at, p.geometric_normal);
    p.bsdf.diffuse = glm::max(glm::vec3(0.0f), p.albedo) * (1.0f - p.metallic);
    p.bsdf.f0 = shading::f0_from_material(p.albedo, p.metallic, material.desc().specular);
    p.bsdf.gloss = gloss_of(material, p.metallic);
    p.bsdf.roughness = material.roughness(at);
    p.bsdf.diffuse_mode = material.diffuse_mode();
    return p;
}

} // namespace cl::embree
