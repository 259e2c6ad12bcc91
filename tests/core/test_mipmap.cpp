#include "core/image/mipmap.h"

#include <doctest/doctest.h>

#include <vector>

using namespace cl;

TEST_SUITE("core/image/mipmap") {
    TEST_CASE("a picture of one colour keeps it in every mip") {
        for (const glm::ivec2 size :
             {glm::ivec2(16, 16), glm::ivec2(13, 5), glm::ivec2(1, 7), glm::ivec2(8, 1)}) {
            Image image{size, PixelFormat::RGB8, {}};
            for (int i = 0; i < size.x * size.y; ++i) {
                image.data.insert(image.data.end(), {10, 200, 255});
            }
            for (const Image& mip : build_mips(image)) {
                for (size_t i = 0; i < mip.data.size(); ++i) {
                    CHECK(mip.data[i] == image.data[i % 3]);
                }
            }
        }
    }

    TEST_CASE("mips halve each edge, rounded down, to a single texel") {
        const Image image{{13, 5}, PixelFormat::L8, std::vector<uint8_t>(65)};
        std::vector<glm::ivec2> sizes;
        for (const Image& mip : build_mips(image)) {
            sizes.push_back(mip.size);
            CHECK(mip.data.size() == static_cast<size_t>(mip.size.x * mip.size.y));
        }
        CHECK(sizes == std::vector<glm::ivec2>{{6, 2}, {3, 1}, {1, 1}});
        CHECK(build_mips({{1, 1}, PixelFormat::L8, {5}}).empty());
    }

    TEST_CASE("a coarse texel is the mean of its own four fine texels, channel by channel") {
        const std::vector<float> fine = {0, 1, 2, 3, 10, 20, 30, 40, //
                                         4, 5, 6, 7, 50, 60, 70, 80};
        std::vector<float> coarse(4);
        downsample_half(fine, {4, 2}, 2, coarse);
        CHECK(coarse == std::vector<float>{3.0f, 4.0f, 40.0f, 50.0f});
    }

    TEST_CASE("means of bytes are rounded to nearest") {
        const std::vector<uint8_t> fine = {0, 1, 255, 254, //
                                           0, 0, 255, 255};
        std::vector<uint8_t> coarse(2);
        downsample_half(fine, {4, 2}, 1, coarse);
        CHECK(coarse == std::vector<uint8_t>{0, 255}); // 0.25 and 254.75

        std::vector<uint8_t> column(4);
        downsample_half(std::vector<uint8_t>{1, 2, 3, 3, 7, 7, 8, 9}, {1, 8}, 1, column);
        CHECK(column == std::vector<uint8_t>{2, 3, 7, 9}); // 1.5, 3, 7, 8.5
    }

    TEST_CASE("the mean of an image with even edges is the mean of its mip") {
        Image image{{8, 4}, PixelFormat::RF, std::vector<uint8_t>(8 * 4 * sizeof(float))};
        float sum = 0.0f;
        float next = 0.5f;
        for (float& v : image.floats()) {
            v = next;
            next = next * 3.0f - static_cast<float>(static_cast<int>(next * 3.0f)) + 0.25f;
            sum += v;
        }
        const std::vector<Image> mips = build_mips(image);
        CHECK(mips[0].floats()[0] == doctest::Approx(0.25f * (image.floats()[0] + image.floats()[1] +
                                                              image.floats()[8] + image.floats()[9])));
        CHECK(mips[1].floats().size() == 2);
        CHECK(0.5f * (mips[1].floats()[0] + mips[1].floats()[1]) == doctest::Approx(sum / 32.0f));
    }
}
