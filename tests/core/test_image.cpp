#include "tests/temporary_dir.h"

#include "core/image.h"
#include "core/image/codecs.h"
#include "core/io/file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace cl;

namespace {

constexpr PixelFormat kAllFormats[] = {
    PixelFormat::L8,    PixelFormat::LA8, PixelFormat::R8,  PixelFormat::RG8,  PixelFormat::RGB8,
    PixelFormat::RGBA8, PixelFormat::RF,  PixelFormat::RGF, PixelFormat::RGBF, PixelFormat::RGBAF};

Image one_pixel(PixelFormat format, std::vector<uint8_t> bytes) {
    return Image{glm::ivec2(1), format, std::move(bytes)};
}

Image one_float_pixel(PixelFormat format, const std::vector<float>& values) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
    return Image{glm::ivec2(1), format, {bytes, bytes + values.size() * sizeof(float)}};
}

} // namespace

TEST_SUITE("core/image") {
    TEST_CASE("converting to a format and back loses nothing when the format has room for all") {
        Image image{{256, 1}, PixelFormat::RGBA8, {}};
        for (int i = 0; i < 256; ++i) {
            for (const int v : {i, 255 - i, i / 2, i}) {
                image.data.push_back(static_cast<uint8_t>(v));
            }
        }
        CHECK(image.converted_to(PixelFormat::RGBAF).converted_to(PixelFormat::RGBA8).data == image.data);
        const Image grey = image.converted_to(PixelFormat::LA8);
        CHECK(grey.converted_to(PixelFormat::RGBA8).converted_to(PixelFormat::LA8).data == grey.data);
        const Image rgb = image.converted_to(PixelFormat::RGB8);
        CHECK(rgb.converted_to(PixelFormat::RGBAF).converted_to(PixelFormat::RGB8).data == rgb.data);
    }

    TEST_CASE("every conversion gives as many bytes as its format says") {
        for (const PixelFormat from : kAllFormats) {
            Image image{{3, 2}, from, std::vector<uint8_t>(static_cast<size_t>(6 * bytes_per_pixel(from)))};
            for (const PixelFormat to : kAllFormats) {
                const Image out = image.converted_to(to);
                CHECK(out.format == to);
                CHECK(out.size == image.size);
                CHECK(check_image_data(out));
            }
        }
    }

    TEST_CASE("absent channels are read as a shader reads them") {
        const auto rgba = [](const Image& image) { return image.converted_to(PixelFormat::RGBA8).data; };
        CHECK(rgba(one_pixel(PixelFormat::L8, {9})) == std::vector<uint8_t>{9, 9, 9, 255});
        CHECK(rgba(one_pixel(PixelFormat::LA8, {9, 7})) == std::vector<uint8_t>{9, 9, 9, 7});
        CHECK(rgba(one_pixel(PixelFormat::R8, {9})) == std::vector<uint8_t>{9, 0, 0, 255});
        CHECK(rgba(one_pixel(PixelFormat::RG8, {9, 7})) == std::vector<uint8_t>{9, 7, 0, 255});
        CHECK(rgba(one_pixel(PixelFormat::RGB8, {9, 7, 5})) == std::vector<uint8_t>{9, 7, 5, 255});
    }

    TEST_CASE("floats beyond [0, 1] are clamped and NaN is 0 in 8 bits") {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float inf = std::numeric_limits<float>::infinity();
        const Image image = one_float_pixel(PixelFormat::RGBAF, {nan, inf, -inf, 0.5f});
        CHECK(image.converted_to(PixelFormat::RGBA8).data == std::vector<uint8_t>{0, 255, 0, 128});
    }

    TEST_CASE("a kind of data that is no known image is refused by name") {
        for (const std::string& text :
             {std::string(), std::string("\x89PNG"), std::string("GIF89a"), std::string(64, '\0')}) {
            const Expected<Image> image =
                decode_image({reinterpret_cast<const uint8_t*>(text.data()), text.size()}, "a.png");
            REQUIRE_FALSE(image);
            CHECK(image.error().code == ErrorCode::Unsupported);
            CHECK(image.error().to_string() == "a.png: error: expected a PNG, JPEG, Radiance HDR or OpenEXR "
                                               "image, found another kind of data");
        }
    }

    TEST_CASE("the kind of an image is told by its content, not by its name") {
        const tests::TemporaryDir dir;
        const Image image = one_pixel(PixelFormat::RGB8, {1, 2, 3});
        REQUIRE(save_image(image, dir / "a.png"));
        std::filesystem::rename(dir / "a.png", dir / "a.jpg");
        const Expected<Image> loaded = load_image(dir / "a.jpg");
        REQUIRE(loaded);
        CHECK(loaded->data == image.data);
    }

    TEST_CASE("saving says what a file format cannot hold, and writes nothing") {
        const tests::TemporaryDir dir;
        const auto error = [&](const Image& image, const std::string& name) {
            const Status status = save_image(image, dir / name);
            return status ? std::string("no error") : status.error().message;
        };
        const Image bytes = one_pixel(PixelFormat::RGB8, {1, 2, 3});
        const Image floats = one_float_pixel(PixelFormat::RGBF, {1, 2, 3});
        CHECK(error(bytes, "a.exr") == "expected a float image for EXR, found RGB8");
        CHECK(error(floats, "a.png") == "expected an 8-bit image for PNG, found RGBF");
        CHECK(error(bytes, "a.bmp") == "expected a .png or .exr name, found \".bmp\"");
        CHECK(error({{2, 2}, PixelFormat::RGB8, {1}}, "a.png") ==
              "expected the data of 2x2 RGB8 pixels, found 1 bytes");
        CHECK(std::filesystem::is_empty(dir.path()));
        CHECK(error(bytes, "A.PNG") == "no error");
    }

    TEST_CASE("an image that is missing is named") {
        const Expected<Image> image = load_image("/no/such.png");
        REQUIRE_FALSE(image);
        CHECK(image.error().to_string() == "/no/such.png: error: expected a file, found none");
    }
}
