// Godot's cubic resize (spec gi-bake section 3), which decides what a textured surface looks like to a bake.
#include "servers/gi/voxelizer.h"

#include "core/assert.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cl::gi {

namespace {

constexpr int kTaps = 4; ///< source texels -1, 0, 1, 2 around the place

double kernel(double x) {
    x = std::abs(x);
    if (x <= 1.0) {
        return (1.5 * x - 2.5) * x * x + 1.0;
    }
    if (x < 2.0) {
        return ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0;
    }
    return 0.0;
}

/// The four source texels of a target texel along one axis, and their weights.
struct Taps {
    std::array<int, kTaps> source;
    std::array<double, kTaps> weight;
};

Taps taps_at(int target, int source_size, int target_size) {
    const double factor = double(source_size) / double(target_size);
    const double place = target * factor - 0.5; // no half-texel term on the target's side: content shifts
    const int whole = int(place); // toward zero, so that the fraction is negative at the first texel
    const double fraction = place - whole;
    Taps taps{};
    for (int i = 0; i < kTaps; ++i) {
        const int n = i - 1;
        taps.source[size_t(i)] = std::clamp(whole + n, 0, source_size - 1);
        taps.weight[size_t(i)] = kernel(fraction - n);
    }
    return taps;
}

using double2 = double __attribute__((vector_size(16)));

/// The weighted sum of 4 x 4 source texels, row after row.
template <size_t channels>
std::array<double, 4> weighted_sum(const Image& image, const Taps& rows, const Taps& columns) {
    double2 red_green{}, blue_alpha{};
    for (size_t n = 0; n < kTaps; ++n) {
        const uint8_t* row = image.data.data() + size_t(rows.source[n]) * size_t(image.size.x) * channels;
        for (size_t m = 0; m < kTaps; ++m) {
            const uint8_t* texel = row + size_t(columns.source[m]) * channels;
            const double alpha = channels == 4 ? double(texel[3]) : 255.0;
            const double weight = rows.weight[n] * columns.weight[m];
            red_green += double2{double(texel[0]), double(texel[1])} * weight;
            blue_alpha += double2{double(texel[2]), alpha} * weight;
        }
    }
    return {red_green[0], red_green[1], blue_alpha[0], blue_alpha[1]};
}

uint8_t rounded_byte(double sum) {
    const float v = float(sum);
    return uint8_t(std::clamp(int(v < 0.0f ? v - 0.5f : v + 0.5f), 0, 255));
}

} // namespace

Image resize_cubic_rgba8(const Image& image, glm::ivec2 size) {
    CL_ASSERT(image.format == PixelFormat::RGBA8 || image.format == PixelFormat::RGB8, "bytes of a colour");
    CL_ASSERT(image.size.x > 0 && image.size.y > 0, "an image with pixels");
    CL_ASSERT(size.x > 0 && size.y > 0, "a size to resize to");
    Image out;
    out.size = size;
    out.format = PixelFormat::RGBA8;
    out.data.resize(size_t(size.x) * size_t(size.y) * 4);
    std::vector<Taps> columns;
    columns.reserve(size_t(size.x));
    for (int x = 0; x < size.x; ++x) {
        columns.push_back(taps_at(x, image.size.x, size.x));
    }
    uint8_t* texel = out.data.data();
    for (int y = 0; y < size.y; ++y) {
        const Taps rows = taps_at(y, image.size.y, size.y);
        for (const Taps& column : columns) {
            const auto sum = image.format == PixelFormat::RGBA8 ? weighted_sum<4>(image, rows, column)
                                                                : weighted_sum<3>(image, rows, column);
            for (const double channel : sum) {
                *texel++ = rounded_byte(channel);
            }
        }
    }
    return out;
}

} // namespace cl::gi
