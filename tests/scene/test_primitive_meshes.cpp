#include "tests/scene/scene_fixture.h"

#include "scene/resources/primitive_meshes.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <tuple>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

struct Shape {
    const char* name;
    SurfaceArrays arrays;
};

std::vector<Shape> solids() {
    return {
        {"cube", make_shape(CubeShape{})},
        {"subdivided cube",
         make_shape(CubeShape{
             .size = {1, 2, 3}, .subdivide_width = 2, .subdivide_height = 1, .subdivide_depth = 4})},
        {"sphere", make_shape(SphereShape{.radial_segments = 16, .rings = 7})},
        {"hemisphere",
         make_shape(SphereShape{.height = 1.0f, .radial_segments = 16, .rings = 7, .is_hemisphere = true})},
        {"prism", make_shape(PrismShape{})},
        {"leaning prism", make_shape(PrismShape{.left_to_right = 0.2f,
                                                .size = {1, 2, 3},
                                                .subdivide_width = 1,
                                                .subdivide_height = 3,
                                                .subdivide_depth = 1})},
        {"cylinder", make_shape(CylinderShape{.radial_segments = 12})},
        {"cone", make_shape(CylinderShape{.top_radius = 0.0f, .radial_segments = 12, .rings = 1})},
        {"capsule", make_shape(CapsuleShape{.radius = 0.5f, .radial_segments = 12, .rings = 3})},
    };
}

std::vector<Shape> all_shapes() {
    std::vector<Shape> shapes = solids();
    shapes.push_back({"plane", make_shape(PlaneShape{.subdivide_width = 3, .subdivide_depth = 1})});
    shapes.push_back({"quad", make_shape(QuadShape{})});
    return shapes;
}

std::array<glm::vec3, 3> triangle(const SurfaceArrays& a, size_t first) {
    std::array<glm::vec3, 3> p;
    for (size_t k = 0; k < 3; ++k) {
        p[k] = a.positions[a.indices.empty() ? first + k : a.indices[first + k]];
    }
    return p;
}

size_t corner_count(const SurfaceArrays& a) {
    return a.indices.empty() ? a.positions.size() : a.indices.size();
}

/// Points out of the solid for faces that are clockwise seen from outside.
glm::vec3 clockwise_normal(const std::array<glm::vec3, 3>& p) {
    return glm::cross(p[2] - p[0], p[1] - p[0]);
}

double volume(const SurfaceArrays& a) {
    double sum = 0.0;
    for (size_t i = 0; i + 2 < corner_count(a); i += 3) {
        const auto p = triangle(a, i);
        sum += glm::dot(glm::dvec3(p[0]), glm::cross(glm::dvec3(p[2]), glm::dvec3(p[1]))) / 6.0;
    }
    return sum;
}

using Key = std::tuple<int, int, int>;
Key key_of(const glm::vec3& p) {
    const auto grid = [](float v) { return static_cast<int>(std::lround(v * 10000.0f)); };
    return {grid(p.x), grid(p.y), grid(p.z)};
}

} // namespace

