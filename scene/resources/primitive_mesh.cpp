#include "scene/resources/primitive_mesh.h"

#include "core/io/log.h"
#include "core/object/class_registry.h"

#include <fmt/format.h>

#include <utility>

namespace cl::scene {

namespace {

void flip(SurfaceArrays& arrays) {
    for (glm::vec3& normal : arrays.normals) {
        normal = -normal;
    }
    for (size_t i = 0; i + 2 < arrays.indices.size(); i += 3) {
        std::swap(arrays.indices[i], arrays.indices[i + 1]);
    }
}

} // namespace

void PrimitiveMesh::bind(ClassBuilder<PrimitiveMesh>& c) {
    c.doc("A mesh of one surface made from a formula.");
    c.property("material", &PrimitiveMesh::material, &PrimitiveMesh::set_material)
        .doc("Material of the surface.");
    c.property("custom_aabb", &PrimitiveMesh::custom_aabb, &PrimitiveMesh::set_custom_aabb)
        .doc("Box for culling [m] in place of the mesh's own; zero size: none.");
    c.property("flip_faces", &PrimitiveMesh::flip_faces, &PrimitiveMesh::set_flip_faces)
        .doc("Turns the faces of an indexed shape inside out.");
}

std::span<const MeshSurface> PrimitiveMesh::surfaces() const {
    if (!surfaces_.empty()) {
        return surfaces_;
    }
    SurfaceArrays arrays = make_arrays();
    // An unindexed shape (QuadMesh) does not flip, not even its normals: spec scene-classes section 17.
    if (flip_faces_ && !arrays.indices.empty()) {
        flip(arrays);
    }
    Expected<MeshSurface> surface = encode_surface(arrays, PrimitiveType::Triangles);
    if (!surface) {
        log_error(surface.error().to_string());
        return {};
    }
    surfaces_.push_back(std::move(*surface));
    return surfaces_;
}

Ref<Material> PrimitiveMesh::surface_material(int surface) const {
    return surface == 0 ? material_ : nullptr;
}

void PrimitiveMesh::set_material(Ref<Material> material) {
    material_ = std::move(material);
    surface_material_changed(0);
}

void PrimitiveMesh::set_flip_faces(bool flip) {
    flip_faces_ = flip;
    shape_changed();
}

SetResult PrimitiveMesh::check_vertex_count(double count) {
    refusal_.clear();
    if (count <= kMaxVertices) {
        return SetResult::Done;
    }
    refusal_ = fmt::format("expected a shape of at most {:.0f} vertices, found {:.0f}", kMaxVertices, count);
    return SetResult::Refused;
}

void PrimitiveMesh::shape_changed() {
    surfaces_.clear();
    surfaces_changed();
}

} // namespace cl::scene
