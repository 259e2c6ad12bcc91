// Damaged and lying image files: an error that names the file, never a crash, a hang or a huge allocation.
// Run with sanitize=address,undefined this also says that no decoder reads or writes out of bounds.

#include "core/image/codecs.h"

#include <doctest/doctest.h>
#include <turbojpeg.h>

#include <cstdint>
#include <string>
#include <vector>

using namespace cl;

namespace {

struct Sample {
    std::string name;
    std::vector<uint8_t> bytes;
};

Image make_pattern(PixelFormat format) {
    Image image{{23, 17}, format, {}};
    image.data.resize(static_cast<size_t>(23 * 17 * bytes_per_pixel(format)));
    if (is_float_format(format)) {
        for (size_t i = 0; i < image.floats().size(); ++i) {
            image.floats()[i] = static_cast<float>(i % 50) * 0.125f;
        }
    } else {
        for (size_t i = 0; i < image.data.size(); ++i) {
            image.data[i] = static_cast<uint8_t>(i % 51 * 5);
        }
    }
    return image;
}

std::vector<uint8_t> make_jpeg(int flags) {
    const Image image = make_pattern(PixelFormat::RGB8);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    void* jpeg = tjInitCompress();
    tjCompress2(jpeg, image.data.data(), 23, 0, 17, TJPF_RGB, &data, &size, TJSAMP_420, 60, flags);
    std::vector<uint8_t> bytes(data, data + size);
    tjFree(data);
    tjDestroy(jpeg);
    return bytes;
}

std::vector<uint8_t> make_hdr() {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 12\n";
    std::vector<uint8_t> bytes(header.begin(), header.end());
    for (uint8_t y = 0; y < 4; ++y) {
        for (const int b :
             {2, 2, 0, 12, 140, 7, 3, 1, 2, 3, 137, 9, 140, 0, 12, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 129}) {
            bytes.push_back(static_cast<uint8_t>(b));
        }
    }
    return bytes;
}

std::vector<Sample> make_samples() {
    return {{"a.png", *encode_png(make_pattern(PixelFormat::RGBA8))},
            {"a.jpg", make_jpeg(0)},
            {"progressive.jpg", make_jpeg(TJFLAG_PROGRESSIVE)},
            {"a.hdr", make_hdr()},
            {"a.exr", *encode_exr(make_pattern(PixelFormat::RGBF))}};
}

void put_be32(std::vector<uint8_t>& bytes, size_t at, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) {
        bytes[at + i] = static_cast<uint8_t>(value >> (24 - 8 * i));
    }
}

/// CRC-32 of a PNG chunk (ISO 3309), bit by bit.
uint32_t crc32(std::span<const uint8_t> bytes) {
    uint32_t crc = ~0u;
    for (const uint8_t b : bytes) {
        crc ^= b;
        for (int i = 0; i < 8; ++i) {
            crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
        }
    }
    return ~crc;
}

} // namespace

TEST_SUITE("core/image/damaged") {
    TEST_CASE("the samples are whole before they are damaged") {
        for (const Sample& sample : make_samples()) {
            CAPTURE(sample.name);
            CHECK(decode_image(sample.bytes, sample.name));
        }
    }

    TEST_CASE("a truncated file of any kind is an error that names it, wherever it is cut") {
        for (const Sample& sample : make_samples()) {
            const size_t step = sample.bytes.size() / 60 + 1;
            for (size_t length = 12; length < sample.bytes.size(); length += step) {
                CAPTURE(sample.name);
                CAPTURE(length);
                const std::vector<uint8_t> cut(sample.bytes.begin(),
                                               sample.bytes.begin() + static_cast<std::ptrdiff_t>(length));
                const Expected<Image> image = decode_image(cut, sample.name);
                REQUIRE_FALSE(image);
                CHECK(image.error().code == ErrorCode::ParseError);
                CHECK(image.error().where.file == sample.name);
            }
        }
    }

    TEST_CASE("one bad byte anywhere gives an image or an error that names the file") {
        for (const Sample& sample : make_samples()) {
            const size_t step = sample.bytes.size() / 250 + 1;
            for (size_t at = 0; at < sample.bytes.size(); at += step) {
                for (const int change : {0xFF, 0x01, 0x80}) {
                    CAPTURE(sample.name);
                    CAPTURE(at);
                    std::vector<uint8_t> bad = sample.bytes;
                    bad[at] = static_cast<uint8_t>(bad[at] ^ change);
                    const Expected<Image> image = decode_image(bad, sample.name);
                    if (image) {
                        CHECK(check_image_data(*image));
                    } else {
                        CHECK(image.error().where.file == sample.name);
                        CHECK(image.error().message.find('\n') == std::string::npos);
                    }
                }
            }
        }
    }

    TEST_CASE("a small file that claims a huge picture is refused before memory is asked for") {
        // 12000 x 12000 is within the limits: only the length of the file gives the lie away.
        std::vector<uint8_t> png = *encode_png(make_pattern(PixelFormat::RGBA8));
        put_be32(png, 16, 12000);
        put_be32(png, 20, 12000);
        put_be32(png, 29, crc32(std::span(png).subspan(12, 17)));
        const Expected<Image> image = decode_image(png, "a.png");
        REQUIRE_FALSE(image);
        CHECK(image.error().message.find("bytes for 12000x12000 pixels, found") != std::string::npos);

        const std::string hdr = "#?RADIANCE\n\n-Y 12000 +X 12000\n";
        const Expected<Image> light =
            decode_image({reinterpret_cast<const uint8_t*>(hdr.data()), hdr.size()}, "a.hdr");
        REQUIRE_FALSE(light);
        CHECK(light.error().message == "expected at least 48000 bytes for 12000x12000 pixels, found 30");
    }

    TEST_CASE("a picture beyond the limits is refused") {
        const auto error = [](const std::string& size) {
            const std::string hdr = "#?RADIANCE\n\n" + size + "\n";
            return decode_image({reinterpret_cast<const uint8_t*>(hdr.data()), hdr.size()}, "a.hdr").error();
        };
        CHECK(error("-Y 1 +X 16385").code == ErrorCode::OutOfMemory);
        CHECK(error("-Y 1 +X 16385").message == "expected at most 16384x16384 pixels, found 16385x1");
        CHECK(error("-Y 16384 +X 16384").message ==
              "expected an image of at most 2147483648 bytes, found 16384x16384 RGBF of 3221225472");
        CHECK(error("-Y 99999999999999999999 +X 1").code == ErrorCode::ParseError);
    }
}
