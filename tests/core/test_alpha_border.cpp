#include "core/image/alpha_border.h"

#include <doctest/doctest.h>

#include <array>

using namespace cl;

namespace {

using Pixel = std::array<uint8_t, 4>;

struct Canvas {
    Image image;
    explicit Canvas(glm::ivec2 size) {
        image.size = size;
        for (int i = 0; i < size.x * size.y; ++i) {
            image.data.insert(image.data.end(), {1, 2, 3, 0});
        }
    }
    void set(int x, int y, const Pixel& p) {
        std::copy(p.begin(), p.end(), image.data.begin() + std::ptrdiff_t(y * image.size.x + x) * 4);
    }
};

Pixel at(const Image& image, int x, int y) {
    const size_t i = (size_t(y) * size_t(image.size.x) + size_t(x)) * 4;
    return {image.data[i], image.data[i + 1], image.data[i + 2], image.data[i + 3]};
}

} // namespace

TEST_SUITE("core/image/alpha_border") {
    TEST_CASE("an opaque pixel colours the transparent ones within four on each axis, and no alpha changes") {
        Canvas canvas({20, 20});
        canvas.set(10, 10, {50, 60, 70, 20});
        const Image fixed = with_fixed_alpha_border(canvas.image);
        for (int y = 0; y < 20; ++y) {
            for (int x = 0; x < 20; ++x) {
                const bool is_near = std::abs(x - 10) <= 4 && std::abs(y - 10) <= 4;
                const uint8_t alpha = x == 10 && y == 10 ? 20 : 0;
                CHECK(at(fixed, x, y) == (is_near ? Pixel{50, 60, 70, alpha} : Pixel{1, 2, 3, alpha}));
            }
        }
    }

    TEST_CASE("below alpha 20 a pixel gives no colour, but takes one") {
        Canvas canvas({8, 1});
        canvas.set(0, 0, {50, 60, 70, 19});
        CHECK(with_fixed_alpha_border(canvas.image).data == canvas.image.data);
        canvas.set(2, 0, {90, 91, 92, 255});
        CHECK(at(with_fixed_alpha_border(canvas.image), 0, 0) == Pixel{90, 91, 92, 19});
    }

    TEST_CASE("the nearest wins, by the straight distance; of equals the first in rows from the top") {
        Canvas canvas({9, 9});
        canvas.set(4, 1, {10, 0, 0, 255}); // 3 away
        canvas.set(6, 6, {20, 0, 0, 255}); // 2.83 away, although 4 along the axes
        CHECK(at(with_fixed_alpha_border(canvas.image), 4, 4)[0] == 20);
        canvas.set(6, 2, {30, 0, 0, 255}); // as near as the last
        CHECK(at(with_fixed_alpha_border(canvas.image), 4, 4)[0] == 30);
        canvas.set(2, 2, {40, 0, 0, 255});
        CHECK(at(with_fixed_alpha_border(canvas.image), 4, 4)[0] == 40);
    }

    TEST_CASE("images without four bytes a pixel stay as they are") {
        const Image grey{{2, 1}, PixelFormat::LA8, {5, 0, 200, 255}};
        CHECK(with_fixed_alpha_border(grey).data == grey.data);
        CHECK(with_fixed_alpha_border({}).data.empty());
    }
}
