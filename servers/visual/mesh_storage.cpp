#include "servers/visual/mesh_storage.h"

#include "servers/visual/rid_kinds.h"

#include <utility>

namespace cl {

MeshStorage::MeshStorage(Rasterizer& rasterizer, VersionClock& clock)
    : rasterizer_(rasterizer), clock_(clock), meshes_(static_cast<uint32_t>(RIDKind::Mesh)) {}

RID MeshStorage::make(std::vector<MeshSurface> surfaces) {
    Mesh mesh;
    for (const MeshSurface& surface : surfaces) {
        mesh.bounds = mesh.surfaces.empty() ? surface.aabb : mesh.bounds.merged(surface.aabb);
        mesh.surfaces.push_back({surface.aabb, {}});
    }
    mesh.vertices = std::make_shared<const std::vector<MeshSurface>>(std::move(surfaces));
    mesh.version = clock_.tick();
    return meshes_.make(std::move(mesh));
}

bool MeshStorage::free(RID rid) {
    const Mesh* mesh = meshes_.get(rid);
    if (mesh && mesh->upload) {
        static_cast<void>(rasterizer_.free(mesh->upload)); // a backend that lost it has nothing left to free
    }
    return meshes_.free(rid);
}

void MeshStorage::set_material(RID rid, int surface, RID material) {
    Mesh* mesh = meshes_.get(rid);
    CL_ASSERT(mesh && surface >= 0 && static_cast<size_t>(surface) < mesh->surfaces.size(),
              "set_material() of a surface that is not there");
    mesh->surfaces[static_cast<size_t>(surface)].material = material;
    mesh->version = clock_.tick();
}

RID MeshStorage::uploaded(RID rid, FirstError& errors) {
    Mesh* mesh = meshes_.get(rid);
    if (!mesh || mesh->tried || mesh->vertices->empty()) {
        return mesh ? mesh->upload : RID{};
    }
    mesh->tried = true;
    Expected<RID> created = rasterizer_.mesh_create(*mesh->vertices);
    if (!created) {
        errors.note(created.error());
        return {};
    }
    return mesh->upload = *created;
}

} // namespace cl
