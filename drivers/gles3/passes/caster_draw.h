#pragma once

#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/passes/resources.h"
#include "drivers/gles3/shaders.h"

#include "servers/rasterizer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace cl::gles3 {

/// One look of a light at its casters.
struct CasterView {
    Transform light_from_world; ///< the light looks along -z
    glm::mat4 clip_from_light{1.0f};
    glm::vec2 bias_m{0.0f}; ///< away from the light: everywhere, and where a surface is parallel to the rays
};

/// False if no part of a world box is inside the view's clip volume (it may be true of a box that just
/// misses).
[[nodiscard]] bool may_be_visible(const CasterView& view, const AABB& world_box) noexcept;

/// Draws depth of shadow casters; shared by all kinds of shadow maps.
class CasterDraw {
public:
    /// Draws what the view may see into the pass's current viewport. @return the first shader error.
    Status draw(gl::Pass& pass, const LightItem& light, const CasterView& view, const Resources& resources);
    [[nodiscard]] size_t variant_count() const noexcept { return programs_.size(); }

private:
    Status draw_one(gl::Pass& pass, const CasterItem& caster, const LightDesc& light, const CasterView& view,
                    const Resources& resources);
    gl::ShaderVariants<shaders::ShadowCaster> programs_;
};

} // namespace cl::gles3
