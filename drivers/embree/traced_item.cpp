#include "drivers/embree/traced_item.h"

#include "core/math/color.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace cl::embree {

namespace {

/// As the scene pass does: under uneven scale they are right only if the material asks for it (its spec's
/// look).
glm::mat3 normal_matrix(const WorldItem& item) noexcept {
    const glm::mat3& basis = item.world_from_local.basis;
    return item.material->ensure_correct_normals ? glm::transpose(glm::inverse(basis)) : basis;
}

/// Converted at the vertices, as Godot does, so that what is between them is mixed as light.
glm::vec4 linear(const Color& c, bool is_srgb) noexcept {
    return {is_srgb ? linear_from_srgb(c.rgb()) : c.rgb(), c.a};
}

} // namespace

TracedItem::TracedItem(const WorldItem& item, std::shared_ptr<const TriangleSurface> triangles,
                       const Material::FindTexture& find)
    : surface(std::move(triangles)), material(*item.material, find), normals_from_local(normal_matrix(item)),
      mirrored(item.mirrored), layers(item.layers), casting(item.casting) {
    const SurfaceArrays& arrays = surface->arrays;
    const bool grows = item.material->grow && !arrays.normals.empty();
    positions.reserve(arrays.positions.size());
    for (size_t i = 0; i < arrays.positions.size(); ++i) {
        const glm::vec3 grown = grows ? arrays.normals[i] * item.material->grow_amount_m : glm::vec3(0.0f);
        positions.push_back(item.world_from_local.xform(arrays.positions[i] + grown));
    }
}

TracedItem::Corners TracedItem::corners(uint32_t triangle) const noexcept {
    const glm::uvec3& t = surface->triangles[triangle];
    return {positions[t.x], positions[t.y], positions[t.z]};
}

glm::vec3 TracedItem::front_normal(uint32_t triangle) const noexcept {
    const Corners c = corners(triangle);
    const glm::vec3 counter_clockwise = glm::cross(c.b - c.a, c.c - c.a);
    return mirrored ? counter_clockwise : -counter_clockwise;
}

SurfaceCoordinates TracedItem::coordinates(uint32_t triangle, const glm::vec2& b) const noexcept {
    const SurfaceArrays& arrays = surface->arrays;
    const glm::uvec3& t = surface->triangles[triangle];
    SurfaceCoordinates at;
    if (!arrays.uvs.empty()) {
        at.uv = interpolate(arrays.uvs[t.x], arrays.uvs[t.y], arrays.uvs[t.z], b);
    }
    if (!arrays.uv2s.empty()) {
        at.uv2 = interpolate(arrays.uv2s[t.x], arrays.uv2s[t.y], arrays.uv2s[t.z], b);
    }
    if (!arrays.colors.empty()) {
        const bool is_srgb = material.desc().vertex_color_is_srgb;
        at.color = interpolate(linear(arrays.colors[t.x], is_srgb), linear(arrays.colors[t.y], is_srgb),
                               linear(arrays.colors[t.z], is_srgb), b);
    }
    return at;
}

bool TracedItem::shows(bool front_side) const noexcept {
    const CullMode cull = material.desc().cull_mode;
    return cull == CullMode::Disabled || (cull == CullMode::Back) == front_side;
}

} // namespace cl::embree
