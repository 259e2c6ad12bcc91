#include "drivers/gles3/mesh_storage.h"

#include <utility>

namespace cl::gles3 {

namespace {

int64_t triangle_count(PrimitiveType primitive, int64_t count) {
    switch (primitive) {
    case PrimitiveType::Triangles:
        return count / 3;
    case PrimitiveType::TriangleStrip:
    case PrimitiveType::TriangleFan:
        return count > 2 ? count - 2 : 0;
    default:
        return 0;
    }
}

Expected<StoredSurface> upload(const MeshSurface& surface) {
    if (Status s = validate_surface(surface); !s) {
        return s.error();
    }
    Expected<gl::Buffer> vertices =
        gl::Buffer::create({.kind = gl::BufferKind::Vertex, .label = "mesh vertices"},
                           std::as_bytes(std::span(surface.vertices)));
    if (!vertices) {
        return vertices.error();
    }
    std::optional<gl::Buffer> indices;
    if (surface.index_count > 0) {
        Expected<gl::Buffer> made =
            gl::Buffer::create({.kind = gl::BufferKind::Index, .label = "mesh indices"},
                               std::as_bytes(std::span(surface.indices)));
        if (!made) {
            return made.error();
        }
        indices.emplace(*std::move(made));
    }
    const gl::AttributeList attributes = gl::attributes_of_surface(surface.format);
    gl::VertexArray array = gl::VertexArray::create({
        .vertices = &*vertices,
        .attributes = attributes.span(),
        .stride = attributes.stride,
        .indices = indices ? &*indices : nullptr,
        .index_type = surface.vertex_count < 65536 ? gl::IndexType::U16 : gl::IndexType::U32,
        .label = "mesh",
    });
    const auto count = static_cast<int>(indices ? surface.index_count : surface.vertex_count);
    return StoredSurface{*std::move(vertices), std::move(indices),
                         std::move(array),     gl::DrawRange{surface.primitive, 0, count, 1},
                         surface.format,       triangle_count(surface.primitive, count)};
}

} // namespace

Expected<RID> MeshStorage::create(std::span<const MeshSurface> surfaces) {
    StoredMesh mesh;
    mesh.surfaces.reserve(surfaces.size());
    for (const MeshSurface& surface : surfaces) {
        Expected<StoredSurface> stored = upload(surface);
        if (!stored) {
            return stored.error();
        }
        mesh.surfaces.push_back(*std::move(stored));
    }
    return meshes_.make(std::move(mesh));
}

const StoredSurface* MeshStorage::surface(RID rid, int index) const noexcept {
    const StoredMesh* mesh = get(rid);
    if (!mesh || index < 0 || static_cast<size_t>(index) >= mesh->surfaces.size()) {
        return nullptr;
    }
    return &mesh->surfaces[static_cast<size_t>(index)];
}

} // namespace cl::gles3
