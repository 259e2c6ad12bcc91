#pragma once

#include "drivers/gles3/gl/buffer.h"
#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/gl/vertex_array.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/mesh_surface.h"

#include "core/expected.h"
#include "core/rid.h"

#include <optional>
#include <span>
#include <vector>

namespace cl::gles3 {

/// One surface on the GPU, in the byte layout it has in its file.
struct StoredSurface {
    gl::Buffer vertices;
    std::optional<gl::Buffer> indices; ///< empty: not indexed
    gl::VertexArray vertex_array;
    gl::DrawRange range;   ///< the whole surface
    uint32_t format = 0;   ///< surface_format bits: which attributes there are
    int64_t triangles = 0; ///< for statistics; 0 of points and lines
};

struct StoredMesh {
    std::vector<StoredSurface> surfaces;
};

class MeshStorage {
public:
    /// @return what validate_surface() says of the first bad surface, or OutOfMemory.
    [[nodiscard]] Expected<RID> create(std::span<const MeshSurface> surfaces);
    [[nodiscard]] const StoredMesh* get(RID rid) const noexcept { return meshes_.get(rid); }
    /// nullptr if the mesh is stale or has no such surface.
    [[nodiscard]] const StoredSurface* surface(RID rid, int index) const noexcept;
    bool free(RID rid) { return meshes_.free(rid); }

private:
    RID_Owner<StoredMesh> meshes_{static_cast<uint32_t>(RIDKind::Mesh)};
};

} // namespace cl::gles3
