#include "drivers/gles3/passes/depth_pass.h"

#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/material_variant.h"

namespace cl::gles3 {

Status DepthPass::draw(const RenderTarget& target, const SceneDraws& draws, const Resources& resources) {
    using S = shaders::Depth;
    gl::Pass pass({.label = "depth prepass", .target = &target.depth_only, .depth = gl::Load::Clear});
    draws.bind_frame();
    for (const SceneDraw& draw : draws.opaque()) {
        const MaterialDesc& m = *draw.item->material;
        if (!writes_depth(m)) {
            continue;
        }
        const auto program = programs_.get(has_holes(m) ? S::kAlphaScissor : 0u);
        if (!program) {
            return program.error();
        }
        draws.bind(draw);
        if (has_holes(m)) {
            (*program)->bind(S::albedo_map,
                             resources.textures.get_or(m.albedo_texture, DefaultTexture::White));
        }
        pass.draw(**program, draw.surface->vertex_array, depth_state(*draw.item), draw.surface->range);
    }
    return {};
}

} // namespace cl::gles3
