#include "drivers/gles3/passes/scene_pass.h"

#include "servers/shading/background.h"

#include <utility>

namespace cl::gles3 {

namespace {

using S = shaders::Scene;
using Program = gl::ShaderProgram<S>;

void bind_material(const MaterialDesc& m, const TextureStorage& textures) {
    const RID emission = m.emission_enabled ? m.emission_texture : RID{};
    Program::bind(S::albedo_map, textures.get_or(m.albedo_texture, DefaultTexture::White));
    Program::bind(S::normal_map, textures.get_or(m.normal_texture, DefaultTexture::FlatNormal));
    Program::bind(S::metallic_map, textures.get_or(m.metallic_texture, DefaultTexture::White));
    Program::bind(S::roughness_map, textures.get_or(m.roughness_texture, DefaultTexture::White));
    Program::bind(S::emission_map, textures.get_or(emission, DefaultTexture::Black));
    Program::bind(S::ao_map, textures.get_or(m.ao_enabled ? m.ao_texture : RID{}, DefaultTexture::White));
}

/// A probe's volume, or an empty one: its bounds of 0 keep it from being looked at.
const gl::Texture3D& volume_of(const DrawItem& item, size_t slot, const ScenePass::Inputs& inputs,
                               uint32_t variant) {
    const int index = item.gi_probes[slot];
    if ((variant & S::kGiGathered) != 0 || index < 0 ||
        static_cast<size_t>(index) >= inputs.frame.gi_probes.size()) {
        return inputs.resources.volumes.empty();
    }
    const RID rid = inputs.frame.gi_probes[static_cast<size_t>(index)].volume;
    const gl::Texture3D* volume = inputs.resources.volumes.get(rid);
    return volume ? *volume : inputs.resources.volumes.empty();
}

/// The frame's GI field: all its probes share one.
const StoredField& field_of(const ScenePass::Inputs& inputs) {
    for (const GIProbeShading& probe : inputs.frame.gi_probes) {
        if (const StoredField* field = inputs.resources.fields.get(probe.field)) {
            return *field;
        }
    }
    return inputs.resources.fields.empty();
}

} // namespace

Expected<ScenePass> ScenePass::create() {
    Expected<gl::Texture2D> texture =
        gl::Texture2D::create({.size = {1, 1},
                               .format = gl::Format::Depth24,
                               .sampler = {.filter = gl::Filter::Linear, .compare = gl::Compare::LessEqual},
                               .label = "no shadow"});
    if (!texture) {
        return texture.error();
    }
    return ScenePass(*std::move(texture));
}

void ScenePass::bind_frame_inputs(const Inputs& inputs) const {
    inputs.draws.bind_frame();
    const StoredSky& sky = inputs.sky ? *inputs.sky : inputs.resources.skies.none();
    Program::bind(S::shadow_atlas, inputs.shadow_atlas ? *inputs.shadow_atlas : no_shadow_);
    Program::bind(S::directional_shadow, inputs.directional_shadow ? *inputs.directional_shadow : no_shadow_);
    Program::bind(S::sky_irradiance_map, sky.irradiance);
    Program::bind(S::sky_radiance_map, sky.radiance);
    const StoredField& field = field_of(inputs);
    Program::bind(S::field_bricks, field.bricks);
    Program::bind(S::field_joints, field.joints);
    Program::bind(S::field_light, field.light);
    Program::bind(S::field_air, field.air);
}

Status ScenePass::draw_surface(gl::Pass& pass, const SceneDraw& draw, const Inputs& inputs, uint32_t variant,
                               const gl::DrawState& state, FrameStats& stats) {
    const auto program = programs_.get(variant);
    if (!program) {
        return program.error();
    }
    inputs.draws.bind(draw);
    bind_material(*draw.item->material, inputs.resources.textures);
    Program::bind(S::gi_volume_1, volume_of(*draw.item, 0, inputs, variant));
    Program::bind(S::gi_volume_2, volume_of(*draw.item, 1, inputs, variant));
    pass.draw(**program, draw.surface->vertex_array, state, draw.surface->range);
    ++stats.draw_calls;
    stats.triangles += draw.surface->triangles;
    return {};
}

Status ScenePass::draw_opaque(const RenderTarget& target, const Inputs& inputs, Prepass prepass,
                              FrameStats& stats) {
    const Frame& frame = inputs.frame;
    const bool keeps = frame.has_environment && frame.environment.background_mode == BackgroundMode::Keep;
    gl::Pass pass({.label = "opaque",
                   .target = &target.scene,
                   .colors = {keeps ? gl::Load::Keep : gl::Load::Clear},
                   .clear_colors = {glm::vec4(shading::background_color(frame), 1.0f)},
                   .depth = prepass != Prepass::None ? gl::Load::Keep : gl::Load::Clear});
    bind_frame_inputs(inputs);
    if (prepass == Prepass::Gathered) {
        Program::bind(S::cone_light, target.cones->light);
    }
    // Blended surfaces with an opaque prepass come last, over all that is solid.
    for (const bool blended : {false, true}) {
        for (const SceneDraw& draw : inputs.draws.opaque()) {
            if (is_opaque_prepass(*draw.item->material) != blended) {
                continue;
            }
            const uint32_t variant =
                scene_variant(*draw.item, draw.surface->format, inputs.features, prepass);
            const gl::DrawState state = opaque_state(*draw.item, prepass);
            if (Status s = draw_surface(pass, draw, inputs, variant, state, stats); !s) {
                return s;
            }
        }
    }
    return {};
}

Status ScenePass::draw_transparent(const RenderTarget& target, const Inputs& inputs, FrameStats& stats) {
    if (inputs.draws.transparent().empty()) {
        return {};
    }
    gl::Pass pass({.label = "transparent", .target = &target.scene});
    bind_frame_inputs(inputs);
    for (const SceneDraw& draw : inputs.draws.transparent()) {
        const uint32_t variant =
            scene_variant(*draw.item, draw.surface->format, inputs.features, Prepass::None);
        if (Status s = draw_surface(pass, draw, inputs, variant, transparent_state(*draw.item), stats); !s) {
            return s;
        }
    }
    return {};
}

} // namespace cl::gles3
