#pragma once

#include "scene/resources/explains_refusal.h"
#include "scene/resources/mesh.h"

#include "core/expected.h"
#include "core/variant/variant.h"

#include <string>
#include <vector>

namespace cl::scene {

/// A mesh of stored surfaces (spec tscn section 9): what imports and the text format give.
class ArrayMesh final : public Mesh, public ExplainsRefusal {
public:
    static constexpr std::string_view kClassName = "ArrayMesh";
    static void bind(ClassBuilder<ArrayMesh>& c);

    /// Everything that a surface's dictionary says beyond its geometry; kept to be written back.
    struct SurfaceExtras {
        std::string name;
        Ref<Material> material;
        Array blend_shape_data; ///< PoolByteArray each, laid out as the surface's vertices
        Array skeleton_aabbs;   ///< one AABB a bone; size -1: unused
    };

    /// Appends a surface.
    /// @return what validate_surface() says; the mesh is then unchanged.
    Status add_surface(MeshSurface surface, SurfaceExtras extras = {});
    /// Appends a surface from plain arrays with the default compression.
    Status add_surface_from_arrays(const SurfaceArrays& arrays, PrimitiveType primitive,
                                   SurfaceExtras extras = {});
    void clear_surfaces();
    void set_surface_material(int surface, Ref<Material> material);
    [[nodiscard]] const SurfaceExtras& surface_extras(int surface) const { return extras_[surface]; }

    [[nodiscard]] std::span<const MeshSurface> surfaces() const override { return surfaces_; }
    [[nodiscard]] Ref<Material> surface_material(int surface) const override;
    [[nodiscard]] std::span<const std::string> blend_shape_names() const override {
        return blend_shape_names_;
    }

    [[nodiscard]] const std::string& refusal() const noexcept override { return refusal_; }

protected:
    SetResult set_dynamic(const StringName& property, const Variant& value) override;
    bool get_dynamic(const StringName& property, Variant& value) const override;
    void list_dynamic(std::vector<PropertyValue>& out) const override;

private:
    SetResult set_surface(std::string_view index, const Variant& value);
    SetResult set_blend_shape_names(const Variant& value);
    SetResult refuse(std::string why);

    std::vector<MeshSurface> surfaces_;
    std::vector<SurfaceExtras> extras_; ///< one a surface
    std::vector<std::string> blend_shape_names_;
    int blend_shape_mode_ = 1;
    std::string refusal_;
};

} // namespace cl::scene
