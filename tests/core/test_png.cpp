#include "core/image/codecs.h"

#include <doctest/doctest.h>
#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <vector>

using namespace cl;

namespace {

/// What a PNG of any kind is made of; rows are packed as the kind says.
struct PngRecipe {
    uint32_t width = 1;
    uint32_t height = 1;
    int bit_depth = 8;
    int color_type = PNG_COLOR_TYPE_RGB;
    int interlace = PNG_INTERLACE_NONE;
    std::vector<png_color> palette;
    std::vector<uint8_t> palette_alpha;
    std::vector<uint8_t> pixels;
};

void append(png_structp png, png_bytep data, size_t count) {
    auto* out = static_cast<std::vector<uint8_t>*>(png_get_io_ptr(png));
    out->insert(out->end(), data, data + count);
}

std::vector<uint8_t> make_png(const PngRecipe& recipe) {
    std::vector<uint8_t> out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &out, append, nullptr);
    png_set_IHDR(png, info, recipe.width, recipe.height, recipe.bit_depth, recipe.color_type,
                 recipe.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!recipe.palette.empty()) {
        png_set_PLTE(png, info, recipe.palette.data(), static_cast<int>(recipe.palette.size()));
    }
    if (!recipe.palette_alpha.empty()) {
        png_set_tRNS(png, info, recipe.palette_alpha.data(), static_cast<int>(recipe.palette_alpha.size()),
                     nullptr);
    }
    png_write_info(png, info);
    const size_t row_bytes = recipe.pixels.size() / recipe.height;
    std::vector<uint8_t*> rows;
    for (uint32_t y = 0; y < recipe.height; ++y) {
        rows.push_back(const_cast<uint8_t*>(recipe.pixels.data() + y * row_bytes));
    }
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

/// Every byte different from its neighbours, the same each time.
Image make_pattern(glm::ivec2 size, PixelFormat format) {
    Image image{size, format, {}};
    image.data.resize(static_cast<size_t>(size.x) * size.y * bytes_per_pixel(format));
    for (size_t i = 0; i < image.data.size(); ++i) {
        image.data[i] = static_cast<uint8_t>(i * i * 7 + i);
    }
    return image;
}

} // namespace

TEST_SUITE("core/image/png") {
    TEST_CASE("an 8-bit image comes back from PNG unchanged") {
        for (const PixelFormat format :
             {PixelFormat::L8, PixelFormat::LA8, PixelFormat::RGB8, PixelFormat::RGBA8}) {
            for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(37, 5), glm::ivec2(5, 37)}) {
                const Image image = make_pattern(size, format);
                const Expected<std::vector<uint8_t>> bytes = encode_png(image);
                REQUIRE(bytes);
                const Expected<Image> back = decode_image(*bytes, "a.png");
                REQUIRE(back);
                CHECK(back->size == size);
                CHECK(back->format == format);
                CHECK(back->data == image.data);
            }
        }
    }

    TEST_CASE("red is written as grey, red-green as colour") {
        CHECK(decode_image(*encode_png(make_pattern({3, 2}, PixelFormat::R8)), "")->format ==
              PixelFormat::L8);
        const Image rg = make_pattern({3, 2}, PixelFormat::RG8);
        CHECK(decode_image(*encode_png(rg), "")->data == rg.converted_to(PixelFormat::RGB8).data);
    }

    TEST_CASE("16-bit channels are scaled to 8 bit, rounded to nearest") {
        PngRecipe recipe{.width = 4,
                         .bit_depth = 16,
                         .color_type = PNG_COLOR_TYPE_GRAY,
                         .palette = {},
                         .palette_alpha = {},
                         .pixels = {}};
        recipe.pixels = {0x00, 0x00, 0x00, 0x81, 0x80, 0x00, 0xFF, 0xFF};
        const Expected<Image> image = decode_image(make_png(recipe), "a.png");
        REQUIRE(image);
        CHECK(image->format == PixelFormat::L8);
        CHECK(image->data == std::vector<uint8_t>{0, 1, 128, 255});
    }

    TEST_CASE("grey of 1, 2 and 4 bits covers 0 to 255") {
        for (const int depth : {1, 2, 4}) {
            PngRecipe recipe{.width = 2,
                             .bit_depth = depth,
                             .color_type = PNG_COLOR_TYPE_GRAY,
                             .palette = {},
                             .palette_alpha = {},
                             .pixels = {}};
            recipe.pixels = {static_cast<uint8_t>(0xFF >> depth)}; // 0, then the largest value
            const Expected<Image> image = decode_image(make_png(recipe), "a.png");
            REQUIRE(image);
            CHECK(image->data == std::vector<uint8_t>{0, 255});
        }
    }

    TEST_CASE("a palette becomes its colours, with alpha if it has any") {
        PngRecipe recipe{.width = 3,
                         .bit_depth = 2,
                         .color_type = PNG_COLOR_TYPE_PALETTE,
                         .palette = {},
                         .palette_alpha = {},
                         .pixels = {}};
        recipe.palette = {{1, 2, 3}, {40, 50, 60}, {7, 8, 9}};
        recipe.pixels = {0b10'00'01'00};
        Expected<Image> image = decode_image(make_png(recipe), "a.png");
        REQUIRE(image);
        CHECK(image->format == PixelFormat::RGB8);
        CHECK(image->data == std::vector<uint8_t>{7, 8, 9, 1, 2, 3, 40, 50, 60});

        recipe.palette_alpha = {255, 0};
        image = decode_image(make_png(recipe), "a.png");
        REQUIRE(image);
        CHECK(image->format == PixelFormat::RGBA8);
        CHECK(image->data == std::vector<uint8_t>{7, 8, 9, 255, 1, 2, 3, 255, 40, 50, 60, 0});
    }

    TEST_CASE("an interlaced PNG gives the same picture as a plain one") {
        const Image image = make_pattern({13, 11}, PixelFormat::RGBA8);
        PngRecipe recipe{.width = 13,
                         .height = 11,
                         .color_type = PNG_COLOR_TYPE_RGB_ALPHA,
                         .palette = {},
                         .palette_alpha = {},
                         .pixels = image.data};
        const Expected<Image> plain = decode_image(make_png(recipe), "a.png");
        recipe.interlace = PNG_INTERLACE_ADAM7;
        const Expected<Image> interlaced = decode_image(make_png(recipe), "a.png");
        REQUIRE(plain);
        REQUIRE(interlaced);
        CHECK(plain->data == image.data);
        CHECK(interlaced->data == image.data);
    }
}
