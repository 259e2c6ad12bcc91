#pragma once

#include "scene/3d/geometry_instance.h"
#include "scene/resources/mesh.h"
#include "scene/resources/watched_ref.h"

#include "core/node_path.h"

#include <map>
#include <string>
#include <vector>

namespace cl::scene {

/// Shows a mesh. Its slots `material/<i>` (one a surface) and `blend_shapes/<name>` exist only once the mesh
/// is set: assigning them before is refused, and another mesh empties them.
class MeshInstance : public GeometryInstance {
public:
    static constexpr std::string_view kClassName = "MeshInstance";
    static void bind(ClassBuilder<MeshInstance>& c);
    MeshInstance();

    [[nodiscard]] const Ref<Mesh>& mesh() const noexcept { return mesh_.get(); }
    void set_mesh(Ref<Mesh> mesh);
    /// The slot's own material; null if it has none or does not exist.
    [[nodiscard]] Ref<Material> surface_material(int surface) const;
    /// Refused if the mesh has no such surface.
    SetResult set_surface_material(int surface, Ref<Material> material);
    /// What the surface is drawn and baked with: override, slot, the mesh's own, or null (spec section 4).
    [[nodiscard]] Ref<Material> active_material(int surface) const;

    /// Skinning is kept for saving, without effect: meshes are drawn in their rest pose.
    [[nodiscard]] const Ref<Resource>& skin() const noexcept { return skin_; }
    void set_skin(Ref<Resource> skin) { skin_ = std::move(skin); }
    [[nodiscard]] const NodePath& skeleton() const noexcept { return skeleton_; }
    void set_skeleton(NodePath path) { skeleton_ = std::move(path); }

protected:
    RID base_rid(VisualServer& server) override;
    void describe_instance(VisualServer& server, RID instance) override;
    SetResult set_dynamic(const StringName& property, const Variant& value) override;
    bool get_dynamic(const StringName& property, Variant& value) const override;
    void list_dynamic(std::vector<PropertyValue>& out) const override;

private:
    void mesh_changed();
    void describe_surface(VisualServer& server, RID instance, int surface);

    WatchedRef<Mesh> mesh_;
    Ref<Resource> skin_;
    NodePath skeleton_;
    std::vector<Ref<Material>> surface_materials_; // one a surface
    std::map<std::string, float> blend_shapes_;    // weights, without effect; sorted as they are saved
};

} // namespace cl::scene
