#pragma once

#include "drivers/gles3/gl/draw_state.h"

#include "core/math/transform.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace cl::gles3 {

/// An omni light's shadow map with ShadowFit::ByTexel: the six faces of a cube, drawn straight into tiles of
/// the light's slot. The faces of +x, +y, +z stand in a row, above them those of -x, -y, -z. Each shows more
/// than 90 degrees, by what a filter reaches, so that no look-up leaves its tile. GLSL twin:
/// shaders/lib/omni_faces.glsl.
class OmniFaces {
public:
    /// @param slot  the light's part of the shadow atlas, a square [texels]
    explicit OmniFaces(const gl::Rect& slot) noexcept;
    /// All tiles.
    [[nodiscard]] gl::Rect rect() const noexcept { return {corner_, glm::ivec2(3, 2) * tile_}; }
    /// @param face  0 to 5, in the order above
    [[nodiscard]] gl::Rect rect(int face) const noexcept;
    /// View of a face, which looks along -z, from the light's own axes.
    [[nodiscard]] static Transform face_from_light(int face) noexcept;
    /// Projection of every face; it has no far end. Depth in 0..1 is 1 - near / distance along its axis.
    [[nodiscard]] glm::mat4 clip_from_face(float near_m) const noexcept;
    /// What omni_face_at in GLSL asks for. @param atlas_size  [texels]
    [[nodiscard]] glm::vec4 uv_tiles(int atlas_size) const noexcept;
    /// Edge of a texel on a plane across a face's axis, one metre away [m].
    [[nodiscard]] float texel_at_one_metre() const noexcept { return 2.0f / right_angle_; }

private:
    glm::ivec2 corner_; ///< [texels]
    int tile_;          ///< edge [texels]
    float right_angle_; ///< what 90 degrees take of it [texels]
};

} // namespace cl::gles3
