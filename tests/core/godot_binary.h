#pragma once

#include "core/variant/variant.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cl::tests {

/// The value in Godot 3's binary serialisation (its documented "binary serialization API"): 32-bit
/// little-endian words, a type word first, everything padded to four bytes. Padding is std::nullopt, since
/// Godot leaves rubbish in it. Objects are not covered.
using BinaryByte = std::optional<uint8_t>;
[[nodiscard]] std::vector<BinaryByte> encode_godot_binary(const Variant& value);

/// RFC 4648 base64, padded; empty for text that is not.
[[nodiscard]] std::vector<uint8_t> decode_base64(std::string_view text);

} // namespace cl::tests
