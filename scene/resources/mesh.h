#pragma once

#include "scene/resources/material.h"
#include "scene/resources/server_rid.h"

#include "servers/mesh_surface.h"

#include "core/math/aabb.h"
#include "core/object/resource.h"

#include <glm/vec2.hpp>

#include <span>
#include <string>
#include <vector>

namespace cl::scene {

/// Geometry in surfaces, each with a material of its own. Shared by MeshInstances.
class Mesh : public Resource {
public:
    static constexpr std::string_view kClassName = "Mesh";
    static void bind(ClassBuilder<Mesh>& c);

    /// The surfaces as the GPU and the GI bake read them. A borrow until the mesh changes.
    [[nodiscard]] virtual std::span<const MeshSurface> surfaces() const = 0;
    [[nodiscard]] int surface_count() const { return static_cast<int>(surfaces().size()); }
    /// Null if the surface has none or does not exist.
    [[nodiscard]] virtual Ref<Material> surface_material(int surface) const = 0;
    /// Names of the blend shapes, in order. Empty for meshes without.
    [[nodiscard]] virtual std::span<const std::string> blend_shape_names() const { return {}; }

    /// Box around all surfaces [m]; zero for an empty mesh. Not the custom box.
    [[nodiscard]] AABB aabb() const;
    /// Box for culling that the user set; zero size: none.
    [[nodiscard]] const AABB& custom_aabb() const noexcept { return custom_aabb_m_; }
    void set_custom_aabb(const AABB& box_m);
    [[nodiscard]] glm::vec2 lightmap_size_hint() const noexcept { return lightmap_size_hint_; }
    void set_lightmap_size_hint(glm::vec2 texels);

    /// The mesh in `server` with its surface materials, made on the first call; null RID if it has no
    /// surfaces. Geometry that changes makes a new RID: users ask again when on_changed() calls them.
    [[nodiscard]] RID rid(VisualServer& server) const;

protected:
    /// Drops the server's copy and tells the users. Call after surfaces() changed.
    void surfaces_changed();
    /// Passes a surface's material on to the server's copy and tells the users.
    void surface_material_changed(int surface);

private:
    AABB custom_aabb_m_;
    glm::vec2 lightmap_size_hint_{0.0f};
    mutable ServerRID rid_;
};

} // namespace cl::scene
