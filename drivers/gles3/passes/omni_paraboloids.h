#pragma once

#include "drivers/gles3/gl/framebuffer.h"
#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/passes/caster_draw.h"

#include <map>
#include <vector>

namespace cl::gles3 {

/// Draws the shadow map of an omni light with ShadowFit::AsSet, as Godot does: six faces of a cube, folded
/// into two paraboloids (spec scene-classes section 9).
class OmniParaboloids {
public:
    /// @param atlas   no pass may be open
    /// @param slot    the light's part of it
    /// @param bias_m  added to all distances
    Status draw(const gl::Framebuffer& atlas, const gl::Rect& slot, const LightItem& light, float bias_m,
                const Resources& resources, CasterDraw& casters);

private:
    struct Cube {
        gl::TextureCube texture;
        std::vector<gl::Framebuffer> faces; ///< in the order of gl::CubeFace
    };
    Expected<const Cube*> cube_of(int size);

    std::map<int, Cube> cubes_; ///< by edge [texels]
    gl::ShaderVariants<shaders::OmniParaboloid> folds_;
};

} // namespace cl::gles3
