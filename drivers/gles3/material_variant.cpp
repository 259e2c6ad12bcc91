#include "drivers/gles3/material_variant.h"

#include "drivers/gles3/shaders.h"

#include "servers/mesh_surface.h"

namespace cl::gles3 {

namespace {

using shaders::Scene;

/// Opaque parts of a material with the opaque prepass: those that no blending can show through.
constexpr float kOpaqueAlpha = 0.99f;

uint32_t reflection_bits(const MaterialDesc& m) noexcept {
    if (m.is_default) {
        return Scene::kDiffuseLambert | Scene::kSpecularDisabled;
    }
    if (m.vertex_lighting) {
        // Per fragment here, with the terms that Godot computes per vertex.
        return Scene::kDiffuseLambert | Scene::kSpecularBlinn;
    }
    uint32_t bits = 0;
    switch (m.diffuse_mode) {
    case DiffuseMode::Burley:
        break;
    case DiffuseMode::Lambert:
        bits |= Scene::kDiffuseLambert;
        break;
    case DiffuseMode::LambertWrap:
        bits |= Scene::kDiffuseWrap;
        break;
    case DiffuseMode::OrenNayar:
        bits |= Scene::kDiffuseOrenNayar;
        break;
    case DiffuseMode::Toon:
        bits |= Scene::kDiffuseToon;
        break;
    }
    switch (m.specular_mode) {
    case SpecularMode::SchlickGGX:
        break;
    case SpecularMode::Blinn:
        bits |= Scene::kSpecularBlinn;
        break;
    case SpecularMode::Phong:
        bits |= Scene::kSpecularPhong;
        break;
    case SpecularMode::Toon:
        bits |= Scene::kSpecularToon;
        break;
    case SpecularMode::Disabled:
        bits |= Scene::kSpecularDisabled;
        break;
    }
    return bits;
}

/// Larger sets bind stand-ins, so that a scene's materials share few variants.
uint32_t map_bits(const MaterialDesc& m, uint32_t format) noexcept {
    const bool has_more = m.metallic_texture || m.roughness_texture ||
                          (m.emission_enabled && m.emission_texture) || (m.ao_enabled && m.ao_texture);
    // Without tangents there is no frame to turn a normal in.
    const bool has_normals = m.normal_enabled && m.normal_texture && (format & surface_format::kTangent);
    uint32_t bits = m.albedo_texture || has_more || has_normals ? Scene::kAlbedoMap : 0u;
    bits |= has_more ? Scene::kMoreMaps : 0u;
    bits |= has_normals ? Scene::kNormalMap : 0u;
    return bits;
}

/// Surfaces without probes take no rounds of GI's loops, which is cheaper than a second set of variants.
uint32_t gi_bits(const DrawItem& item, const FrameFeatures& f, Prepass prepass) noexcept {
    if (f.gi_probes == 0) {
        return 0u;
    }
    if (prepass == Prepass::Gathered && is_settled(*item.material)) {
        return Scene::kGiGathered;
    }
    return (f.gi_probes == 1 ? Scene::kGiOne : Scene::kGiTwo) | (f.gi_field ? Scene::kGiField : 0u);
}

/// What varies for the whole frame.
uint32_t frame_bits(const FrameFeatures& f) noexcept {
    const uint32_t lights = (f.directional ? Scene::kDirectional : 0u) | (f.omni ? Scene::kOmni : 0u) |
                            (f.omni_faces ? Scene::kOmniFaces : 0u) | (f.spot ? Scene::kSpot : 0u);
    const uint32_t filter = f.shadow_filter <= 0 ? Scene::kPcf1 : (f.shadow_filter >= 2 ? Scene::kPcf13 : 0u);
    return lights | (lights != 0 ? filter : 0u) | (f.sky ? Scene::kSky : 0u) | (f.fog ? Scene::kFog : 0u);
}

gl::Cull cull_of(CullMode mode) noexcept {
    switch (mode) {
    case CullMode::Back:
        return gl::Cull::Back;
    case CullMode::Front:
        return gl::Cull::Front;
    case CullMode::Disabled:
        break;
    }
    return gl::Cull::Off;
}

gl::Cull opposite(gl::Cull cull) noexcept {
    switch (cull) {
    case gl::Cull::Back:
        return gl::Cull::Front;
    case gl::Cull::Front:
        return gl::Cull::Back;
    case gl::Cull::Off:
        break;
    }
    return gl::Cull::Off;
}

/// Front faces are clockwise; a mirroring transform turns them over.
template <typename Item>
gl::FrontFace front_face(const Item& item) noexcept {
    return item.mirrored ? gl::FrontFace::CounterClockwise : gl::FrontFace::Clockwise;
}

gl::Blend blend_of(BlendMode mode) noexcept {
    switch (mode) {
    case BlendMode::Mix:
        return gl::blend::kMix;
    case BlendMode::Add:
        return gl::blend::kAdd;
    case BlendMode::Sub:
        return gl::blend::kSub;
    case BlendMode::Mul:
        return gl::blend::kMul;
    }
    return gl::blend::kMix;
}

} // namespace

bool is_opaque_prepass(const MaterialDesc& m) noexcept {
    return m.transparent && !m.alpha_scissor && m.depth_draw_mode == DepthDrawMode::AlphaOpaquePrepass;
}

bool has_holes(const MaterialDesc& m) noexcept {
    return m.alpha_scissor || is_opaque_prepass(m);
}

float hole_threshold(const MaterialDesc& m) noexcept {
    return m.alpha_scissor ? m.alpha_scissor_threshold : kOpaqueAlpha;
}

bool writes_depth(const MaterialDesc& m) noexcept {
    return m.depth_draw_mode != DepthDrawMode::Never;
}

bool is_settled(const MaterialDesc& m) noexcept {
    return writes_depth(m) && !is_opaque_prepass(m);
}

uint32_t cone_points_variant(const MaterialDesc& m, uint32_t format) noexcept {
    using shaders::ConePoints;
    const uint32_t maps = map_bits(m, format);
    return (has_holes(m) ? ConePoints::kAlphaScissor : 0u) |
           ((maps & Scene::kNormalMap) != 0 ? ConePoints::kNormalMap : 0u) |
           (m.roughness_texture ? ConePoints::kMoreMaps : 0u);
}

uint32_t scene_variant(const DrawItem& item, uint32_t format, const FrameFeatures& features,
                       Prepass prepass) noexcept {
    const MaterialDesc& m = *item.material;
    const bool discards = m.alpha_scissor && (prepass == Prepass::None || !writes_depth(m));
    const uint32_t scissor = discards ? Scene::kAlphaScissor : 0u;
    if (m.unshaded) {
        return Scene::kUnshaded | scissor | (m.albedo_texture ? Scene::kAlbedoMap : 0u);
    }
    const bool in_air = features.gi_field && features.gi_probes > 0 && !item.is_still;
    return scissor | map_bits(m, format) | reflection_bits(m) | frame_bits(features) |
           gi_bits(item, features, prepass) | (in_air ? Scene::kGiAir : 0u) |
           (features.gi_field && features.gi_probes > 0 && m.is_glossy() ? Scene::kGiGloss : 0u);
}

gl::DrawState opaque_state(const DrawItem& item, Prepass prepass) noexcept {
    const MaterialDesc& m = *item.material;
    gl::DrawState s;
    const bool settled = prepass != Prepass::None && is_settled(m);
    s.depth_test = settled ? gl::DepthTest::Equal : gl::DepthTest::LessEqual;
    s.write = settled || !writes_depth(m) ? gl::WriteMask::Color : gl::WriteMask::ColorAndDepth;
    s.cull = cull_of(m.cull_mode);
    s.front_face = front_face(item);
    if (is_opaque_prepass(m)) {
        s.blend = gl::blend::kMix;
    }
    return s;
}

gl::DrawState transparent_state(const DrawItem& item) noexcept {
    const MaterialDesc& m = *item.material;
    gl::DrawState s;
    s.depth_test = m.no_depth_test ? gl::DepthTest::Off : gl::DepthTest::LessEqual;
    s.write =
        m.depth_draw_mode == DepthDrawMode::Always ? gl::WriteMask::ColorAndDepth : gl::WriteMask::Color;
    s.cull = cull_of(m.cull_mode);
    s.front_face = front_face(item);
    s.blend = blend_of(m.blend_mode);
    return s;
}

gl::DrawState depth_state(const DrawItem& item) noexcept {
    gl::DrawState s;
    s.write = gl::WriteMask::Depth;
    s.cull = cull_of(item.material->cull_mode);
    s.front_face = front_face(item);
    return s;
}

gl::DrawState caster_state(const CasterItem& caster, const LightDesc& light) noexcept {
    gl::DrawState s;
    s.write = gl::WriteMask::Depth;
    const gl::Cull cull = caster.double_sided ? gl::Cull::Off : cull_of(caster.material->cull_mode);
    s.cull = light.shadow_reverse_cull_face ? opposite(cull) : cull;
    s.front_face = front_face(caster);
    return s;
}

} // namespace cl::gles3
