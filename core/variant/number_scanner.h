#pragma once

#include <cstdint>

namespace cl {

/// A number as the text format spells it (tscn format, section 2), and the forms beyond it that we accept: a
/// leading '+', ".5", an upper-case 'E'.
struct ScannedNumber {
    enum class Note : uint8_t {
        None,
        Saturated, ///< an integer beyond 64 bits: its nearest int64
        NoDigits,  ///< a '-' alone, which Godot reads as 0
    };
    const char* end = nullptr; ///< first character after the number; the start if there is no number
    bool is_real = false;      ///< it has a '.' or an exponent
    Note note = Note::None;
    int64_t integer = 0; ///< if !is_real
    double real = 0.0;   ///< the value, correctly rounded, for integers too; infinite beyond double's range
};

/// Reads the longest number at `first`; looks at nothing at or after `last`. Independent of the locale.
/// "1e", "1e+" and "1." are 1.0, "0x10" is 0 followed by "x10", as in Godot.
[[nodiscard]] ScannedNumber scan_number(const char* first, const char* last) noexcept;

} // namespace cl
