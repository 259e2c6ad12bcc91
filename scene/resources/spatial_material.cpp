#include "scene/resources/spatial_material.h"

namespace cl::scene {

SpatialMaterial::SpatialMaterial() {
    for (WatchedRef<Texture>& texture : textures_) {
        texture.watch([this] { material_changed(); });
    }
}

void SpatialMaterial::set_params(const SpatialParams& params) {
    params_ = params;
    material_changed();
}

void SpatialMaterial::set_texture(TextureSlot slot, Ref<Texture> texture) {
    textures_[static_cast<size_t>(slot)].set(std::move(texture));
    material_changed();
}

MaterialDesc SpatialMaterial::describe(VisualServer& server) const {
    const auto texture_rid = [&](TextureSlot slot) {
        const Ref<Texture>& t = texture(slot);
        return t ? t->rid(server) : RID{};
    };
    // Textures of features that are off stay out of the server: nobody would sample them.
    const SpatialParams& p = params_;
    MaterialDesc d;
    d.transparent = p.transparent;
    d.unshaded = p.unshaded;
    d.no_depth_test = p.no_depth_test;
    d.do_not_receive_shadows = p.do_not_receive_shadows;
    d.disable_ambient_light = p.disable_ambient_light;
    d.vertex_color_use_as_albedo = p.vertex_color_use_as_albedo;
    d.vertex_color_is_srgb = p.vertex_color_is_srgb;
    d.albedo_texture_force_srgb = p.albedo_tex_force_srgb;
    d.ensure_correct_normals = p.ensure_correct_normals;
    d.vertex_lighting = p.vertex_lighting;
    d.diffuse_mode = p.diffuse_mode;
    d.specular_mode = p.specular_mode;
    d.blend_mode = p.blend_mode;
    d.cull_mode = p.cull_mode;
    d.depth_draw_mode = p.depth_draw_mode;
    d.grow = p.grow;
    d.grow_amount_m = p.grow_amount_m;
    d.alpha_scissor = p.use_alpha_scissor;
    d.alpha_scissor_threshold = p.alpha_scissor_threshold;

    d.albedo = p.albedo;
    d.albedo_texture = texture_rid(TextureSlot::Albedo);
    d.metallic = p.metallic;
    d.specular = p.specular;
    d.metallic_texture = texture_rid(TextureSlot::Metallic);
    d.metallic_channel = p.metallic_channel;
    d.roughness = p.roughness;
    d.roughness_texture = texture_rid(TextureSlot::Roughness);
    d.roughness_channel = p.roughness_channel;

    d.emission_enabled = p.emission_enabled;
    d.emission = p.emission;
    d.emission_energy = p.emission_energy;
    d.emission_operator = p.emission_operator;
    d.emission_on_uv2 = p.emission_on_uv2;
    d.emission_texture = p.emission_enabled ? texture_rid(TextureSlot::Emission) : RID{};
    d.normal_enabled = p.normal_enabled;
    d.normal_scale = p.normal_scale;
    d.normal_texture = p.normal_enabled ? texture_rid(TextureSlot::Normal) : RID{};
    d.ao_enabled = p.ao_enabled;
    d.ao_light_affect = p.ao_light_affect;
    d.ao_on_uv2 = p.ao_on_uv2;
    d.ao_texture = p.ao_enabled ? texture_rid(TextureSlot::AmbientOcclusion) : RID{};
    d.ao_channel = p.ao_channel;

    d.uv1_scale = p.uv1_scale;
    d.uv1_offset = p.uv1_offset;
    d.uv2_scale = p.uv2_scale;
    d.uv2_offset = p.uv2_offset;
    d.uv1_triplanar = p.uv1_triplanar;
    d.uv1_triplanar_sharpness = p.uv1_triplanar_sharpness;
    d.world_triplanar = p.world_triplanar;
    d.render_priority = render_priority();
    return d;
}

BakeMaterial SpatialMaterial::bake_material() const {
    BakeMaterial m;
    // emission_enabled is not asked: Godot's bake does not either (spec gi-bake section 3).
    m.input.albedo_color = params_.albedo.rgb();
    m.input.emission_color = params_.emission.rgb();
    m.input.emission_energy = params_.emission_energy;
    m.input.emission_multiply = params_.emission_operator == EmissionOperator::Multiply;
    // A texture without pixels: albedo black, as spec gi-bake section 3 has it; emission as if there were
    // none.
    static const auto no_pixels = std::make_shared<const Image>(
        Image{.size = glm::ivec2(1), .format = PixelFormat::RGBA8, .data = {0, 0, 0, 255}});
    if (const Ref<Texture>& albedo = texture(TextureSlot::Albedo)) {
        m.albedo_image = albedo->image() ? albedo->image() : no_pixels;
        m.input.albedo_texture = m.albedo_image.get();
    }
    if (const Ref<Texture>& emission = texture(TextureSlot::Emission)) {
        m.emission_image = emission->image();
        m.input.emission_texture = m.emission_image.get();
    }
    return m;
}

} // namespace cl::scene
