#include "scene/resources/primitive_meshes.h"

#include "core/object/class_registry.h"

#include <string_view>

namespace cl::scene {

namespace {

/// Binds the fields of a shape.
template <typename T, typename Shape>
class ShapeProperties {
public:
    explicit ShapeProperties(ClassBuilder<T>& builder) : builder_(builder) {}

    template <typename V>
    PropertyBuilder<T> field(std::string_view name, V Shape::*member) {
        return builder_.property(
            name, [member](const T& mesh) -> V { return mesh.shape().*member; },
            [member](T& mesh, V value) {
                Shape shape = mesh.shape();
                shape.*member = value;
                return mesh.set_shape(shape);
            });
    }

private:
    ClassBuilder<T>& builder_;
};

} // namespace

void CubeMesh::bind(ClassBuilder<CubeMesh>& c) {
    c.doc("A box around the origin.");
    ShapeProperties<CubeMesh, CubeShape> p(c);
    p.field("size", &CubeShape::size).doc("Edges [m].");
    p.field("subdivide_width", &CubeShape::subdivide_width).range("0,100,1").doc("Extra edge loops along x.");
    p.field("subdivide_height", &CubeShape::subdivide_height)
        .range("0,100,1")
        .doc("Extra edge loops along y.");
    p.field("subdivide_depth", &CubeShape::subdivide_depth).range("0,100,1").doc("Extra edge loops along z.");
}

void SphereMesh::bind(ClassBuilder<SphereMesh>& c) {
    c.doc("A sphere around the origin, or its upper half.");
    ShapeProperties<SphereMesh, SphereShape> p(c);
    p.field("radius", &SphereShape::radius).doc("Radius [m].");
    p.field("height", &SphereShape::height).doc("Full height [m]; not 2 * radius: an ellipsoid.");
    p.field("radial_segments", &SphereShape::radial_segments).range("4,100,1").doc("Segments around y.");
    p.field("rings", &SphereShape::rings).range("1,100,1").doc("Rings between the poles.");
    p.field("is_hemisphere", &SphereShape::is_hemisphere).doc("The upper half, closed below.");
}

void PlaneMesh::bind(ClassBuilder<PlaneMesh>& c) {
    c.doc("A rectangle in the xz plane that faces +y.");
    ShapeProperties<PlaneMesh, PlaneShape> p(c);
    p.field("size", &PlaneShape::size).doc("Edges along x and z [m].");
    p.field("subdivide_width", &PlaneShape::subdivide_width)
        .range("0,100,1")
        .doc("Extra edge loops along x.");
    p.field("subdivide_depth", &PlaneShape::subdivide_depth)
        .range("0,100,1")
        .doc("Extra edge loops along z.");
}

void QuadMesh::bind(ClassBuilder<QuadMesh>& c) {
    c.doc("A rectangle in the xy plane that faces +z.");
    ShapeProperties<QuadMesh, QuadShape> p(c);
    p.field("size", &QuadShape::size).doc("Edges along x and y [m].");
}

void PrismMesh::bind(ClassBuilder<PrismMesh>& c) {
    c.doc("A triangle in the xy plane, extruded along z.");
    ShapeProperties<PrismMesh, PrismShape> p(c);
    p.field("left_to_right", &PrismShape::left_to_right)
        .range("-2,2,0.1")
        .doc("Place of the upper edge along x.");
    p.field("size", &PrismShape::size).doc("Box around the prism [m].");
    p.field("subdivide_width", &PrismShape::subdivide_width)
        .range("0,100,1")
        .doc("Extra edge loops along x.");
    p.field("subdivide_height", &PrismShape::subdivide_height)
        .range("0,100,1")
        .doc("Extra edge loops along y.");
    p.field("subdivide_depth", &PrismShape::subdivide_depth)
        .range("0,100,1")
        .doc("Extra edge loops along z.");
}

void CylinderMesh::bind(ClassBuilder<CylinderMesh>& c) {
    c.doc("A cylinder or cone along y.");
    ShapeProperties<CylinderMesh, CylinderShape> p(c);
    p.field("top_radius", &CylinderShape::top_radius).doc("Radius at the top [m]; 0: a cone.");
    p.field("bottom_radius", &CylinderShape::bottom_radius).doc("Radius at the bottom [m].");
    p.field("height", &CylinderShape::height).doc("Height [m].");
    p.field("radial_segments", &CylinderShape::radial_segments).range("4,100,1").doc("Segments around y.");
    p.field("rings", &CylinderShape::rings).range("0,100,1").doc("Rings between top and bottom.");
}

void CapsuleMesh::bind(ClassBuilder<CapsuleMesh>& c) {
    c.doc("A cylinder along z with half spheres at its ends.");
    ShapeProperties<CapsuleMesh, CapsuleShape> p(c);
    p.field("radius", &CapsuleShape::radius).doc("Radius [m].");
    p.field("mid_height", &CapsuleShape::mid_height).doc("Length of the cylinder [m].");
    p.field("radial_segments", &CapsuleShape::radial_segments).range("4,100,1").doc("Segments around z.");
    p.field("rings", &CapsuleShape::rings).range("1,100,1").doc("Rings of each part.");
}

} // namespace cl::scene
