#include "tests/temporary_dir.h"

#include "core/image/codecs.h"
#include "core/image/exr_stream.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

using namespace cl;

namespace {

Image make_light(glm::ivec2 size, PixelFormat format) {
    Image image{size, format, {}};
    image.data.resize(static_cast<size_t>(size.x) * size.y * bytes_per_pixel(format));
    float value = 1.0e-6f;
    for (float& v : image.floats()) {
        v = value;
        value = value > 1.0e6f ? -1.0f / value : value * 1.37f;
    }
    return image;
}

} // namespace

TEST_SUITE("core/image/exr") {
    TEST_CASE("a float image comes back from EXR to the bit, infinities and NaN included") {
        for (const PixelFormat format : {PixelFormat::RGBF, PixelFormat::RGBAF}) {
            Image image = make_light({37, 21}, format);
            image.floats()[0] = std::numeric_limits<float>::infinity();
            image.floats()[1] = std::numeric_limits<float>::quiet_NaN();
            image.floats()[2] = -0.0f;
            const tests::TemporaryDir dir;
            REQUIRE(save_image(image, dir / "a.exr"));
            const Expected<Image> back = load_image(dir / "a.exr");
            REQUIRE(back);
            CHECK(back->size == image.size);
            CHECK(back->format == format);
            CHECK(back->data == image.data);
        }
    }

    TEST_CASE("one and two channels are written as three") {
        const Image image = make_light({4, 3}, PixelFormat::RGF);
        CHECK(decode_image(*encode_exr(image), "")->data == image.converted_to(PixelFormat::RGBF).data);
    }

    TEST_CASE("a grey half-float file whose window starts elsewhere gives its pixels in all three channels") {
        const IMATH_NAMESPACE::Box2i window({-3, 5}, {1, 7});
        Imf::Header header(IMATH_NAMESPACE::Box2i({0, 0}, {9, 9}), window);
        header.compression() = Imf::PIZ_COMPRESSION;
        header.channels().insert("Y", Imf::Channel(Imf::HALF));
        std::vector<half> grey;
        for (int i = 0; i < 15; ++i) {
            grey.emplace_back(static_cast<float>(i) * 0.25f);
        }
        ExrOutput output;
        {
            Imf::FrameBuffer frame;
            frame.insert("Y", Imf::Slice::Make(Imf::HALF, grey.data(), window));
            Imf::OutputFile file(output, header, 0);
            file.setFrameBuffer(frame);
            file.writePixels(3);
        }
        const Expected<Image> image = decode_image(output.take(), "a.exr");
        REQUIRE(image);
        CHECK(image->size == glm::ivec2(5, 3));
        CHECK(image->format == PixelFormat::RGBF);
        for (size_t i = 0; i < 45; ++i) {
            CHECK(image->floats()[i] == static_cast<float>(i / 3) * 0.25f);
        }
    }

    TEST_CASE("a tiled file gives the same picture as one of scanlines") {
        const Image image = make_light({37, 21}, PixelFormat::RGBF);
        Imf::Header header(37, 21);
        header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
        ExrOutput output;
        {
            Imf::FrameBuffer frame;
            constexpr const char* kNames[] = {"R", "G", "B"};
            for (size_t c = 0; c < 3; ++c) {
                header.channels().insert(kNames[c], Imf::Channel(Imf::FLOAT));
                auto* first = const_cast<char*>(reinterpret_cast<const char*>(image.floats().data() + c));
                frame.insert(kNames[c], Imf::Slice(Imf::FLOAT, first, 12, 12 * 37));
            }
            Imf::TiledOutputFile file(output, header, 0);
            file.setFrameBuffer(frame);
            file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
        }
        const Expected<Image> back = decode_image(output.take(), "a.exr");
        REQUIRE(back);
        CHECK(back->data == image.data);
    }

    TEST_CASE("a file without colour or brightness is refused") {
        Imf::Header header(2, 2);
        header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
        const float depth[4] = {};
        ExrOutput output;
        {
            Imf::FrameBuffer frame;
            frame.insert(
                "Z", Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(depth)), 4, 8));
            Imf::OutputFile file(output, header, 0);
            file.setFrameBuffer(frame);
            file.writePixels(2);
        }
        const Expected<Image> image = decode_image(output.take(), "a.exr");
        REQUIRE_FALSE(image);
        CHECK(image.error().to_string() ==
              "a.exr: error: expected EXR channels R, G, B or Y at full resolution, found none");
    }
}
