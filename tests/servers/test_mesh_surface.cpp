#include "servers/mesh_surface.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace cl;

/// The worked example of the specification, tscn section 9.1.
SurfaceArrays worked_example() {
    SurfaceArrays a;
    a.positions = {{0, 0, 0}, {1, 0.5f, 0}, {0, 1, 0.25f}};
    a.normals = {{0, 0, 1}, {0, 0.7071f, 0.7071f}, {0, 0, 1}};
    a.tangents = {{1, 0, 0, 1}, {1, 0, 0, -1}, {1, 0, 0, 1}};
    a.colors = {{1, 0, 0, 1}, {0, 0.5f, 0, 1}, {0, 0, 1, 1}};
    a.uvs = {{0, 0}, {1, 0.3333f}, {0, 1}};
    a.uv2s = {{0, 0}, {1, 0}, {0, 1}};
    a.indices = {0, 1, 2};
    return a;
}

SurfaceArrays skinned(int bone) {
    SurfaceArrays a = worked_example();
    a.bones.assign(3, glm::ivec4(0, 1, 2, bone));
    a.weights.assign(3, glm::vec4(0.5f, 0.25f, 0.25f, 0.0f));
    return a;
}

MeshSurface encoded(const SurfaceArrays& arrays, uint32_t compression = surface_format::kDefaultCompression) {
    Expected<MeshSurface> surface = encode_surface(arrays, PrimitiveType::Triangles, compression);
    REQUIRE(surface.has_value());
    return *surface;
}

std::string error_of(const Status& status) {
    return status ? "no error" : status.error().message;
}

