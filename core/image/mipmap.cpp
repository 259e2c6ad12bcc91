#include "core/image/mipmap.h"

#include <algorithm>
#include <type_traits>

namespace cl {

namespace {

uint8_t mean(uint8_t a, uint8_t b, uint8_t c, uint8_t d) {
    return static_cast<uint8_t>((a + b + c + d + 2) / 4);
}
float mean(float a, float b, float c, float d) {
    return 0.25f * (a + b + c + d);
}

template <typename T>
void downsample(std::span<const T> fine, glm::ivec2 size, int channels, std::span<T> coarse) noexcept {
    const glm::ivec2 out = half_size(size);
    // Where an edge is 1, both texels of a pair are the same one.
    const int right = size.x > 1 ? channels : 0;
    const int below = size.y > 1 ? size.x * channels : 0;
    size_t at = 0;
    for (int y = 0; y < out.y; ++y) {
        for (int x = 0; x < out.x; ++x) {
            const T* texel = fine.data() + (static_cast<size_t>(2 * y) * size.x + 2 * x) * channels;
            for (int c = 0; c < channels; ++c, ++texel) {
                coarse[at++] = mean(texel[0], texel[right], texel[below], texel[below + right]);
            }
        }
    }
}

} // namespace

glm::ivec2 half_size(glm::ivec2 size) noexcept {
    return {std::max(size.x / 2, 1), std::max(size.y / 2, 1)};
}

void downsample_half(std::span<const uint8_t> fine, glm::ivec2 size, int channels,
                     std::span<uint8_t> coarse) noexcept {
    downsample(fine, size, channels, coarse);
}

void downsample_half(std::span<const float> fine, glm::ivec2 size, int channels,
                     std::span<float> coarse) noexcept {
    downsample(fine, size, channels, coarse);
}

std::vector<Image> build_mips(const Image& image) {
    std::vector<Image> mips;
    const Image* fine = &image;
    const int channels = channel_count(image.format);
    while (fine->size.x > 1 || fine->size.y > 1) {
        Image coarse{half_size(fine->size), image.format, {}};
        coarse.data.resize(static_cast<size_t>(coarse.size.x) * coarse.size.y *
                           bytes_per_pixel(image.format));
        if (is_float_format(image.format)) {
            downsample_half(fine->floats(), fine->size, channels, coarse.floats());
        } else {
            downsample_half(std::span<const uint8_t>(fine->data), fine->size, channels,
                            std::span(coarse.data));
        }
        mips.push_back(std::move(coarse));
        fine = &mips.back(); // looked at again before the next push_back moves it
    }
    return mips;
}

} // namespace cl
