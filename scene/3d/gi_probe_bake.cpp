#include "scene/3d/gi_probe_bake.h"

#include "scene/3d/mesh_instance.h"
#include "scene/3d/spatial.h"

#include "servers/mesh_surface.h"

#include "core/io/log.h"
#include "core/threads.h"

#include <memory>
#include <string>
#include <unordered_map>
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

/// Decoded surfaces and captured materials, each made once for all items that share them, on all workers.
class BakeInputs {
public:
    explicit BakeInputs(const std::vector<BakeItem>& items) {
        for (const BakeItem& item : items) {
            const std::span<const MeshSurface> surfaces = item.mesh->surfaces();
            for (size_t i = 0; i < surfaces.size(); ++i) {
                if (surfaces[i].primitive == PrimitiveType::Triangles) {
                    arrays_.try_emplace(&surfaces[i]);
                    captures_.try_emplace(item.materials[i].get());
                }
            }
        }
        decode_surfaces();
        capture_materials();
    }

    /// nullptr if the surface is not one of triangles or its bytes are damaged.
    [[nodiscard]] const SurfaceArrays* arrays(const MeshSurface& surface) const {
        const auto known = arrays_.find(&surface);
        return known != arrays_.end() ? known->second.get() : nullptr;
    }
    /// Of a surface that has arrays().
    [[nodiscard]] const gi::MaterialCapture* capture(const Ref<Material>& material) const {
        return captures_.at(material.get()).get();
    }

private:
    void decode_surfaces() {
        const std::vector<const MeshSurface*> todo = keys(arrays_);
        std::vector<std::unique_ptr<SurfaceArrays>> made(todo.size());
        std::vector<std::string> errors(todo.size());
        parallel_for_each(todo.size(), [&](size_t i) {
            Expected<SurfaceArrays> decoded = decode_surface(*todo[i]);
            if (decoded) {
                made[i] = std::make_unique<SurfaceArrays>(std::move(*decoded));
            } else {
                errors[i] = decoded.error().message;
            }
        });
        for (size_t i = 0; i < todo.size(); ++i) {
            arrays_[todo[i]] = std::move(made[i]);
            if (!errors[i].empty()) {
                log_warning("GI bake: a surface is left out: " + errors[i]);
            }
        }
    }

    void capture_materials() {
        const std::vector<const Material*> todo = keys(captures_);
        std::vector<BakeMaterial> inputs; // asked for on this thread: materials are not made for more
        inputs.reserve(todo.size());
        for (const Material* material : todo) {
            inputs.push_back(material ? material->bake_material() : BakeMaterial{});
        }
        std::vector<std::unique_ptr<gi::MaterialCapture>> made(todo.size());
        parallel_for_each(todo.size(), [&](size_t i) {
            made[i] = std::make_unique<gi::MaterialCapture>(gi::capture_material(inputs[i].input));
        });
        for (size_t i = 0; i < todo.size(); ++i) {
            captures_[todo[i]] = std::move(made[i]);
        }
    }

    template <typename Map>
    static std::vector<typename Map::key_type> keys(const Map& map) {
        std::vector<typename Map::key_type> out;
        out.reserve(map.size());
        for (const auto& entry : map) {
            out.push_back(entry.first);
        }
        return out;
    }

    std::unordered_map<const MeshSurface*, std::unique_ptr<SurfaceArrays>> arrays_;
    std::unordered_map<const Material*, std::unique_ptr<gi::MaterialCapture>> captures_;
};

std::vector<gi::PlotSurface> plot_surfaces(const std::vector<BakeItem>& items, const BakeInputs& inputs) {
    std::vector<gi::PlotSurface> plots;
    for (const BakeItem& item : items) {
        const std::span<const MeshSurface> surfaces = item.mesh->surfaces();
        for (size_t i = 0; i < surfaces.size(); ++i) {
            if (const SurfaceArrays* arrays = inputs.arrays(surfaces[i])) {
                plots.push_back({.local_from_mesh = item.probe_from_mesh,
                                 .positions = arrays->positions,
                                 .normals = arrays->normals,
                                 .uvs = arrays->uvs,
                                 .indices = arrays->indices,
                                 .material = inputs.capture(item.materials[i])});
            }
        }
    }
    return plots;
}

int64_t triangle_count(const std::vector<gi::PlotSurface>& plots) {
    int64_t corners = 0;
    for (const gi::PlotSurface& p : plots) {
        corners += static_cast<int64_t>(p.indices.empty() ? p.positions.size() : p.indices.size());
    }
    return corners / 3;
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
    const BakeInputs inputs(items);
    const std::vector<gi::PlotSurface> plots = plot_surfaces(items, inputs);
    const Expected<gi::Octree> octree = gi::voxelize(*grid, plots, progress);
    if (!octree) {
        return octree.error();
    }
    BakeResult result;
    result.data.bounds = grid->box;
    result.data.cell_size_m = grid->cell_size_m;
    result.data.cells_from_local = grid->cells_from_local;
    result.data.dynamic_data = gi::encode_octree(*octree);
    result.figures = {.size = octree->dims,
                      .cells = static_cast<uint32_t>(octree->cells.size()),
                      .leaves = octree->leaf_count,
                      .triangles = triangle_count(plots),
                      .meshes = items.size()};
    return result;
}

} // namespace cl::scene
