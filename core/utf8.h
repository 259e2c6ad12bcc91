#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cl {

/// Appends one code point as UTF-8; surrogates and values beyond U+10FFFF become U+FFFD.
void append_utf8(std::string& out, uint32_t code_point);

/// Length of the valid UTF-8 sequence at the start of `text`, 0 if the first byte starts none (or text is
/// empty).
[[nodiscard]] size_t utf8_sequence_length(std::string_view text) noexcept;

[[nodiscard]] bool is_utf8(std::string_view text) noexcept;
/// `text` with every byte that belongs to no valid sequence replaced by U+FFFD.
[[nodiscard]] std::string utf8_repaired(std::string_view text);

/// True for the second and later bytes of a sequence: what is left out when counting code points.
[[nodiscard]] constexpr bool is_utf8_continuation(char c) noexcept {
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

} // namespace cl
