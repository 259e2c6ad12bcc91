#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"

#include "drivers/gles3/texture_storage.h"

#include "core/math/color.h"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;
using tests::worst_difference;

namespace {

constexpr TextureParams kPlain{.mipmaps = false, .repeat = false, .filter = false};
constexpr gl::SamplerDecl kMap[] = {{"map", "sampler2D", 0, 1}};

Image bytes_image(glm::ivec2 size, PixelFormat format, std::vector<uint8_t> data) {
    return {size, format, std::move(data)};
}

Image floats_image(PixelFormat format, const std::vector<float>& values) {
    Image image{{1, 1}, format, std::vector<uint8_t>(values.size() * sizeof(float))};
    std::memcpy(image.data.data(), values.data(), image.data.size());
    return image;
}

TextureStorage make_storage() {
    Expected<TextureStorage> storage = TextureStorage::create();
    REQUIRE(storage);
    return *std::move(storage);
}

/// Texel (0, 0) of level `lod` as a shader sees it.
glm::vec4 texel(const gl::Texture2D& texture, int lod = 0) {
    texture.bind(0);
    return tests::probe_fragments(
        "uniform sampler2D map;\nvec4 probe(int i) { return texelFetch(map, ivec2(0), " +
            std::to_string(lod) + "); }",
        1, kMap)[0];
}

/// Samples along u at v = 0.5.
std::vector<glm::vec4> samples(const gl::Texture2D& texture, std::string_view u, int count) {
    texture.bind(0);
    return tests::probe_fragments("uniform sampler2D map;\nvec4 probe(int i) { return textureLod(map, vec2(" +
                                      std::string(u) + ", 0.5), 0.0); }",
                                  count, kMap);
}

} // namespace

