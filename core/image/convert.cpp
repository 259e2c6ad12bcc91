#include "core/image.h"

#include <array>
#include <cmath>
#include <cstring>

namespace cl {

namespace {

using Texel = std::array<float, 4>;

constexpr float kLuma[3] = {0.2126f, 0.7152f, 0.0722f}; // Rec. 709

bool is_luminance(PixelFormat format) {
    return format == PixelFormat::L8 || format == PixelFormat::LA8;
}

float channel_value(const uint8_t* pixel, int channel, bool is_float) {
    if (!is_float) {
        return static_cast<float>(pixel[channel]) / 255.0f;
    }
    float value;
    std::memcpy(&value, pixel + static_cast<size_t>(channel) * sizeof(float), sizeof(float));
    return value;
}

void store_channel(uint8_t* pixel, int channel, bool is_float, float value) {
    if (is_float) {
        std::memcpy(pixel + static_cast<size_t>(channel) * sizeof(float), &value, sizeof(float));
        return;
    }
    const float clamped = value > 0.0f ? std::fmin(value, 1.0f) : 0.0f; // NaN gives 0
    pixel[channel] = static_cast<uint8_t>(std::lround(clamped * 255.0f));
}

/// The pixel as r, g, b, a.
Texel read_texel(const uint8_t* pixel, PixelFormat format) {
    const bool is_float = is_float_format(format);
    const int channels = channel_count(format);
    if (is_luminance(format)) {
        const float l = channel_value(pixel, 0, is_float);
        return {l, l, l, channels == 2 ? channel_value(pixel, 1, is_float) : 1.0f};
    }
    Texel texel{0.0f, 0.0f, 0.0f, 1.0f};
    for (int c = 0; c < channels; ++c) {
        texel[static_cast<size_t>(c)] = channel_value(pixel, c, is_float);
    }
    return texel;
}

void write_texel(const Texel& texel, uint8_t* pixel, PixelFormat format) {
    const bool is_float = is_float_format(format);
    const int channels = channel_count(format);
    if (is_luminance(format)) {
        store_channel(pixel, 0, is_float, kLuma[0] * texel[0] + kLuma[1] * texel[1] + kLuma[2] * texel[2]);
        if (channels == 2) {
            store_channel(pixel, 1, is_float, texel[3]);
        }
        return;
    }
    for (int c = 0; c < channels; ++c) {
        store_channel(pixel, c, is_float, texel[static_cast<size_t>(c)]);
    }
}

/// Bytes to bytes where each channel of the target is one of the source's or constant: no arithmetic, and the
/// bytes that the way over floats would give. @return false for other pairs of formats
bool copy_channels(const Image& from, PixelFormat to, std::vector<uint8_t>& out) {
    const bool gray = from.format == PixelFormat::L8 || from.format == PixelFormat::LA8;
    if (is_float_format(from.format) || (to != PixelFormat::RGB8 && to != PixelFormat::RGBA8)) {
        return false;
    }
    const size_t in_step = static_cast<size_t>(channel_count(from.format));
    const size_t out_step = static_cast<size_t>(channel_count(to));
    for (size_t i = 0, o = 0; o < out.size(); i += in_step, o += out_step) {
        for (size_t c = 0; c < 3; ++c) {
            out[o + c] = gray ? from.data[i] : (c < in_step ? from.data[i + c] : uint8_t{0});
        }
        if (out_step == 4) {
            const size_t alpha = gray ? 1 : 3;
            out[o + 3] = alpha < in_step ? from.data[i + alpha] : uint8_t{255};
        }
    }
    return true;
}

} // namespace

Image Image::converted_to(PixelFormat to) const {
    if (to == format) {
        return *this;
    }
    const auto from_step = static_cast<size_t>(bytes_per_pixel(format));
    const auto to_step = static_cast<size_t>(bytes_per_pixel(to));
    const size_t pixels = data.size() / from_step;
    Image out{size, to, std::vector<uint8_t>(pixels * to_step)};
    if (copy_channels(*this, to, out.data)) {
        return out;
    }
    for (size_t i = 0; i < pixels; ++i) {
        write_texel(read_texel(&data[i * from_step], format), &out.data[i * to_step], to);
    }
    return out;
}

} // namespace cl