TEST_SUITE("servers/mesh_surface") {
    TEST_CASE("the worked example packs to the specification's bytes") {
        const MeshSurface s = encoded(worked_example());
        CHECK(s.format == 97599);
        CHECK(s.vertex_count == 3);
        CHECK(s.index_count == 3);
        const std::vector<uint8_t> expected = {
            0, 0,   0,  0, 0,   0, 0, 0,   0, 0,   0, 0,   0,   0,  127, 0,  127, 0,  0, 127, 255, 0,
            0, 255, 0,  0, 0,   0, 0, 0,   0, 0,   0, 0,   128, 63, 0,   0,  0,   63, 0, 0,   0,   0,
            0, 89,  89, 0, 127, 0, 0, 129, 0, 127, 0, 255, 0,   60, 85,  53, 0,   60, 0, 0};
        REQUIRE(s.vertices.size() == 96);
        CHECK(std::vector<uint8_t>(s.vertices.begin(), s.vertices.begin() + 64) == expected);
        CHECK(s.indices == std::vector<uint8_t>{0, 0, 1, 0, 2, 0});
        CHECK(s.aabb == AABB{glm::vec3(0.0f), glm::vec3(1.0f, 1.0f, 0.25f)});
    }

    TEST_CASE("format words are those that Godot writes") {
        const uint32_t with_half_vertices = surface_format::kDefaultCompression | 512u;
        CHECK(encoded(worked_example(), with_half_vertices).format == 98111);
        SurfaceArrays plain;
        plain.positions = worked_example().positions;
        plain.normals = worked_example().normals;
        plain.uvs = worked_example().uvs;
        CHECK(encoded(plain, 0).format == 19);
        plain.indices = {0, 1, 2};
        CHECK(encoded(plain).format == 97555);
    }

    TEST_CASE("array offsets are the sums of the sizes of the arrays before them") {
        const VertexLayout l = vertex_layout(97599 | surface_format::kBones | surface_format::kWeights);
        CHECK(l.vertex == 0);
        CHECK(l.normal == 12);
        CHECK(l.tangent == 16);
        CHECK(l.color == 20);
        CHECK(l.uv == 24);
        CHECK(l.uv2 == 28);
        CHECK(l.bones == 32);
        CHECK(l.weights == 36);
        CHECK(l.stride == 44);
        CHECK(vertex_layout(0xFF).stride == 12 + 12 + 16 + 16 + 8 + 8 + 4 + 16);
        CHECK(vertex_layout(surface_format::kVertex | surface_format::k2D).stride == 8);
        CHECK(vertex_layout(surface_format::kVertex | surface_format::k2D | 512).stride == 4);
        CHECK(vertex_layout(surface_format::kBones | surface_format::k16BitBones).stride == 8);
        CHECK(vertex_layout(surface_format::kUV).vertex == -1);
    }

    TEST_CASE("what was packed without compression comes back exactly") {
        const SurfaceArrays a = skinned(255);
        const Expected<SurfaceArrays> b = decode_surface(encoded(a, 0));
        REQUIRE(b.has_value());
        CHECK(b->positions == a.positions);
        CHECK(b->normals == a.normals);
        CHECK(b->tangents == a.tangents);
        CHECK(b->colors == a.colors);
        CHECK(b->uvs == a.uvs);
        CHECK(b->uv2s == a.uv2s);
        CHECK(b->bones == a.bones);
        CHECK(b->weights == a.weights);
        CHECK(b->indices == a.indices);
    }

    TEST_CASE("packing a decoded surface again changes no byte of positions, UVs and halves") {
        const MeshSurface once = encoded(skinned(3), 97280 | 512);
        const Expected<SurfaceArrays> arrays = decode_surface(once);
        REQUIRE(arrays.has_value());
        CHECK(arrays->normals[1].y == doctest::Approx(89.0 / 127.0).epsilon(1e-6));
        CHECK(arrays->uvs[1].y == float_from_half(0x3555));
        const MeshSurface twice = encoded(*arrays, 97280 | 512);
        const VertexLayout l = vertex_layout(once.format);
        for (size_t i = 0; i < 3; ++i) {
            const size_t v = i * size_t(l.stride);
            for (int b = 0; b < 8; ++b) {
                CHECK(once.vertices[v + size_t(b)] == twice.vertices[v + size_t(b)]);
                CHECK(once.vertices[v + size_t(l.uv + b)] == twice.vertices[v + size_t(l.uv + b)]);
            }
        }
    }

    TEST_CASE("a bone above 255 makes the bones 16 bits wide") {
        CHECK((encoded(skinned(255)).format & surface_format::k16BitBones) == 0);
        const MeshSurface wide = encoded(skinned(256));
        CHECK((wide.format & surface_format::k16BitBones) != 0);
        CHECK(decode_surface(wide)->bones[0] == glm::ivec4(0, 1, 2, 256));
    }

    TEST_CASE("65536 vertices need 32-bit indices, 65535 do not") {
        SurfaceArrays a;
        a.positions.resize(65535);
        a.indices = {0, 1, 65534};
        CHECK(encoded(a).indices.size() == 6);
        a.positions.resize(65536);
        a.indices = {0, 1, 65535};
        CHECK(encoded(a).indices.size() == 12);
        CHECK(decode_surface(encoded(a))->indices == a.indices);
    }

    TEST_CASE("2D vertices decode to the plane z = 0") {
        MeshSurface s;
        s.format = surface_format::kVertex | surface_format::k2D | 512;
        s.vertex_count = 1;
        s.vertices = {0x00, 0x3C, 0x00, 0xC0}; // halves 1, -2
        const Expected<SurfaceArrays> a = decode_surface(s);
        REQUIRE(a.has_value());
        CHECK(a->positions[0] == glm::vec3(1.0f, -2.0f, 0.0f));
    }

    TEST_CASE("old 6-byte compressed vertices are widened with a fourth half of 1.0") {
        const uint32_t compression = 97280 | 512;
        const MeshSurface now = encoded(worked_example(), compression);
        const size_t stride = size_t(vertex_layout(now.format).stride);
        MeshSurface old = now;
        old.vertices.clear();
        for (size_t i = 0; i < 3; ++i) {
            const auto vertex = now.vertices.begin() + ptrdiff_t(i * stride);
            old.vertices.insert(old.vertices.end(), vertex, vertex + 6);
            old.vertices.insert(old.vertices.end(), vertex + 8, vertex + ptrdiff_t(stride));
        }
        CHECK_FALSE(validate_surface(old).ok());
        widen_old_vertices(old);
        CHECK(validate_surface(old).ok());
        CHECK(old.vertices == now.vertices);
        widen_old_vertices(old); // already wide: nothing to do
        CHECK(old.vertices == now.vertices);
        MeshSurface plain = encoded(worked_example());
        plain.vertices.erase(plain.vertices.end() - 6, plain.vertices.end());
        widen_old_vertices(plain); // plain vertices were never 6 bytes
        CHECK(plain.vertices.size() == 90);
    }

    TEST_CASE("damaged surfaces are refused with what was expected and found") {
        const MeshSurface good = encoded(worked_example());
        CHECK(error_of(validate_surface(good)) == "no error");
        MeshSurface s = good;
        s.vertices.pop_back();
        CHECK(error_of(validate_surface(s)) == "surface: expected 3 vertices of 32 bytes, found 95 bytes");
        s = good;
        s.vertex_count = 4000000000u;
        CHECK(error_of(validate_surface(s)) ==
              "surface: expected 4000000000 vertices of 32 bytes, found 96 bytes");
        s = good;
        s.vertex_count = 0;
        s.vertices.clear();
        CHECK(error_of(validate_surface(s)) == "surface: expected at least 1 vertex, found 0");
        s = good;
        s.index_count = 0x80000003u;
        CHECK(error_of(validate_surface(s)) ==
              "surface: expected 2147483651 indices of 2 bytes, found 6 bytes");
        s = good;
        s.indices[4] = 3;
        CHECK(error_of(validate_surface(s)) == "surface: expected index 2 below 3 vertices, found 3");
        s = good;
        s.format &= ~surface_format::kVertex;
        CHECK(error_of(validate_surface(s)) ==
              "surface: expected a format with vertices (bit 1), found 97598");
        s = good;
        s.format |= surface_format::kBones;
        CHECK(error_of(validate_surface(s)) ==
              "surface: expected bones and weights both or neither, found format 97663");
        CHECK(decode_surface(s).error().code == ErrorCode::ParseError);
    }

    TEST_CASE("arrays that do not fit together are refused") {
        const auto message = [](const SurfaceArrays& a) {
            return encode_surface(a, PrimitiveType::Triangles).error().message;
        };
        CHECK(message({}) == "surface: expected 1 to 4294967295 positions, found 0");
        SurfaceArrays a = worked_example();
        a.normals.pop_back();
        CHECK(message(a) == "surface: expected 3 normals, one a vertex, found 2");
        a = worked_example();
        a.indices[1] = 3;
        CHECK(message(a) == "surface: expected index 1 below 3 vertices, found 3");
        a = skinned(-1);
        CHECK(message(a) == "surface: expected bones in 0 to 65535, found -1");
        a = skinned(0);
        a.weights.clear();
        CHECK(message(a) == "surface: expected bones and weights both or neither, found one of them");
    }

    TEST_CASE("numbers outside a compressed range clamp, and NaN packs as 0") {
        SurfaceArrays a;
        a.positions = {{0, 0, 0}};
        a.normals = {{2.0f, -2.0f, std::numeric_limits<float>::quiet_NaN()}};
        a.colors = {{2.0f, -1.0f, std::numeric_limits<float>::infinity(), 1.0f}};
        const MeshSurface s = encoded(a);
        CHECK(s.vertices[12] == 127);
        CHECK(s.vertices[13] == 128); // -128
        CHECK(s.vertices[14] == 0);
        CHECK(s.vertices[16] == 255);
        CHECK(s.vertices[17] == 0);
        CHECK(s.vertices[18] == 255);
        CHECK(decode_surface(s)->normals[0].y == -1.0f); // as GL reads -128
    }

    TEST_CASE("every half survives the way to float and back, but for denormals, which Godot flushes") {
        for (uint32_t h = 0; h < 65536; ++h) {
            const float v = float_from_half(uint16_t(h));
            const uint16_t back = half_from_float_truncated(v);
            const bool denormal = (h & 0x7C00u) == 0;
            const bool nan = (h & 0x7C00u) == 0x7C00u && (h & 0x3FFu) != 0;
            if (nan) {
                CHECK(std::isnan(v));
                CHECK(std::isnan(float_from_half(back)));
            } else {
                CHECK(back == (denormal ? 0 : h));
            }
        }
    }

    TEST_CASE("a half is never larger in magnitude than the float it came from, nor 2^-10 of it smaller") {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> exponent(-13.9f, 15.9f);
        for (int i = 0; i < 10000; ++i) {
            const float v = (i % 2 ? -1.0f : 1.0f) * std::exp2(exponent(random));
            const float h = float_from_half(half_from_float_truncated(v));
            CHECK(std::abs(h) <= std::abs(v));
            CHECK(std::abs(h) > std::abs(v) * (1.0f - 1.0f / 1024.0f));
        }
        CHECK(half_from_float_truncated(65535.9f) == 0x7BFF);
        CHECK(half_from_float_truncated(65536.0f) == 0x7C00);
        CHECK(half_from_float_truncated(-1e30f) == 0xFC00);
        CHECK(half_from_float_truncated(6.1e-5f) == 0); // just below 2^-14
        CHECK(half_from_float_truncated(-5e-5f) == 0);
        CHECK(half_from_float_truncated(std::exp2(-14.0f)) == 0x0400);
    }
}

} // namespace
