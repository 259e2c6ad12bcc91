#pragma once

#include "scene/resources/primitive_mesh.h"
#include "scene/resources/primitive_shapes.h"

#include <string_view>

namespace cl::scene {

/// A primitive mesh whose parameters are a Shape struct. Each class below binds the struct's fields as
/// properties.
template <typename Shape>
class ShapeMesh : public PrimitiveMesh {
public:
    ShapeMesh() = default;
    explicit ShapeMesh(const Shape& shape) { static_cast<void>(set_shape(shape)); }
    [[nodiscard]] const Shape& shape() const noexcept { return shape_; }
    /// Counts below their least are taken to it; Refused beyond kMaxVertices.
    SetResult set_shape(const Shape& shape) {
        const Shape wanted = sanitized(shape);
        const SetResult result = check_vertex_count(vertex_count(wanted));
        if (result == SetResult::Done) {
            shape_ = wanted;
            shape_changed();
        }
        return result;
    }

protected:
    [[nodiscard]] SurfaceArrays make_arrays() const final { return make_shape(shape_); }

private:
    Shape shape_;
};

class CubeMesh final : public ShapeMesh<CubeShape> {
public:
    using ShapeMesh::ShapeMesh;
    static constexpr std::string_view kClassName = "CubeMesh";
    static void bind(ClassBuilder<CubeMesh>& c);
};
class SphereMesh final : public ShapeMesh<SphereShape> {
public:
    using ShapeMesh::ShapeMesh;
    static constexpr std::string_view kClassName = "SphereMesh";
    static void bind(ClassBuilder<SphereMesh>& c);
};
class PlaneMesh final : public ShapeMesh<PlaneShape> {
public:
    using ShapeMesh::ShapeMesh;
    static constexpr std::string_view kClassName = "PlaneMesh";
    static void bind(ClassBuilder<PlaneMesh>& c);
};
class QuadMesh final : public ShapeMesh<QuadShape> {
public:
    using ShapeMesh::ShapeMesh;
    static constexpr std::string_view kClassName = "QuadMesh";
    static void bind(ClassBuilder<QuadMesh>& c);
};
class PrismMesh final : public ShapeMesh<PrismShape> {
public:
    using ShapeMesh::ShapeMesh;
    static constexpr std::string_view kClassName = "PrismMesh";
    static void bind(ClassBuilder<PrismMesh>& c);
};
class CylinderMesh final : public ShapeMesh<CylinderShape> {
public:
    using ShapeMesh::ShapeMesh;
    static constexpr std::string_view kClassName = "CylinderMesh";
    static void bind(ClassBuilder<CylinderMesh>& c);
};
class CapsuleMesh final : public ShapeMesh<CapsuleShape> {
public:
    using ShapeMesh::ShapeMesh;
    static constexpr std::string_view kClassName = "CapsuleMesh";
    static void bind(ClassBuilder<CapsuleMesh>& c);
};

} // namespace cl::scene
