#pragma once

#include "core/expected.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace cl {

enum class PixelFormat : uint8_t { L8, LA8, R8, RG8, RGB8, RGBA8, RF, RGF, RGBF, RGBAF };
[[nodiscard]] int channel_count(PixelFormat format) noexcept;
[[nodiscard]] int bytes_per_pixel(PixelFormat format) noexcept;
[[nodiscard]] bool is_float_format(PixelFormat format) noexcept;
/// "L8", "RGBAF", ...
[[nodiscard]] std::string_view format_name(PixelFormat format) noexcept;

/// Pixels in memory, row 0 at the top, tightly packed. 8-bit colour is sRGB-encoded as in its file, floats
/// are linear; the image does not know which, its user does.
struct Image {
    glm::ivec2 size{0};
    PixelFormat format = PixelFormat::RGBA8;
    std::vector<uint8_t> data; ///< size.x * size.y * bytes_per_pixel(format)

    [[nodiscard]] std::span<const float> floats() const; ///< the data of a float format
    [[nodiscard]] std::span<float> floats();

    /// The same picture in another format. L spreads to r, g, b; absent channels are 0 and absent alpha is 1,
    /// as a shader reads such textures; L of a colour is its Rec. 709 luma. 8-bit values are n/255 of the
    /// float's, clamped to [0, 1] and rounded, NaN as 0: no sRGB curve is applied either way.
    [[nodiscard]] Image converted_to(PixelFormat format) const;
};

/// Largest edge [pixels] and size in memory [bytes] accepted from a file.
inline constexpr int kMaxImageEdge = 16384;
inline constexpr uint64_t kMaxImageBytes = uint64_t{1} << 31;

/// Decodes PNG, JPEG, Radiance HDR or OpenEXR, told apart by their first bytes, not by name.
/// 16-bit PNGs become 8 bit, palettes become colours, and what a file says of its gamma or profile is
/// ignored. HDR and EXR give RGBF or RGBAF.
/// @return ParseError naming `name` for damaged or truncated data, Unsupported for other kinds, OutOfMemory
/// beyond
///         the limits above. A header that claims more pixels than its file can hold is refused before their
///         memory is asked for.
[[nodiscard]] Expected<Image> decode_image(std::span<const uint8_t> bytes, std::string_view name);
[[nodiscard]] Expected<Image> load_image(const std::filesystem::path& path);

/// PNG (8-bit formats) or EXR (float formats, as 32-bit float) by extension, written beside and renamed. Two
/// channels are written as three.
/// @return Unsupported for another extension or a format that it does not hold.
[[nodiscard]] Status save_image(const Image& image, const std::filesystem::path& path);

} // namespace cl
