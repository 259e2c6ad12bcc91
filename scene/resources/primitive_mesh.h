#pragma once

#include "scene/resources/explains_refusal.h"
#include "scene/resources/mesh.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace cl::scene {

/// One surface made from a formula (spec scene-classes section 17), rebuilt when a parameter changes.
class PrimitiveMesh : public Mesh, public ExplainsRefusal {
public:
    static constexpr std::string_view kClassName = "PrimitiveMesh";
    static void bind(ClassBuilder<PrimitiveMesh>& c);

    [[nodiscard]] std::span<const MeshSurface> surfaces() const final;
    [[nodiscard]] Ref<Material> surface_material(int surface) const final;
    [[nodiscard]] const Ref<Material>& material() const noexcept { return material_; }
    void set_material(Ref<Material> material);
    [[nodiscard]] bool flip_faces() const noexcept { return flip_faces_; }
    /// Negates normals and turns the winding, for rooms seen from inside. No effect on unindexed shapes.
    void set_flip_faces(bool flip);
    [[nodiscard]] const std::string& refusal() const noexcept final { return refusal_; }

protected:
    /// The shape's arrays: triangles, clockwise seen from outside.
    [[nodiscard]] virtual SurfaceArrays make_arrays() const = 0;
    /// Call after a parameter of the shape changed.
    void shape_changed();
    /// Refuses a shape of that many vertices: a number in a file must not take the memory of the machine.
    [[nodiscard]] SetResult check_vertex_count(double count);
    static constexpr double kMaxVertices = 4.0e6;

private:
    mutable std::vector<MeshSurface> surfaces_; ///< empty: not built yet
    Ref<Material> material_;
    bool flip_faces_ = false;
    std::string refusal_;
};

} // namespace cl::scene
