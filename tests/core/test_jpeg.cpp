#include "core/image/codecs.h"

#include <doctest/doctest.h>
#include <turbojpeg.h>

#include <cmath>
#include <vector>

using namespace cl;

namespace {

std::vector<uint8_t> make_jpeg(const Image& image, int subsampling, int pixel_format) {
    unsigned char* data = nullptr;
    unsigned long size = 0;
    void* jpeg = tjInitCompress();
    tjCompress2(jpeg, image.data.data(), image.size.x, 0, image.size.y, pixel_format, &data, &size,
                subsampling, 95, 0);
    std::vector<uint8_t> bytes(data, data + size);
    tjFree(data);
    tjDestroy(jpeg);
    return bytes;
}

Image make_gradient(glm::ivec2 size, PixelFormat format) {
    Image image{size, format, {}};
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            for (int c = 0; c < channel_count(format); ++c) {
                image.data.push_back(static_cast<uint8_t>(40 + (c + 1) * x + (3 - c) * y));
            }
        }
    }
    return image;
}

double mean_difference(const Image& a, const Image& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) {
        sum += std::abs(int{a.data[i]} - int{b.data[i]});
    }
    return sum / static_cast<double>(a.data.size());
}

} // namespace

TEST_SUITE("core/image/jpeg") {
    TEST_CASE("a smooth JPEG comes back the right way up with its colours in order") {
        const Image image = make_gradient({35, 21}, PixelFormat::RGB8);
        for (const int subsampling : {TJSAMP_444, TJSAMP_420}) {
            const Expected<Image> back = decode_image(make_jpeg(image, subsampling, TJPF_RGB), "a.jpg");
            REQUIRE(back);
            CHECK(back->size == image.size);
            CHECK(back->format == PixelFormat::RGB8);
            CHECK(mean_difference(*back, image) <
                  2.0); // quality 95; a swapped channel or row differs by over 10
        }
    }

    TEST_CASE("a grey JPEG stays grey") {
        const Image image = make_gradient({9, 8}, PixelFormat::L8);
        const Expected<Image> back = decode_image(make_jpeg(image, TJSAMP_GRAY, TJPF_GRAY), "a.jpg");
        REQUIRE(back);
        CHECK(back->format == PixelFormat::L8);
        CHECK(mean_difference(*back, image) < 2.0);
    }

    TEST_CASE("a CMYK JPEG is refused with the reason") {
        const Image image = make_gradient({8, 8}, PixelFormat::RGBA8);
        const Expected<Image> back = decode_image(make_jpeg(image, TJSAMP_444, TJPF_CMYK), "a.jpg");
        REQUIRE_FALSE(back);
        CHECK(back.error().to_string() == "a.jpg: error: expected a grey or RGB JPEG, found CMYK");
    }
}
