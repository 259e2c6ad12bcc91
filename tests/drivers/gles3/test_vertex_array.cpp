#include "tests/drivers/gl_test.h"

#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/mesh_storage.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

namespace {

/// Three vertices that all carry the same values; what a pixel then shows is what the GPU read of each.
SurfaceArrays three_alike() {
    SurfaceArrays a;
    a.positions = {{-1, -1, 0.25f}, {3, -1, 0.25f}, {-1, 3, 0.25f}};
    a.normals.assign(3, {0.6f, -0.8f, 0.0f});
    a.tangents.assign(3, {0.8f, 0.6f, 0.0f, -1.0f});
    a.colors.assign(3, Color{0.2f, 0.4f, 1.0f, 0.6f});
    a.uvs.assign(3, {0.3f, -7.7f});
    a.uv2s.assign(3, {0.1f, 0.9f});
    a.bones.assign(3, {1, 2, 3, 250});
    a.weights.assign(3, {0.5f, 0.25f, 0.125f, 0.125f});
    return a;
}

/// Shows one attribute. Bones come as floats: gles3's layout never makes them integers.
constexpr gl::ShaderSource kShow{
    .name = "show",
    .vertex =
        "layout(location = 0) in vec3 a0; layout(location = 1) in vec3 a1; layout(location = 2) in vec4 a2;\n"
        "layout(location = 3) in vec4 a3; layout(location = 4) in vec2 a4; layout(location = 5) in vec2 a5;\n"
        "layout(location = 6) in vec4 a6; layout(location = 7) in vec4 a7;\n"
        "uniform int which; out vec4 v;\n"
        "void main() {\n"
        "  vec4 all[8]; all[0] = vec4(a0.z); all[1] = vec4(a1, 0.0); all[2] = a2; all[3] = a3;\n"
        "  all[4] = vec4(a4, 0.0, 0.0); all[5] = vec4(a5, 0.0, 0.0); all[6] = a6; all[7] = a7;\n"
        "  v = all[which];\n"
        "  gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID & 2) * 2.0 - 1.0, 0.0, "
        "1.0);\n"
        "}\n",
    .fragment = "in vec4 v; layout(location = 0) out vec4 c;\nvoid main() { c = v; }\n"};

/// What the GPU reads for attribute `which` of a surface.
glm::vec4 read_attribute(const StoredSurface& surface, gl::Attribute which) {
    static constexpr std::string_view kFiles[] = {"show"};
    static constexpr gl::UniformDecl kUniforms[] = {{"which", "int", 1}};
    gl::ShaderSource source = kShow;
    source.files = kFiles;
    source.uniforms = kUniforms;
    const Expected<gl::Program> program = gl::Program::create(source);
    REQUIRE(program);
    Expected<gl::Texture2D> color = gl::Texture2D::create({.size = {1, 1}, .format = gl::Format::RGBA32F});
    REQUIRE(color);
    const Expected<gl::Framebuffer> target = gl::Framebuffer::create({.colors = {{{&*color}}}});
    REQUIRE(target);
    program->set_uniform(0, static_cast<int>(which));
    {
        gl::PassDesc desc{.label = "show", .target = &*target};
        desc.colors[0] = gl::Load::Clear;
        gl::Pass pass(desc);
        pass.draw(*program, surface.vertex_array, gl::kFullscreenState, surface.range);
    }
    const std::vector<float> p = target->read_rgba32f({{0, 0}, {1, 1}});
    return {p[0], p[1], p[2], p[3]};
}

bool close(const glm::vec4& a, const glm::vec4& b) {
    bool ok = true;
    for (int i = 0; i < 4; ++i) {
        ok = ok && std::abs(a[i] - b[i]) <= 1e-5f * std::max(1.0f, std::abs(b[i]));
    }
    return ok;
}

} // namespace