TEST_SUITE("scene/resources/primitive_meshes") {
    TEST_CASE("a solid is closed: every edge is walked once each way") {
        for (const Shape& shape : solids()) {
            CAPTURE(shape.name);
            std::map<std::pair<Key, Key>, int> balance;
            for (size_t i = 0; i + 2 < corner_count(shape.arrays); i += 3) {
                const auto p = triangle(shape.arrays, i);
                const Key k[3] = {key_of(p[0]), key_of(p[1]), key_of(p[2])};
                if (k[0] == k[1] || k[1] == k[2] || k[2] == k[0]) {
                    continue; // shrunk to a line at a pole
                }
                for (int e = 0; e < 3; ++e) {
                    const Key from = k[e], to = k[(e + 1) % 3];
                    balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
                }
            }
            for (const auto& [edge, sum] : balance) {
                CHECK(sum == 0);
            }
        }
    }

    TEST_CASE("faces are clockwise seen from outside, so that volumes are positive and near their formula") {
        const double pi = std::acos(-1.0);
        CHECK(volume(make_shape(CubeShape{.size = {1, 2, 3}})) == doctest::Approx(6.0));
        CHECK(volume(make_shape(PrismShape{.size = {1, 2, 3}})) == doctest::Approx(3.0));
        CHECK(volume(make_shape(SphereShape{})) == doctest::Approx(4.0 / 3.0 * pi).epsilon(0.01));
        CHECK(volume(make_shape(SphereShape{.height = 1.0f, .is_hemisphere = true})) ==
              doctest::Approx(2.0 / 3.0 * pi).epsilon(0.01));
        CHECK(volume(make_shape(CylinderShape{})) == doctest::Approx(2.0 * pi).epsilon(0.01));
        CHECK(volume(make_shape(CylinderShape{.top_radius = 0.0f})) ==
              doctest::Approx(2.0 / 3.0 * pi).epsilon(0.01));
        CHECK(volume(make_shape(CapsuleShape{})) == doctest::Approx(4.0 / 3.0 * pi + pi).epsilon(0.01));
    }

    TEST_CASE("normals have unit length and look the way their face does") {
        for (const Shape& shape : all_shapes()) {
            CAPTURE(shape.name);
            const SurfaceArrays& a = shape.arrays;
            for (const glm::vec3& n : a.normals) {
                CHECK(glm::length(n) == doctest::Approx(1.0f).epsilon(1e-5));
            }
            for (size_t i = 0; i + 2 < corner_count(a); i += 3) {
                const glm::vec3 face = clockwise_normal(triangle(a, i));
                const bool is_line = glm::length(face) < 1e-6f;
                if (is_line || shape.name == std::string("hemisphere")) {
                    continue; // the ring between dome and floor of a hemisphere has the normals of both
                }
                for (size_t k = 0; k < 3; ++k) {
                    CHECK(glm::dot(face, a.normals[a.indices.empty() ? i + k : a.indices[i + k]]) > 0.0f);
                }
            }
        }
    }

    TEST_CASE("tangents have unit length, are at right angles to the normal and carry a sign") {
        for (const Shape& shape : all_shapes()) {
            CAPTURE(shape.name);
            REQUIRE(shape.arrays.tangents.size() == shape.arrays.normals.size());
            for (size_t i = 0; i < shape.arrays.tangents.size(); ++i) {
                const glm::vec4& t = shape.arrays.tangents[i];
                CHECK(glm::length(glm::vec3(t)) == doctest::Approx(1.0f).epsilon(1e-5));
                CHECK(std::abs(t.w) == 1.0f);
                CHECK(std::abs(glm::dot(glm::vec3(t), shape.arrays.normals[i])) < 1e-5f);
            }
        }
    }

    TEST_CASE("UVs stay within the unit square and the three classes of atlas use all of it") {
        for (const Shape& shape : all_shapes()) {
            CAPTURE(shape.name);
            glm::vec2 least(1.0f), most(0.0f);
            for (const glm::vec2& uv : shape.arrays.uvs) {
                least = glm::min(least, uv);
                most = glm::max(most, uv);
            }
            CHECK(least.x == doctest::Approx(0.0f));
            CHECK(least.y == doctest::Approx(0.0f));
            CHECK(most.x == doctest::Approx(1.0f));
            CHECK(most.y == doctest::Approx(1.0f));
        }
    }

    TEST_CASE("vertex and index counts follow the formulas") {
        const auto check = [](const SurfaceArrays& a, size_t vertices, size_t indices) {
            CHECK(a.positions.size() == vertices);
            CHECK(a.indices.size() == indices);
        };
        check(make_shape(CubeShape{}), 24, 36);
        check(make_shape(CubeShape{.subdivide_width = 1}), 2 * (3 * 2 + 2 * 2 + 3 * 2), 12 * 2 + 12 + 12 * 2);
        check(make_shape(SphereShape{}), 65 * 34, 64 * 33 * 6);
        check(make_shape(PlaneShape{}), 4, 6);
        check(make_shape(QuadShape{}), 6, 0);
        check(make_shape(PrismShape{}), 2 * 4 + 2 * 4 + 4, 2 * 3 + 2 * 6 + 6);
        check(make_shape(CylinderShape{}), 65 * 6 + 2 * 66, 64 * 5 * 6 + 2 * 64 * 3);
        check(make_shape(CapsuleShape{}), 3 * 65 * 10, 3 * 64 * 9 * 6);
        for (const Shape& shape : all_shapes()) {
            CAPTURE(shape.name);
            CHECK(corner_count(shape.arrays) % 3 == 0);
        }
    }

    TEST_CASE("the front face of a cube starts at its upper left corner and goes right") {
        const SurfaceArrays a = make_shape(CubeShape{.size = {2, 4, 6}});
        CHECK(a.positions[0] == glm::vec3(-1, 2, 3));
        CHECK(a.positions[2] == glm::vec3(1, 2, 3));
        CHECK(a.uvs[0] == glm::vec2(0, 0));
        CHECK(a.indices[0] == 0);
        CHECK(a.indices[1] == 2);
        CHECK(a.indices[2] == 4);
    }

    TEST_CASE("the vertices counted in advance are at least those that are made") {
        CHECK(vertex_count(CubeShape{.subdivide_depth = 3}) ==
              make_shape(CubeShape{.subdivide_depth = 3}).positions.size());
        CHECK(vertex_count(PrismShape{}) == make_shape(PrismShape{}).positions.size());
        CHECK(vertex_count(SphereShape{}) == make_shape(SphereShape{}).positions.size());
        CHECK(vertex_count(PlaneShape{}) == make_shape(PlaneShape{}).positions.size());
        CHECK(vertex_count(QuadShape{}) == make_shape(QuadShape{}).positions.size());
        CHECK(vertex_count(CylinderShape{}) == make_shape(CylinderShape{}).positions.size());
        CHECK(vertex_count(CapsuleShape{}) == make_shape(CapsuleShape{}).positions.size());
    }

    TEST_CASE("a shape of a billion vertices is refused before anything is made") {
        register_types();
        const Ref<Reference> cube = ClassRegistry::instance().create_ref("CubeMesh");
        REQUIRE(cube);
        CHECK(cube->set("subdivide_width", 2000000000) == SetResult::Refused);
        CHECK(cube->get("subdivide_width") == Variant(0));
        CHECK(dynamic_cast<const ExplainsRefusal&>(*cube).refusal() ==
              "expected a shape of at most 4000000 vertices, found 16000000024");
    }

    TEST_CASE("counts below their least are taken to it") {
        const SphereMesh sphere(SphereShape{.radial_segments = -5, .rings = 0});
        CHECK(sphere.shape().radial_segments == 4);
        CHECK(sphere.shape().rings == 1);
        CHECK(sphere.surface_count() == 1);
    }

    TEST_CASE("flip_faces turns an indexed shape inside out and leaves a quad as it is") {
        CubeMesh cube;
        cube.set_flip_faces(true);
        const Expected<SurfaceArrays> inside = decode_surface(cube.surfaces()[0]);
        REQUIRE(inside.has_value());
        CHECK(volume(*inside) == doctest::Approx(-8.0));
        CHECK(inside->normals[0] == glm::vec3(0, 0, -1));

        QuadMesh quad, flipped;
        flipped.set_flip_faces(true);
        CHECK(flipped.surfaces()[0].vertices == quad.surfaces()[0].vertices);
    }

    TEST_CASE("a change of a parameter rebuilds the surface and tells the users") {
        CubeMesh cube;
        CHECK(cube.aabb().size.x == doctest::Approx(2.0f));
        int told = 0;
        cube.on_changed([&told] { ++told; });
        REQUIRE(cube.set_shape(CubeShape{.size = glm::vec3(4.0f)}) == SetResult::Done);
        CHECK(told == 1);
        CHECK(cube.aabb().size.x == doctest::Approx(4.0f));
    }

    TEST_CASE("primitive surfaces have the format word that Godot gives them") {
        CHECK(CubeMesh().surfaces()[0].format == 97559); // vertex, normal, tangent, UV, index
        CHECK(QuadMesh().surfaces()[0].format == 97303); // without index
    }
}