TEST_SUITE("drivers/gles3/texture_storage") {
    TEST_CASE("[gl] every pixel format is sampled as its grey, colour and alpha") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            const float u = 1.0f / 255.0f;
            struct Case {
                Image image;
                glm::vec4 sampled;
            };
            const std::vector<Case> cases{
                {bytes_image({1, 1}, PixelFormat::L8, {51}), {51 * u, 51 * u, 51 * u, 1}},
                {bytes_image({1, 1}, PixelFormat::LA8, {51, 102}), {51 * u, 51 * u, 51 * u, 102 * u}},
                {bytes_image({1, 1}, PixelFormat::R8, {51}), {51 * u, 0, 0, 1}},
                {bytes_image({1, 1}, PixelFormat::RG8, {51, 102}), {51 * u, 102 * u, 0, 1}},
                {bytes_image({1, 1}, PixelFormat::RGB8, {1, 2, 3}), {1 * u, 2 * u, 3 * u, 1}},
                {bytes_image({1, 1}, PixelFormat::RGBA8, {1, 2, 3, 4}), {1 * u, 2 * u, 3 * u, 4 * u}},
                {floats_image(PixelFormat::RF, {2.5f}), {2.5f, 0, 0, 1}},
                {floats_image(PixelFormat::RGF, {2.5f, -1}), {2.5f, -1, 0, 1}},
                {floats_image(PixelFormat::RGBF, {2.5f, -1, 1000}), {2.5f, -1, 1000, 1}},
                {floats_image(PixelFormat::RGBAF, {2.5f, -1, 1000, 0.5f}), {2.5f, -1, 1000, 0.5f}},
            };
            for (const Case& c : cases) {
                const int format = static_cast<int>(c.image.format);
                CAPTURE(format);
                const Expected<RID> rid = storage.create(c.image, kPlain, TextureColorSpace::Linear);
                REQUIRE(rid);
                CHECK(worst_difference(texel(*storage.get(*rid)), c.sampled) <= 1e-6f);
            }
        });
    }

    TEST_CASE("[gl] sRGB textures are decoded on sampling, their alpha is not, nor are grey ones") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            for (int v = 0; v < 256; v += 15) {
                const auto byte = static_cast<uint8_t>(v);
                const float encoded = static_cast<float>(v) / 255.0f;
                const Expected<RID> color =
                    storage.create(bytes_image({1, 1}, PixelFormat::RGBA8, {byte, 0, 255, byte}), kPlain,
                                   TextureColorSpace::Srgb);
                const Expected<RID> gray = storage.create(bytes_image({1, 1}, PixelFormat::LA8, {byte, byte}),
                                                          kPlain, TextureColorSpace::Srgb);
                REQUIRE(color);
                REQUIRE(gray);
                const float linear = linear_from_srgb(encoded);
                CHECK(worst_difference(texel(*storage.get(*color)), {linear, 0, 1, encoded}) <= 2e-3f);
                CHECK(worst_difference(texel(*storage.get(*gray)), {encoded, encoded, encoded, encoded}) <=
                      2e-3f);
            }
        });
    }

    TEST_CASE("[gl] mips are means of the stored bytes: a checkerboard becomes 128 before sRGB decoding") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            const Image board =
                bytes_image({2, 2}, PixelFormat::RGB8, {255, 255, 255, 0, 0, 0, 0, 0, 0, 255, 255, 255});
            const Expected<RID> linear = storage.create(board, {}, TextureColorSpace::Linear);
            const Expected<RID> srgb = storage.create(board, {}, TextureColorSpace::Srgb);
            REQUIRE(linear);
            REQUIRE(srgb);
            CHECK(storage.get(*linear)->mips() == 2);
            CHECK(texel(*storage.get(*linear), 1).r == doctest::Approx(128.0f / 255.0f));
            CHECK(texel(*storage.get(*srgb), 1).r ==
                  doctest::Approx(linear_from_srgb(128.0f / 255.0f)).epsilon(0.01));
        });
    }

    TEST_CASE("[gl] every level of a 5x3 texture of one colour has that colour") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            const Expected<RID> rid =
                storage.create(bytes_image({5, 3}, PixelFormat::L8, std::vector<uint8_t>(15, 77)), {},
                               TextureColorSpace::Linear);
            REQUIRE(rid);
            REQUIRE(storage.get(*rid)->mips() == 3);
            for (int mip = 0; mip < 3; ++mip) {
                CHECK(texel(*storage.get(*rid), mip).r == doctest::Approx(77.0f / 255.0f));
            }
        });
    }

    TEST_CASE("[gl] floats that a half cannot hold stay finite") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            const float inf = std::numeric_limits<float>::infinity();
            const Expected<RID> rid =
                storage.create(floats_image(PixelFormat::RGBAF,
                                            {1e10f, -inf, std::numeric_limits<float>::quiet_NaN(), 1.0f}),
                               kPlain, TextureColorSpace::Linear);
            REQUIRE(rid);
            CHECK(texel(*storage.get(*rid)) == glm::vec4(65504.0f, -65504.0f, 0.0f, 1.0f));
        });
    }

    TEST_CASE("[gl] wrapping and filtering are what the parameters say") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            const Image edge = bytes_image({2, 1}, PixelFormat::L8, {0, 255});
            const auto make = [&](const TextureParams& params) -> const gl::Texture2D& {
                const Expected<RID> rid = storage.create(edge, params, TextureColorSpace::Linear);
                REQUIRE(rid);
                return *storage.get(*rid);
            };
            // Centres of the texels at u = 1.25 and 1.75: repeated 0 1, mirrored 1 0, clamped 1 1.
            constexpr std::string_view kBeyond = "1.25 + 0.5 * float(i)";
            const auto repeated = samples(make({.mipmaps = false, .filter = false}), kBeyond, 2);
            CHECK(repeated[0].r == 0.0f);
            CHECK(repeated[1].r == 1.0f);
            const auto mirrored =
                samples(make({.mipmaps = false, .mirrored_repeat = true, .filter = false}), kBeyond, 2);
            CHECK(mirrored[0].r == 1.0f);
            CHECK(mirrored[1].r == 0.0f);
            const auto clamped =
                samples(make({.mipmaps = false, .repeat = false, .filter = false}), kBeyond, 2);
            CHECK(clamped[0].r == 1.0f);
            CHECK(clamped[1].r == 1.0f);
            CHECK(samples(make({.mipmaps = false, .repeat = false}), "0.5", 1)[0].r ==
                  doctest::Approx(0.5f).epsilon(0.01));
            CHECK(samples(make({.mipmaps = false, .repeat = false, .filter = false}), "0.4", 1)[0].r == 0.0f);
        });
    }

    TEST_CASE("[gl] a stale or null RID gets the stand-in that was asked for") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            const Expected<RID> rid =
                storage.create(bytes_image({1, 1}, PixelFormat::L8, {9}), kPlain, TextureColorSpace::Linear);
            REQUIRE(rid);
            CHECK(&storage.get_or(*rid, DefaultTexture::White) == storage.get(*rid));
            CHECK(storage.free(*rid));
            CHECK_FALSE(storage.free(*rid));
            CHECK(storage.get(*rid) == nullptr);
            CHECK(texel(storage.get_or(*rid, DefaultTexture::White)) == glm::vec4(1.0f));
            CHECK(texel(storage.get_or({}, DefaultTexture::Black)) == glm::vec4(0, 0, 0, 1));
            CHECK(texel(storage.get_or({}, DefaultTexture::FlatNormal)).b == 1.0f);
        });
    }

    TEST_CASE("[gl] images that do not fill their size, or have none, are refused") {
        on_each_gl([](GLTest&) {
            TextureStorage storage = make_storage();
            CHECK(
                storage.create(bytes_image({2, 2}, PixelFormat::L8, {1, 2, 3}), {}, TextureColorSpace::Linear)
                    .error()
                    .message == "expected 4 bytes for an image of 2x2, found 3");
            CHECK(storage.create(bytes_image({0, 0}, PixelFormat::L8, {}), {}, TextureColorSpace::Linear)
                      .error()
                      .code == ErrorCode::Unsupported);
            CHECK(storage.create(bytes_image({-1, -1}, PixelFormat::L8, {}), {}, TextureColorSpace::Linear)
                      .error()
                      .code == ErrorCode::Unsupported);
        });
    }
}
