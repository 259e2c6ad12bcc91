#pragma once

#include "core/image.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cl {

// One file format each; the contract is that of decode_image(). The caller has looked at the first bytes.
[[nodiscard]] Expected<Image> decode_png(std::span<const uint8_t> bytes, std::string_view name);
[[nodiscard]] Expected<Image> decode_jpeg(std::span<const uint8_t> bytes, std::string_view name);
[[nodiscard]] Expected<Image> decode_hdr(std::span<const uint8_t> bytes, std::string_view name);
[[nodiscard]] Expected<Image> decode_exr(std::span<const uint8_t> bytes, std::string_view name);

/// @return Unsupported for float formats.
[[nodiscard]] Expected<std::vector<uint8_t>> encode_png(const Image& image);
/// @return Unsupported for 8-bit formats.
[[nodiscard]] Expected<std::vector<uint8_t>> encode_exr(const Image& image);

/// ParseError naming the file: `name: error: damaged PNG: <what>`.
[[nodiscard]] Error damaged_image(std::string_view name, std::string_view kind, std::string_view what);

/// An image of the claimed size with all its data, zeroed.
/// @param least_bytes  the fewest bytes that a file of this format needs for so many pixels
/// @param file_bytes   how many it has
/// @return OutOfMemory beyond the limits of image.h; ParseError for no pixels or for too few bytes.
[[nodiscard]] Expected<Image> allocate_image(int64_t width, int64_t height, PixelFormat format,
                                             std::string_view name, uint64_t least_bytes,
                                             uint64_t file_bytes);

/// InvalidArgument if the data does not fill the size.
[[nodiscard]] Status check_image_data(const Image& image);

} // namespace cl
