#pragma once

#include "servers/mesh_surface.h"
#include "servers/rasterizer.h"
#include "servers/visual/first_error.h"
#include "servers/visual/version_clock.h"

#include "core/rid.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cl {

/// A mesh behind its RID.
struct Mesh {
    struct Surface {
        AABB bounds;  ///< mesh space [m]
        RID material; ///< null: none of its own
    };
    std::vector<Surface> surfaces;
    AABB bounds; ///< of all surfaces
    /// Kept after the upload: light transport reads it on other threads.
    std::shared_ptr<const std::vector<MeshSurface>> vertices;
    bool tried = false;   ///< uploaded, or refused once and for all
    RID upload;           ///< the rasteriser's mesh
    uint64_t version = 0; ///< of its surface materials
};

/// Meshes: in the rasteriser from when they are first drawn.
class MeshStorage {
public:
    MeshStorage(Rasterizer& rasterizer, VersionClock& clock);

    /// The surfaces must have passed validate_surface().
    RID make(std::vector<MeshSurface> surfaces);
    bool free(RID mesh);
    /// Null if not a live mesh.
    [[nodiscard]] const Mesh* get(RID mesh) const noexcept { return meshes_.get(mesh); }
    [[nodiscard]] size_t size() const noexcept { return meshes_.size(); }
    /// @param surface  in [0, surface count) of a live mesh
    void set_material(RID mesh, int surface, RID material);
    /// The rasteriser's mesh, uploaded now if need be; null if `mesh` is not one or cannot be uploaded.
    RID uploaded(RID mesh, FirstError& errors);

private:
    Rasterizer& rasterizer_;
    VersionClock& clock_;
    RID_Owner<Mesh> meshes_;
};

} // namespace cl
