#include "core/image.h"

#include "core/image/codecs.h"
#include "core/io/file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace cl {

namespace {

bool starts_with(std::span<const uint8_t> bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char m, uint8_t b) { return static_cast<uint8_t>(m) == b; });
}

std::string lower_case_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

Expected<std::vector<uint8_t>> encode_for(const std::string& extension, const Image& image) {
    if (extension == ".png") {
        return encode_png(image);
    }
    if (extension == ".exr") {
        return encode_exr(image);
    }
    return Error{ErrorCode::Unsupported,
                 fmt::format("expected a .png or .exr name, found \"{}\"", extension)};
}

} // namespace

int channel_count(PixelFormat format) noexcept {
    switch (format) {
    case PixelFormat::L8:
    case PixelFormat::R8:
    case PixelFormat::RF:
        return 1;
    case PixelFormat::LA8:
    case PixelFormat::RG8:
    case PixelFormat::RGF:
        return 2;
    case PixelFormat::RGB8:
    case PixelFormat::RGBF:
        return 3;
    case PixelFormat::RGBA8:
    case PixelFormat::RGBAF:
        break;
    }
    return 4;
}

bool is_float_format(PixelFormat format) noexcept {
    return format >= PixelFormat::RF;
}

int bytes_per_pixel(PixelFormat format) noexcept {
    return channel_count(format) * (is_float_format(format) ? static_cast<int>(sizeof(float)) : 1);
}

std::string_view format_name(PixelFormat format) noexcept {
    constexpr std::string_view kNames[] = {"L8",    "LA8", "R8",  "RG8",  "RGB8",
                                           "RGBA8", "RF",  "RGF", "RGBF", "RGBAF"};
    return kNames[static_cast<size_t>(format)];
}

std::span<const float> Image::floats() const {
    CL_ASSERT(is_float_format(format), "floats() of an 8-bit image");
    return {reinterpret_cast<const float*>(data.data()), data.size() / sizeof(float)};
}

std::span<float> Image::floats() {
    CL_ASSERT(is_float_format(format), "floats() of an 8-bit image");
    return {reinterpret_cast<float*>(data.data()), data.size() / sizeof(float)};
}

Expected<Image> decode_image(std::span<const uint8_t> bytes, std::string_view name) {
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) {
        return decode_png(bytes, name);
    }
    if (starts_with(bytes, "\xff\xd8\xff")) {
        return decode_jpeg(bytes, name);
    }
    if (starts_with(bytes, "#?")) {
        return decode_hdr(bytes, name);
    }
    if (starts_with(bytes, "\x76\x2f\x31\x01")) {
        return decode_exr(bytes, name);
    }
    return Error{ErrorCode::Unsupported,
                 "expected a PNG, JPEG, Radiance HDR or OpenEXR image, found another kind of data",
                 {std::string(name)}};
}

Expected<Image> load_image(const std::filesystem::path& path) {
    const Expected<std::vector<uint8_t>> bytes = read_binary_file(path);
    if (!bytes) {
        return bytes.error();
    }
    return decode_image(*bytes, path.string());
}

Status save_image(const Image& image, const std::filesystem::path& path) {
    Expected<std::vector<uint8_t>> bytes = encode_for(lower_case_extension(path), image);
    if (!bytes) {
        return Error{bytes.error().code, bytes.error().message, {path.string()}};
    }
    return write_file_atomic(path, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

} // namespace cl
