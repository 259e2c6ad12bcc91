#include "scene/3d/gi_probe_bake.h"

#include "scene/3d/bake_inputs.h"
#include "scene/3d/mesh_instance.h"
#include "scene/3d/spatial.h"

#include <memory>
#include <utility>

namespace cl::scene {

namespace {

class ItemCollector {
public:
    ItemCollector(const Transform& world_from_probe, const glm::vec3& extents_m)
        : probe_from_world_(world_from_probe.inverse()), box_{-extents_m, 2.0f * extents_m} {}

    void visit(const Node& node) {
        const auto* spatial = dynamic_cast<const Spatial*>(&node);
        if (spatial && spatial->is_visible_in_tree()) {
            add_mesh_instance(*spatial);
            add_built_meshes(*spatial);
        }
        for (const std::unique_ptr<Node>& child : node.children()) {
            visit(*child);
        }
    }

    std::vector<BakeItem> take() { return std::move(items_); }

private:
    void add_mesh_instance(const Spatial& node) {
        const auto* instance = dynamic_cast<const MeshInstance*>(&node);
        if (!instance || !instance->use_in_baked_light()) {
            return;
        }
        BakeItem* item = add(probe_from_world_ * node.global_transform(), instance->mesh());
        for (int i = 0; item && i < instance->mesh()->surface_count(); ++i) {
            item->materials.push_back(instance->active_material(i));
        }
    }

    void add_built_meshes(const Spatial& node) {
        for (const BakeMesh& built : node.bake_meshes()) {
            BakeItem* item = add(probe_from_world_ * node.global_transform() * built.local, built.mesh);
            for (int i = 0; item && i < built.mesh->surface_count(); ++i) {
                item->materials.push_back(built.mesh->surface_material(i));
            }
        }
    }

    /// nullptr if there is no mesh or it lies outside the box.
    BakeItem* add(const Transform& probe_from_mesh, const Ref<Mesh>& mesh) {
        if (!mesh || !transformed(probe_from_mesh, mesh->aabb()).intersects(box_)) {
            return nullptr;
        }
        items_.push_back({probe_from_mesh, mesh, {}});
        return &items_.back();
    }

    Transform probe_from_world_;
    AABB box_;
    std::vector<BakeItem> items_;
};

Expected<gi::BakedOctree> bake_inputs(const gi::Grid& grid, const BakeRequest& request, BakeInputs& inputs,
                                      const gi::BakeProgress& progress) {
    if (!request.memory) {
        return gi::voxelize(grid, inputs.all_plots(), progress);
    }
    const auto source = [&inputs](std::span<const uint32_t> numbers) { return inputs.plots(numbers); };
    return gi::revoxelize(grid, inputs.digests(), source, request.memory->bricks, request.last_result,
                          progress);
}

} // namespace

std::vector<BakeItem> collect_bake_items(const Node& start, const Transform& world_from_probe,
                                         const glm::vec3& extents_m) {
    ItemCollector collector(world_from_probe, extents_m);
    collector.visit(start);
    return collector.take();
}

Expected<BakeResult> bake_probe(const Node& start, const BakeRequest& request,
                                const gi::BakeProgress& progress) {
    const Expected<gi::Grid> grid = gi::compute_grid(request.extents_m, request.subdivision);
    if (!grid) {
        return grid.error();
    }
    const std::vector<BakeItem> items =
        collect_bake_items(start, request.world_from_probe, request.extents_m);
    BakeInputs inputs(items, request.memory);
    Expected<gi::BakedOctree> octree = bake_inputs(*grid, request, inputs, progress);
    if (!octree) {
        return octree.error();
    }
    BakeResult result;
    result.data.bounds = grid->box;
    result.data.cell_size_m = grid->cell_size_m;
    result.data.cells_from_local = grid->cells_from_local;
    result.data.dynamic_data = std::move(octree->dynamic_data);
    result.figures = {.size = grid->dims,
                      .cells = octree->cell_count,
                      .leaves = octree->leaf_count,
                      .triangles = inputs.triangle_count(),
                      .meshes = items.size()};
    return result;
}

} // namespace cl::scene
