#include "scene/resources/mesh.h"

#include "servers/visual_server.h"

#include "core/io/log.h"
#include "core/object/class_registry.h"

namespace cl::scene {

void Mesh::bind(ClassBuilder<Mesh>& c) {
    c.doc("Geometry in surfaces, each with a material of its own.");
    c.property("lightmap_size_hint", &Mesh::lightmap_size_hint, &Mesh::set_lightmap_size_hint)
        .doc("Lightmap size [texels]; stored only.");
}

AABB Mesh::aabb() const {
    const std::span<const MeshSurface> all = surfaces();
    if (all.empty()) {
        return {};
    }
    AABB box = all.front().aabb;
    for (const MeshSurface& surface : all.subspan(1)) {
        box = box.merged(surface.aabb);
    }
    return box;
}

void Mesh::set_custom_aabb(const AABB& box_m) {
    custom_aabb_m_ = box_m;
    emit_changed();
}

void Mesh::set_lightmap_size_hint(glm::vec2 texels) {
    lightmap_size_hint_ = texels;
}

RID Mesh::rid(VisualServer& server) const {
    if (const RID made = rid_.in(server)) {
        return made;
    }
    const std::span<const MeshSurface> all = surfaces();
    if (all.empty()) {
        return {};
    }
    const Expected<RID> made = server.mesh_create(std::vector<MeshSurface>(all.begin(), all.end()));
    if (!made) {
        log_error(made.error().to_string());
        return {};
    }
    rid_.adopt(server, *made);
    for (int i = 0; i < surface_count(); ++i) {
        if (const Ref<Material> material = surface_material(i)) {
            static_cast<void>(server.mesh_surface_set_material(*made, i, material->rid(server)));
        }
    }
    return *made;
}

void Mesh::surfaces_changed() {
    rid_.reset();
    emit_changed();
}

void Mesh::surface_material_changed(int surface) {
    if (VisualServer* server = rid_.server()) {
        const Ref<Material> material = surface_material(surface);
        static_cast<void>(server->mesh_surface_set_material(rid_.get(), surface,
                                                            material ? material->rid(*server) : RID{}));
    }
    emit_changed();
}

} // namespace cl::scene
