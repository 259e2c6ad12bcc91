#pragma once

#include "drivers/gles3/shaders.h"

#include "servers/rasterizer.h"

#include <span>

namespace cl::gles3 {

/// Fills the Draw block of one surface: its place, material and GI probes in view space.
/// @param probes  the frame's; indices of the item beyond them are treated as "none"
[[nodiscard]] shaders::DrawBlock make_draw_block(const DrawItem& item, const Transform& world_from_view,
                                                 std::span<const GIProbeShading> probes) noexcept;

/// A probe as the shader wants it. A probe without a volume gathers nothing (spec gi-shading section 2).
/// @param receives_baked_light  of the instance: else its cones start at the surface itself
[[nodiscard]] shaders::GIProbe make_gi_probe(const GIProbeShading& probe, const Transform& world_from_view,
                                             bool receives_baked_light) noexcept;

/// Weights whose dot product with a texel is the channel's value.
[[nodiscard]] glm::vec4 channel_mask(TextureChannel channel) noexcept;

} // namespace cl::gles3
