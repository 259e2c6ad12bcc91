#include "drivers/gles3/passes/caster_draw.h"

#include "drivers/gles3/material_variant.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace cl::gles3 {

namespace {

/// Longest axis of a transform: how much it enlarges a length at most along one axis.
float largest_scale(const glm::mat3& basis) noexcept {
    return std::max(glm::length(basis[0]), std::max(glm::length(basis[1]), glm::length(basis[2])));
}

void set_holes(const gl::ShaderProgram<shaders::ShadowCaster>& program, const MaterialDesc& material,
               const TextureStorage& textures) {
    using S = shaders::ShadowCaster;
    program.set(S::uv_scale_offset, glm::vec4(material.uv1_scale.x, material.uv1_scale.y,
                                              material.uv1_offset.x, material.uv1_offset.y));
    program.set(S::alpha, glm::vec2(material.albedo.a, hole_threshold(material)));
    program.bind(S::albedo_map, textures.get_or(material.albedo_texture, DefaultTexture::White));
}

} // namespace

bool may_be_visible(const CasterView& view, const AABB& world_box) noexcept {
    const AABB box = transformed(view.light_from_world, world_box);
    int outside[6] = {};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = box.position + box.size * glm::vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::vec4 c = view.clip_from_light * glm::vec4(p, 1.0f);
        for (int axis = 0; axis < 3; ++axis) {
            outside[2 * axis] += c[axis] < -c.w;
            outside[2 * axis + 1] += c[axis] > c.w;
        }
    }
    return std::all_of(std::begin(outside), std::end(outside), [](int corners) { return corners < 8; });
}

Status CasterDraw::draw(gl::Pass& pass, const LightItem& light, const CasterView& view,
                        const Resources& resources) {
    for (const CasterItem& caster : light.casters) {
        const MaterialDesc& m = *caster.material;
        const float grow_m = m.grow ? std::max(m.grow_amount_m, 0.0f) : 0.0f;
        const AABB bounds = caster.world_bounds.grown(grow_m * largest_scale(caster.world_from_local.basis));
        if (!may_be_visible(view, bounds)) {
            continue;
        }
        if (Status s = draw_one(pass, caster, *light.desc, view, resources); !s) {
            return s;
        }
    }
    return {};
}

Status CasterDraw::draw_one(gl::Pass& pass, const CasterItem& caster, const LightDesc& light,
                            const CasterView& view, const Resources& resources) {
    using S = shaders::ShadowCaster;
    const StoredSurface* surface = resources.meshes.surface(caster.mesh, caster.surface);
    if (!surface) {
        return {};
    }
    const MaterialDesc& m = *caster.material;
    const auto program = programs_.get(has_holes(m) ? S::kAlphaScissor : 0u);
    if (!program) {
        return program.error();
    }
    (*program)->set(S::light_from_local, (view.light_from_world * caster.world_from_local).to_mat4());
    (*program)->set(S::clip_from_light, view.clip_from_light);
    (*program)->set(S::bias, view.bias_m);
    (*program)->set(S::grow, m.grow ? m.grow_amount_m : 0.0f);
    if (has_holes(m)) {
        set_holes(**program, m, resources.textures);
    }
    pass.draw(**program, surface->vertex_array, caster_state(caster, light), surface->range);
    return {};
}

} // namespace cl::gles3
