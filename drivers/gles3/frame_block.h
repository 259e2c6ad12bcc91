#pragma once

#include "drivers/gles3/directional_splits.h"
#include "drivers/gles3/shaders.h"

#include "servers/rasterizer.h"

#include <span>

namespace cl::gles3 {

/// What a frame turns on for all its draws: part of the choice of shader variant.
struct FrameFeatures {
    bool sky = false; ///< ambient light and reflections from a sky
    bool fog = false;
    bool directional = false, omni = false, spot = false;
    bool omni_faces = false; ///< how omnis' shadow maps were drawn
    int gi_probes = 0;       ///< most that reach one surface: 0 to 2
    bool gi_field = false;   ///< their light is a GI field
    int shadow_filter = 1;   ///< of Frame
};
/// GI probes that reach a surface: 0 to 2.
[[nodiscard]] int probe_count(const DrawItem& item) noexcept;
[[nodiscard]] FrameFeatures frame_features(const Frame& frame, bool has_sky) noexcept;

/// A directional light's shadow with its place in the shared map.
struct PlacedDirectionalShadow {
    DirectionalShadow shadow; ///< count 0: none
    MapArea area;
    int map_size = 1; ///< of the texture that the area is part of [texels]
};

/// Fills the Frame block. @param shadows  one per directional light of the frame
[[nodiscard]] shaders::FrameBlock make_frame_block(const Frame& frame,
                                                   std::span<const PlacedDirectionalShadow> shadows) noexcept;

/// A light's colour times energy, with the pi that makes a white Lambert surface facing it send out
/// radiance 1.
[[nodiscard]] glm::vec3 light_color(const LightDesc& light) noexcept;

} // namespace cl::gles3
