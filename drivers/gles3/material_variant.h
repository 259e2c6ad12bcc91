#pragma once

#include "drivers/gles3/frame_block.h"
#include "drivers/gles3/gl/draw_state.h"

#include "servers/rasterizer.h"

#include <cstdint>

namespace cl::gles3 {

// Which variant of the scene shader a surface needs. Compiling one costs 100 to 300 ms on llvmpipe, whose
// branches save nothing: hence variants, but few. What varies for the whole frame is in all variants of that
// frame.

/// What is known of the opaque surfaces' pixels before they are shaded.
enum class Prepass : uint8_t {
    None,
    Done,     ///< depth: what the alpha scissor cuts out is settled by it, too
    Gathered, ///< and the light that the cones of GI probes gather
};

/// Bits of shaders::Scene. @param format  surface_format bits: which attributes the mesh has
[[nodiscard]] uint32_t scene_variant(const DrawItem& item, uint32_t format, const FrameFeatures& features,
                                     Prepass prepass) noexcept;

/// Bits of shaders::ConePoints.
[[nodiscard]] uint32_t cone_points_variant(const MaterialDesc& material, uint32_t format) noexcept;

/// Depth, culling and blending in the pass for opaque surfaces.
[[nodiscard]] gl::DrawState opaque_state(const DrawItem& item, Prepass prepass) noexcept;
/// ... in the sorted pass behind it.
[[nodiscard]] gl::DrawState transparent_state(const DrawItem& item) noexcept;
/// ... in the depth prepass.
[[nodiscard]] gl::DrawState depth_state(const DrawItem& item) noexcept;
/// ... in a shadow map.
[[nodiscard]] gl::DrawState caster_state(const CasterItem& caster, const LightDesc& light) noexcept;

/// True if the surface has holes that depth alone must know of: an alpha scissor, or the opaque prepass of a
/// transparent material.
[[nodiscard]] bool has_holes(const MaterialDesc& material) noexcept;
/// Alpha below which a fragment is a hole.
[[nodiscard]] float hole_threshold(const MaterialDesc& material) noexcept;
/// Drawn among the opaque surfaces, but blended: last of them, over the depth of its own opaque parts.
[[nodiscard]] bool is_opaque_prepass(const MaterialDesc& material) noexcept;
/// Whether the prepass tells all of a surface's pixels: then only equal depth is shaded.
[[nodiscard]] bool is_settled(const MaterialDesc& material) noexcept;
/// Whether a surface takes part in the depth prepass.
[[nodiscard]] bool writes_depth(const MaterialDesc& material) noexcept;

} // namespace cl::gles3
