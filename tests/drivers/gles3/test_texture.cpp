#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"

#include "drivers/gles3/gl/texture.h"

#include "core/math/color.h"

#include <doctest/doctest.h>
#include <glm/gtc/packing.hpp>

#include <array>
#include <cstring>
#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;
using tests::probe_fragments;
using tests::worst_difference;

namespace {

constexpr gl::SamplerDesc kNearest{.filter = gl::Filter::Nearest};
constexpr gl::SamplerDecl kOne2D[] = {{"map", "sampler2D", 0, 1}};
constexpr gl::SamplerDecl kOne3D[] = {{"map", "sampler3D", 0, 1}};

template <typename T>
std::vector<std::byte> bytes_of(std::initializer_list<T> values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

std::vector<std::byte> halves_of(std::initializer_list<float> values) {
    std::vector<std::byte> bytes;
    for (const float v : values) {
        const uint16_t half = glm::packHalf1x16(v);
        const auto* raw = reinterpret_cast<const std::byte*>(&half);
        bytes.insert(bytes.end(), raw, raw + 2);
    }
    return bytes;
}

struct FormatCase {
    gl::Format format;
    std::vector<std::byte> texel; ///< as uploaded
    glm::vec4 sampled;            ///< what a shader must read
};

/// One texel of each format that a float sampler reads, with values that its precision holds exactly.
std::vector<FormatCase> format_cases() {
    using enum gl::Format;
    const float u = 1.0f / 255.0f;
    const float decoded = linear_from_srgb(100.0f * u);
    return {
        {R8, bytes_of<uint8_t>({51}), {51 * u, 0, 0, 1}},
        {RG8, bytes_of<uint8_t>({51, 255}), {51 * u, 1, 0, 1}},
        {RGB8, bytes_of<uint8_t>({1, 2, 3}), {1 * u, 2 * u, 3 * u, 1}},
        {RGBA8, bytes_of<uint8_t>({1, 2, 3, 4}), {1 * u, 2 * u, 3 * u, 4 * u}},
        {Srgb8Alpha8, bytes_of<uint8_t>({100, 0, 255, 100}), {decoded, 0, 1, 100 * u}},
        {R16F, halves_of({-1.5f}), {-1.5f, 0, 0, 1}},
        {RG16F, halves_of({1024.0f, 0.125f}), {1024.0f, 0.125f, 0, 1}},
        {RGB16F, halves_of({1.0f, 2.0f, 3.0f}), {1, 2, 3, 1}},
        {RGBA16F,
         halves_of({1.0f, 60000.0f, -3.0f, 0.5f}),
         {1, glm::unpackHalf1x16(glm::packHalf1x16(60000.0f)), -3, 0.5f}},
        {R11G11B10F,
         bytes_of<uint32_t>({glm::packF2x11_1x10(glm::vec3(1.5f, 4.0f, 0.25f))}),
         {1.5f, 4.0f, 0.25f, 1}},
        {RGB10A2,
         bytes_of<uint32_t>({1023u | (0u << 10) | (341u << 20) | (3u << 30)}),
         {1, 0, 341.0f / 1023.0f, 1}},
        {R32F, bytes_of<float>({1e30f}), {1e30f, 0, 0, 1}},
        {RG32F, bytes_of<float>({0.1f, -0.1f}), {0.1f, -0.1f, 0, 1}},
        {RGB32F, bytes_of<float>({0.1f, 0.2f, 0.3f}), {0.1f, 0.2f, 0.3f, 1}},
        {RGBA32F, bytes_of<float>({0.1f, 0.2f, 0.3f, 0.4f}), {0.1f, 0.2f, 0.3f, 0.4f}},
        {Depth16, bytes_of<uint16_t>({65535}), {1, 0, 0, 1}},
        {Depth24, bytes_of<uint32_t>({0}), {0, 0, 0, 1}},
        {Depth32F, bytes_of<float>({0.75f}), {0.75f, 0, 0, 1}},
    };
}

/// A solid RGBA8 level of a volume.
std::vector<std::byte> solid(glm::ivec3 size, std::array<uint8_t, 4> rgba) {
    std::vector<std::byte> texels;
    for (int i = 0; i < size.x * size.y * size.z; ++i) {
        for (const uint8_t v : rgba) {
            texels.push_back(static_cast<std::byte>(v));
        }
    }
    return texels;
}

} // namespace

TEST_SUITE("drivers/gles3/gl/texture") {
    TEST_CASE("a full mip chain ends at one texel, whatever the longest edge") {
        CHECK(gl::full_mip_count({1, 1, 1}) == 1);
        CHECK(gl::full_mip_count({2, 1, 1}) == 2);
        CHECK(gl::full_mip_count({5, 300, 1}) == 9);
        CHECK(gl::full_mip_count({64, 32, 128}) == 8);
    }

    TEST_CASE("[gl] texels of each format are sampled as they were uploaded") {
        on_each_gl([](GLTest&) {
            for (const FormatCase& c : format_cases()) {
                const std::string format(gl::format_info(c.format).name);
                CAPTURE(format);
                CHECK(c.texel.size() == static_cast<size_t>(gl::format_info(c.format).bytes_per_texel));
                Expected<gl::Texture2D> texture =
                    gl::Texture2D::create({.size = {1, 1}, .format = c.format, .sampler = kNearest});
                REQUIRE(texture);
                REQUIRE(texture->upload(0, {0, 0}, {1, 1}, c.texel));
                texture->bind(0);
                const glm::vec4 got =
                    probe_fragments("uniform sampler2D map;\n"
                                    "vec4 probe(int i) { return texelFetch(map, ivec2(0), 0); }",
                                    1, kOne2D)[0];
                CAPTURE(got.r);
                CAPTURE(got.g);
                CAPTURE(got.b);
                // llvmpipe decodes sRGB by a polynomial, 0.0009 off here; ES allows it. The others are exact.
                const float tolerance = c.format == gl::Format::Srgb8Alpha8 ? 2e-3f : 1e-6f;
                if (gl::format_info(c.format).kind == gl::FormatClass::Depth) {
                    CHECK(got.r == doctest::Approx(c.sampled.r)); // the others are undefined in ES 3.0
                } else {
                    const glm::vec4 scale = glm::max(glm::vec4(1.0f), glm::abs(c.sampled));
                    CHECK(worst_difference(got / scale, c.sampled / scale) <= tolerance);
                }
            }
        });
    }

    TEST_CASE("[gl] integer texels are sampled as they were uploaded") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture3D> texture =
                gl::Texture3D::create({.size = {2, 1, 1}, .format = gl::Format::R32UI, .sampler = kNearest});
            REQUIRE(texture);
            REQUIRE(texture->upload(0, {0, 0, 0}, {2, 1, 1}, bytes_of<uint32_t>({7, 0xFFFFFFFFu})));
            texture->bind(0);
            const auto got = probe_fragments("uniform usampler3D map;\n"
                                             "vec4 probe(int i) { uint v = texelFetch(map, ivec3(i, 0, 0), "
                                             "0).r; return vec4(v & 0xFFFFu, v >> 16, 0, 0); }",
                                             2, kOne3D);
            CHECK(got[0] == glm::vec4(7, 0, 0, 0));
            CHECK(got[1] == glm::vec4(65535, 65535, 0, 0));
        });
    }

    TEST_CASE("[gl] each mip of a volume is sampled as uploaded, and between two their mean") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture3D> volume = gl::Texture3D::create(
                {.size = {8, 4, 2},
                 .mips = 4,
                 .sampler = {.filter = gl::Filter::Linear, .mip_filter = gl::MipFilter::Linear}});
            REQUIRE(volume);
            for (int mip = 0; mip < 4; ++mip) {
                const glm::ivec3 size = volume->size(mip);
                REQUIRE(
                    volume->upload(mip, glm::ivec3(0), size, solid(size, {uint8_t(60 * mip), 0, 0, 255})));
            }
            volume->bind(0);
            const auto got = probe_fragments(
                "uniform sampler3D map;\n"
                "vec4 probe(int i) { return textureLod(map, vec3(0.3, 0.6, 0.5), float(i) * 0.5); }",
                9, kOne3D);
            for (int i = 0; i < 9; ++i) {
                const float lod = std::min(3.0f, static_cast<float>(i) * 0.5f); // beyond the last: the last
                CAPTURE(lod);
                CHECK(got[static_cast<size_t>(i)].r == doctest::Approx(60.0f * lod / 255.0f).epsilon(1e-2));
            }
        });
    }

    TEST_CASE("[gl] a box uploaded into a volume changes that box alone") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture3D> volume = gl::Texture3D::create({.size = {4, 4, 4}, .sampler = kNearest});
            REQUIRE(volume);
            REQUIRE(volume->upload(0, {0, 0, 0}, {4, 4, 4}, solid({4, 4, 4}, {0, 0, 0, 0})));
            REQUIRE(volume->upload(0, {1, 2, 0}, {2, 1, 3}, solid({2, 1, 3}, {255, 255, 255, 255})));
            volume->bind(0);
            const auto got = probe_fragments(
                "uniform sampler3D map;\n"
                "vec4 probe(int i) { return texelFetch(map, ivec3(i & 3, (i >> 2) & 3, i >> 4), 0); }",
                64, kOne3D);
            for (int i = 0; i < 64; ++i) {
                const int x = i & 3, y = (i >> 2) & 3, z = i >> 4;
                const bool inside = x >= 1 && x < 3 && y == 2 && z < 3;
                CAPTURE(i);
                CHECK(got[static_cast<size_t>(i)].r == (inside ? 1.0f : 0.0f));
            }
        });
    }

    TEST_CASE("[gl] each face of a cube map is seen along its axis") {
        on_each_gl([](GLTest&) {
            Expected<gl::TextureCube> cube = gl::TextureCube::create({.size = 2});
            REQUIRE(cube);
            for (int face = 0; face < 6; ++face) {
                REQUIRE(cube->upload(static_cast<gl::CubeFace>(face), 0,
                                     solid({2, 2, 1}, {uint8_t(40 * face), 0, 0, 0})));
            }
            cube->bind(0);
            static constexpr gl::SamplerDecl kCube[] = {{"map", "samplerCube", 0, 1}};
            const auto got = probe_fragments("uniform samplerCube map;\n"
                                             "vec4 probe(int i) {\n"
                                             "  vec3 d = vec3(0.0); d[i / 2] = (i & 1) == 0 ? 1.0 : -1.0;\n"
                                             "  return textureLod(map, d, 0.0);\n"
                                             "}",
                                             6, kCube);
            for (int face = 0; face < 6; ++face) {
                CHECK(got[static_cast<size_t>(face)].r ==
                      doctest::Approx(40.0f * static_cast<float>(face) / 255.0f));
            }
        });
    }

    TEST_CASE("[gl] a shadow sampler compares with less or equal") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture2D> depth =
                gl::Texture2D::create({.size = {1, 1},
                                       .format = gl::Format::Depth32F,
                                       .sampler = {.compare = gl::Compare::LessEqual}});
            REQUIRE(depth);
            REQUIRE(depth->upload(0, {0, 0}, {1, 1}, bytes_of<float>({0.5f})));
            depth->bind(0);
            static constexpr gl::SamplerDecl kShadow[] = {{"map", "sampler2DShadow", 0, 1}};
            const auto got = probe_fragments(
                "uniform sampler2DShadow map;\n"
                "vec4 probe(int i) { return vec4(texture(map, vec3(0.5, 0.5, float(i) * 0.25))); }",
                5, kShadow);
            for (int i = 0; i < 5; ++i) {
                CHECK(got[static_cast<size_t>(i)].r == (i <= 2 ? 1.0f : 0.0f));
            }
        });
    }

    TEST_CASE("[gl] generated mips of a checkerboard are grey") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture2D> texture = gl::Texture2D::create(
                {.size = {2, 2},
                 .mips = 2,
                 .sampler = {.filter = gl::Filter::Linear, .mip_filter = gl::MipFilter::Nearest}});
            REQUIRE(texture);
            REQUIRE(texture->upload(0, {0, 0}, {2, 2},
                                    bytes_of<uint8_t>({255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0})));
            texture->generate_mips();
            texture->bind(0);
            const auto got = probe_fragments(
                "uniform sampler2D map;\nvec4 probe(int i) { return textureLod(map, vec2(0.5), 1.0); }", 1,
                kOne2D);
            CHECK(got[0].r == doctest::Approx(0.5f).epsilon(0.01));
        });
    }

    TEST_CASE("[gl] GL's reuse of a name does not leave the old texture's binding behind") {
        on_each_gl([](GLTest&) {
            for (const uint8_t value : {uint8_t(255), uint8_t(0), uint8_t(51)}) {
                Expected<gl::Texture2D> texture = gl::Texture2D::create({.size = {1, 1}});
                REQUIRE(texture);
                REQUIRE(texture->upload(0, {0, 0}, {1, 1}, bytes_of<uint8_t>({value, 0, 0, 0})));
                texture->bind(0);
                const auto got = probe_fragments(
                    "uniform sampler2D map;\nvec4 probe(int i) { return texelFetch(map, ivec2(0), 0); }", 1,
                    kOne2D);
                CHECK(got[0].r == doctest::Approx(static_cast<float>(value) / 255.0f));
            }
        });
    }

    TEST_CASE("[gl] a moved texture is deleted once, by its last owner") {
        on_each_gl([](GLTest& gl_test) {
            Expected<gl::Texture2D> made = gl::Texture2D::create({.size = {1, 1}});
            REQUIRE(made);
            {
                gl::Texture2D a = *std::move(made);
                Expected<gl::Texture2D> other = gl::Texture2D::create({.size = {1, 1}});
                REQUIRE(other);
                gl::Texture2D b = *std::move(other);
                CHECK(gl_test.state().live(gl::ObjectKind::Texture) == 2);
                b = std::move(a);
            }
            CHECK(gl_test.state().live(gl::ObjectKind::Texture) == 0);
        });
    }

    TEST_CASE("[gl] uploads that do not fit are refused and say what would") {
        on_each_gl([](GLTest&) {
            Expected<gl::Texture2D> texture = gl::Texture2D::create({.size = {4, 2}, .mips = 2});
            REQUIRE(texture);
            const std::vector<std::byte> four(16);
            CHECK(texture->upload(2, {0, 0}, {1, 1}, four).error().message ==
                  "expected a mip of 0 to 1, found 2");
            CHECK(texture->upload(0, {3, 0}, {2, 1}, four).error().message ==
                  "expected a box inside 4x2x1, found 2x1x1 at 3x0x0");
            CHECK(texture->upload(0, {0x7FFFFFFF, 0}, {2, 2}, four).error().code ==
                  ErrorCode::InvalidArgument);
            CHECK(texture->upload(0, {-1, 0}, {2, 2}, four).error().code == ErrorCode::InvalidArgument);
            CHECK(texture->upload(0, {0, 0}, {4, 2}, four).error().message ==
                  "expected 32 bytes for 4x2x1 texels of RGBA8, found 16");
            CHECK(texture->upload(1, {0, 0}, {2, 1}, std::span(four).first(8)));
        });
    }

    TEST_CASE("[gl] sizes that no driver has are refused, not asked for") {
        on_each_gl([](GLTest&) {
            CHECK(gl::Texture2D::create({.size = {0, 1}}).error().code == ErrorCode::Unsupported);
            CHECK(gl::Texture2D::create({.size = {1 << 30, 1}}).error().code == ErrorCode::Unsupported);
            CHECK(gl::Texture3D::create({.size = {-4, 1, 1}}).error().code == ErrorCode::Unsupported);
            CHECK(gl::Texture2D::create({.size = {4, 4}, .mips = 4, .label = "x"}).error().message ==
                  "texture x: expected 1 to 3 mips, found 4");
        });
    }
}
