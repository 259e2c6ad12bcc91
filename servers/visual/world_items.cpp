// FrameBuilder: the whole scene, for rasterisers that follow light themselves.
#include "servers/visual/frame_builder.h"

#include <glm/matrix.hpp>

#include <algorithm>

namespace cl {

void FrameBuilder::add_world(const Scenario& scenario, FirstError& errors) {
    const auto collect = [this](RID rid) {
        if (instances_.get(rid)->visible) {
            seen_.push_back(rid);
        }
    };
    seen_.clear();
    scenario.local_lights.all(collect);
    std::sort(seen_.begin(), seen_.end()); // the tree's own order changes when it is rebuilt
    for (RID rid : seen_) {
        light_index(rid);
    }
    seen_.clear();
    scenario.meshes.all(collect);
    std::sort(seen_.begin(), seen_.end());
    for (RID rid : seen_) {
        add_world_instance(*instances_.get(rid), errors);
    }
}

void FrameBuilder::add_world_instance(const Instance& instance, FirstError& errors) {
    const Mesh* mesh = storage_.meshes.get(instance.base);
    const RID uploaded = storage_.meshes.uploaded(instance.base, errors);
    if (!mesh || !uploaded) {
        return;
    }
    WorldItem item;
    item.mesh = uploaded;
    item.world_from_local = instance.world_from_local;
    item.mirrored = glm::determinant(instance.world_from_local.basis) < 0.0f;
    item.layers = instance.layers;
    item.casting = instance.casting;
    for (int surface = 0; surface < static_cast<int>(mesh->surfaces.size()); ++surface) {
        item.surface = surface;
        item.material = surface_material(storage_, instance, *mesh, surface, errors).desc;
        world_.push_back(item);
    }
}

} // namespace cl
