#pragma once

#include "drivers/gles3/block_stream.h"
#include "drivers/gles3/cone_sets.h"
#include "drivers/gles3/light_sets.h"
#include "drivers/gles3/passes/resources.h"
#include "drivers/gles3/shaders.h"

#include "servers/rasterizer.h"

#include <optional>
#include <span>
#include <vector>

namespace cl::gles3 {

/// A surface of the frame with its data on the GPU.
struct SceneDraw {
    const DrawItem* item = nullptr;
    const StoredSurface* surface = nullptr;
    int block = 0;     ///< copy of the Draw block
    int light_set = 0; ///< copy of the LightSet block
};

/// The frame's uniform blocks, and its surfaces ready to be drawn. Items whose mesh is gone are left out.
class SceneDraws {
public:
    Status prepare(const Frame& frame, const shaders::FrameBlock& frame_block,
                   std::span<const std::optional<PlacedLocalShadow>> local_shadows,
                   const Resources& resources);
    /// The GI probes of the surfaces, by the numbers in their blocks.
    [[nodiscard]] const ConeSets& cone_sets() const noexcept { return cone_sets_; }
    /// In the order of the frame.
    [[nodiscard]] std::span<const SceneDraw> opaque() const noexcept { return opaque_; }
    [[nodiscard]] std::span<const SceneDraw> transparent() const noexcept { return transparent_; }
    /// Makes the frame's block visible to programs.
    void bind_frame() const { frame_.bind(0); }
    /// ... and a surface's blocks.
    void bind(const SceneDraw& draw) const;

private:
    void add(std::span<const DrawItem> items, const Frame& frame, LightSets& sets, const Resources& resources,
             std::vector<SceneDraw>& out);
    BlockStream<shaders::FrameBlock> frame_;
    BlockStream<shaders::DrawBlock> draws_;
    BlockStream<shaders::LightSetBlock> light_sets_;
    ConeSets cone_sets_;
    std::vector<SceneDraw> opaque_, transparent_;
};

} // namespace cl::gles3