TEST_SUITE("drivers/gles3/gl/vertex_array") {
    TEST_CASE("attributes lie where the surface's format puts them, at fixed locations") {
        // vertex + normal + uv + index, default compression (spec tscn section 9.1): 12 + 4 + 4 bytes.
        const gl::AttributeList list = gl::attributes_of_surface(97555);
        CHECK(list.stride == 20);
        REQUIRE(list.count == 3);
        CHECK(list.items[0].attribute == gl::Attribute::Position);
        CHECK(list.items[0].type == GL_FLOAT);
        CHECK(list.items[1].attribute == gl::Attribute::Normal);
        CHECK(list.items[1].offset == 12);
        CHECK(list.items[1].type == GL_BYTE);
        CHECK(list.items[1].normalized);
        CHECK(list.items[2].attribute == gl::Attribute::UV);
        CHECK(list.items[2].offset == 16);
        CHECK(list.items[2].type == GL_HALF_FLOAT);
    }

    TEST_CASE("[gl] the GPU reads of every attribute what decode_surface() reads, however it is compressed") {
        on_each_gl([](GLTest&) {
            const uint32_t all = 0xFFu << surface_format::kCompressShift;
            for (const uint32_t compression : {0u, surface_format::kDefaultCompression, all}) {
                CAPTURE(compression);
                const Expected<MeshSurface> encoded =
                    encode_surface(three_alike(), PrimitiveType::Triangles, compression);
                REQUIRE(encoded);
                const Expected<SurfaceArrays> decoded = decode_surface(*encoded);
                REQUIRE(decoded);
                MeshStorage meshes;
                const Expected<RID> mesh = meshes.create(std::span(&*encoded, 1));
                REQUIRE(mesh);
                const StoredSurface& s = *meshes.surface(*mesh, 0);
                const Color c = decoded->colors[0];
                CHECK(close(read_attribute(s, gl::Attribute::Position), glm::vec4(decoded->positions[0].z)));
                CHECK(close(read_attribute(s, gl::Attribute::Normal), glm::vec4(decoded->normals[0], 0)));
                CHECK(close(read_attribute(s, gl::Attribute::Tangent), decoded->tangents[0]));
                CHECK(close(read_attribute(s, gl::Attribute::Color), {c.r, c.g, c.b, c.a}));
                CHECK(close(read_attribute(s, gl::Attribute::UV), glm::vec4(decoded->uvs[0], 0, 0)));
                CHECK(close(read_attribute(s, gl::Attribute::UV2), glm::vec4(decoded->uv2s[0], 0, 0)));
                CHECK(close(read_attribute(s, gl::Attribute::Bones), glm::vec4(decoded->bones[0])));
                CHECK(close(read_attribute(s, gl::Attribute::Weights), decoded->weights[0]));
            }
        });
    }

    TEST_CASE("[gl] a mesh without colours is white, without normals has none") {
        on_each_gl([](GLTest&) {
            SurfaceArrays bare;
            bare.positions = three_alike().positions;
            const Expected<MeshSurface> encoded = encode_surface(bare, PrimitiveType::Triangles);
            REQUIRE(encoded);
            MeshStorage meshes;
            const Expected<RID> mesh = meshes.create(std::span(&*encoded, 1));
            REQUIRE(mesh);
            const StoredSurface& s = *meshes.surface(*mesh, 0);
            CHECK(read_attribute(s, gl::Attribute::Color) == glm::vec4(1.0f));
            CHECK(read_attribute(s, gl::Attribute::Normal) == glm::vec4(0.0f));
        });
    }
}

TEST_SUITE("drivers/gles3/mesh_storage") {
    TEST_CASE("[gl] a mesh keeps its surfaces in order, with their counts and index types") {
        on_each_gl([](GLTest&) {
            SurfaceArrays quad;
            quad.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
            const Expected<MeshSurface> strip = encode_surface(quad, PrimitiveType::TriangleStrip);
            quad.indices = {0, 1, 2, 2, 1, 3};
            const Expected<MeshSurface> indexed = encode_surface(quad, PrimitiveType::Triangles);
            SurfaceArrays many;
            many.positions.assign(65536, glm::vec3(0.0f));
            many.indices = {0, 1, 65535};
            const Expected<MeshSurface> wide = encode_surface(many, PrimitiveType::Triangles);
            REQUIRE(strip);
            REQUIRE(indexed);
            REQUIRE(wide);
            const std::array surfaces{*strip, *indexed, *wide};
            MeshStorage meshes;
            const Expected<RID> mesh = meshes.create(surfaces);
            REQUIRE(mesh);
            const StoredSurface* a = meshes.surface(*mesh, 0);
            const StoredSurface* b = meshes.surface(*mesh, 1);
            const StoredSurface* c = meshes.surface(*mesh, 2);
            CHECK(a->triangles == 2);
            CHECK(a->range.count == 4);
            CHECK(a->vertex_array.index_type() == gl::IndexType::None);
            CHECK(b->triangles == 2);
            CHECK(b->range.count == 6);
            CHECK(b->vertex_array.index_type() == gl::IndexType::U16);
            CHECK(c->triangles == 1);
            CHECK(c->vertex_array.index_type() == gl::IndexType::U32);
            CHECK(meshes.surface(*mesh, 3) == nullptr);
            CHECK(meshes.surface(*mesh, -1) == nullptr);
            CHECK(meshes.free(*mesh));
            CHECK_FALSE(meshes.free(*mesh));
            CHECK(meshes.surface(*mesh, 0) == nullptr);
        });
    }

    TEST_CASE("[gl] a surface that lies about its sizes is refused and leaves nothing behind") {
        on_each_gl([](GLTest& gl_test) {
            const Expected<MeshSurface> right = encode_surface(three_alike(), PrimitiveType::Triangles);
            REQUIRE(right);
            MeshSurface wrong = *right;
            wrong.vertex_count = 1000000000;
            const std::array surfaces{*right, wrong};
            MeshStorage meshes;
            const Expected<RID> mesh = meshes.create(surfaces);
            REQUIRE_FALSE(mesh);
            CHECK(mesh.error().to_string() == validate_surface(wrong).error().to_string());
            CHECK(gl_test.state().live(gl::ObjectKind::Buffer) == 0);
        });
    }
}
