#include "drivers/gles3/passes/scene_draws.h"

#include "drivers/gles3/draw_block.h"

namespace cl::gles3 {

void SceneDraws::add(std::span<const DrawItem> items, const Frame& frame, LightSets& sets,
                     const Resources& resources, std::vector<SceneDraw>& out) {
    out.clear();
    for (const DrawItem& item : items) {
        if (const StoredSurface* surface = resources.meshes.surface(item.mesh, item.surface)) {
            shaders::DrawBlock block = make_draw_block(item, frame.camera.world_from_camera, frame.gi_probes);
            block.draw_cone_set = static_cast<float>(cone_sets_.number_of(item));
            out.push_back({&item, surface, draws_.push(block), sets.set_of(item)});
        }
    }
}

Status SceneDraws::prepare(const Frame& frame, const shaders::FrameBlock& frame_block,
                           std::span<const std::optional<PlacedLocalShadow>> local_shadows,
                           const Resources& resources) {
    frame_.clear();
    draws_.clear();
    light_sets_.clear();
    cone_sets_.clear();
    frame_.push(frame_block);
    std::vector<shaders::LocalLight> lights(frame.lights.size());
    for (size_t i = 0; i < lights.size(); ++i) {
        if (frame.lights[i].desc->type != LightType::Directional) {
            lights[i] = make_local_light(frame.lights[i], frame.camera.world_from_camera, local_shadows[i]);
        }
    }
    LightSets sets(lights);
    add(frame.opaque, frame, sets, resources, opaque_);
    add(frame.transparent, frame, sets, resources, transparent_);
    for (const shaders::LightSetBlock& set : sets.blocks()) {
        light_sets_.push(set);
    }
    if (Status s = frame_.upload(); !s) {
        return s;
    }
    if (Status s = draws_.upload(); !s) {
        return s;
    }
    return light_sets_.upload();
}

void SceneDraws::bind(const SceneDraw& draw) const {
    draws_.bind(draw.block);
    light_sets_.bind(draw.light_set);
}

} // namespace cl::gles3
