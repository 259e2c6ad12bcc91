#pragma once

#include "core/expected.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace cl {

enum class PixelFormat : uint8_t { L8, LA8, R8, RG8, RGB8, RGBA8, RF, RGF, RGBF, RGBAF };
[[nodiscard]] int channel_count(PixelFormat format) noexcept;
[[nodiscard]] int bytes_per_pixel(PixelFormat format) noexcept;

/// Pixels in memory, row 0 at the top, tightly packed. 8-bit colour is sRGB-encoded as in its file, floats are
/// linear; the image does not know which, its user does.
struct Image {
    glm::ivec2 size{0};
    PixelFormat format = PixelFormat::RGBA8;
    std::vector<uint8_t> data; ///< size.x * size.y * bytes_per_pixel(format)

    [[nodiscard]] std::span<const float> floats() const; ///< the data of a float format
    [[nodiscard]] Image converted_to(PixelFormat format) const;
};

/// Largest edge accepted from a file: an input cannot ask for more memory than this allows.
inline constexpr int kMaxImageEdge = 16384;

/// Decodes PNG, JPEG, Radiance HDR or OpenEXR, told apart by their first bytes, not by name.
/// 16-bit PNGs become 8 bit. HDR and EXR give RGBF or RGBAF.
/// @return ParseError naming `name` for damaged data, Unsupported for other kinds, OutOfMemory beyond
///         kMaxImageEdge.
[[nodiscard]] Expected<Image> decode_image(std::span<const uint8_t> bytes, std::string_view name);
[[nodiscard]] Expected<Image> load_image(const std::filesystem::path& path);

/// PNG (8-bit formats) or EXR (float formats) by extension, written beside and renamed.
[[nodiscard]] Status save_image(const Image& image, const std::filesystem::path& path);

} // namespace cl
