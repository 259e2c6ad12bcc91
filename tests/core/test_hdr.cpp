#include "tests/shared_dir.h"

#include "core/image/codecs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace cl;

namespace {

std::vector<uint8_t> make_hdr(const std::string& size_line, const std::vector<uint8_t>& pixels) {
    const std::string header = "#?RADIANCE\n# made by a test\nFORMAT=32-bit_rle_rgbe\n\n" + size_line + "\n";
    std::vector<uint8_t> bytes(header.begin(), header.end());
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return bytes;
}

std::string error_of(const std::vector<uint8_t>& bytes) {
    const Expected<Image> image = decode_image(bytes, "a.hdr");
    return image ? "no error" : image.error().to_string();
}

} // namespace

TEST_SUITE("core/image/hdr") {
    TEST_CASE("a pixel is its mantissas times the power of two, exponent 0 is black") {
        const Expected<Image> image = decode_image(
            make_hdr("-Y 1 +X 3", {128, 64, 0, 129, 255, 255, 255, 0, 255, 128, 1, 140}), "a.hdr");
        REQUIRE(image);
        CHECK(image->format == PixelFormat::RGBF);
        const std::vector<float> expected = {1.0f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f, 4080.0f, 2048.0f, 16.0f};
        CHECK(std::equal(expected.begin(), expected.end(), image->floats().begin(), image->floats().end()));
    }

    TEST_CASE("runs of whole pixels repeat the one before, with longer counts after each other") {
        const Expected<Image> image =
            decode_image(make_hdr("-Y 2 +X 260", {128, 0,   0,   129, 1, 1, 1, 2, 1, 1, 1, 1,
                                                  0,   128, 0,   129, // 1 + 2 + 256 + 1
                                                  0,   0,   128, 129, 1, 1, 1, 3, 1, 1, 1, 1}), // 1 + 3 + 256
                         "a.hdr");
        REQUIRE(image);
        const std::span<const float> v = image->floats();
        for (size_t x = 0; x < 260; ++x) {
            CHECK(v[x * 3] == (x < 259 ? 1.0f : 0.0f));
            CHECK(v[x * 3 + 1] == (x < 259 ? 0.0f : 1.0f));
            CHECK(v[(260 + x) * 3 + 2] == 1.0f);
        }
    }

    TEST_CASE("channels of runs and literals are put together") {
        std::vector<uint8_t> pixels = {2, 2, 0, 8};
        const std::vector<uint8_t> red = {8, 128, 64, 32, 16, 8, 4, 2, 1};
        const std::vector<uint8_t> green_blue_exponent = {128 + 8, 0, 128 + 3, 128, 5,       0,
                                                          0,       0, 0,       64,  128 + 8, 129};
        pixels.insert(pixels.end(), red.begin(), red.end());
        pixels.insert(pixels.end(), green_blue_exponent.begin(), green_blue_exponent.end());
        const Expected<Image> image = decode_image(make_hdr("-Y 1 +X 8", pixels), "a.hdr");
        REQUIRE(image);
        for (size_t x = 0; x < 8; ++x) {
            CHECK(image->floats()[x * 3] == std::ldexp(1.0f, -static_cast<int>(x)));
            CHECK(image->floats()[x * 3 + 1] == 0.0f);
            CHECK(image->floats()[x * 3 + 2] == (x < 3 ? 1.0f : x < 7 ? 0.0f : 0.5f));
        }
    }

    TEST_CASE("damage is named") {
        CHECK(error_of(make_hdr("+Y 1 +X 1", {0, 0, 0, 0})) ==
              "a.hdr: error: damaged HDR: expected \"-Y height +X width\" after the header");
        CHECK(error_of(make_hdr("-Y 1 +X 2", {9, 9, 9, 9})) ==
              "a.hdr: error: damaged HDR: the data ends early");
        CHECK(error_of(make_hdr("-Y 1 +X 2", {1, 1, 1, 1, 9, 9, 9, 9})) ==
              "a.hdr: error: damaged HDR: a run longer than its scanline");
        CHECK(error_of(make_hdr("-Y 1 +X 8", {2, 2, 0, 9, 136, 1})) ==
              "a.hdr: error: damaged HDR: a scanline of another width");
        CHECK(error_of(make_hdr("-Y 1 +X 8", {2, 2, 0, 8, 0, 1, 0, 1})) ==
              "a.hdr: error: damaged HDR: a run longer than its scanline");
        CHECK(error_of(make_hdr("-Y 0 +X 8", {})) == "a.hdr: error: expected at least 1x1 pixels, found 8x0");
        CHECK(error_of(make_hdr("-Y -5 +X 8", {})) ==
              "a.hdr: error: expected at least 1x1 pixels, found 8x-5");
    }

    TEST_CASE("a real panorama decodes to finite light, brighter than any 8-bit picture") {
        const auto shared = tests::shared_dir();
        if (!shared) {
            MESSAGE("skipped: no reference material");
            return;
        }
        const Expected<Image> image = load_image(*shared / "assets/hdri/spiaggia_di_mondello_1k.hdr");
        REQUIRE(image);
        CHECK(image->size == glm::ivec2(1024, 512));
        const std::span<const float> v = image->floats();
        CHECK(std::all_of(v.begin(), v.end(), [](float f) { return std::isfinite(f) && f >= 0.0f; }));
        CHECK(*std::max_element(v.begin(), v.end()) > 2.0f);
    }
}
