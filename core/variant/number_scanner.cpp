#include "core/variant/number_scanner.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace cl {
namespace {

constexpr int kMaxExactDigits = 19; // decimal digits that always fit a uint64_t
// Powers of ten that a double holds exactly.
constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int kMaxExactPower = 22;

bool is_digit(char c) noexcept {
    return c >= '0' && c <= '9';
}

/// Significant digits gathered so far; leading zeros do not count.
struct Digits {
    uint64_t mantissa = 0;
    int count = 0;    ///< more than kMaxExactDigits: the mantissa is not complete
    int exponent = 0; ///< value = mantissa * 10^exponent, as far as the mantissa is complete

    void add(char c) noexcept {
        if (count < kMaxExactDigits) {
            mantissa = mantissa * 10 + static_cast<uint64_t>(c - '0');
        }
        if (mantissa != 0 && count <= kMaxExactDigits) {
            count++;
        }
    }
};

/// Reads an exponent's digits; stops growing far beyond what any double needs.
const char* scan_exponent(const char* p, const char* last, int& exponent) noexcept {
    bool negative = false;
    if (p != last && (*p == '-' || *p == '+')) {
        negative = *p == '-';
        p++;
    }
    int value = 0;
    for (; p != last && is_digit(*p); p++) {
        value = std::min(value * 10 + (*p - '0'), 1'000'000);
    }
    exponent += negative ? -value : value;
    return p;
}

/// The value of the unsigned number text [first, last), whose digits are `digits`.
double real_value(const Digits& digits, const char* first, const char* last) noexcept {
    constexpr uint64_t kTwoPow53 = uint64_t{1} << 53;
    const bool exact = digits.count <= kMaxExactDigits && digits.mantissa <= kTwoPow53;
    // Both operands are exact, so the one rounding of * or / is the correct rounding (Clinger 1990).
    if (exact && digits.exponent >= 0 && digits.exponent <= kMaxExactPower) {
        return static_cast<double>(digits.mantissa) * kPowersOfTen[digits.exponent];
    }
    if (exact && digits.exponent < 0 && digits.exponent >= -kMaxExactPower) {
        return static_cast<double>(digits.mantissa) / kPowersOfTen[-digits.exponent];
    }
    double value = 0.0;
    fast_float::from_chars(first, last, value);
    return value;
}

void set_integer(ScannedNumber& out, const Digits& digits, bool negative) noexcept {
    const uint64_t limit = static_cast<uint64_t>(INT64_MAX) + (negative ? 1 : 0);
    const bool fits = digits.count <= kMaxExactDigits && digits.mantissa <= limit;
    const uint64_t magnitude = fits ? digits.mantissa : limit;
    out.note = fits ? ScannedNumber::Note::None : ScannedNumber::Note::Saturated;
    out.integer = static_cast<int64_t>(negative ? 0 - magnitude : magnitude);
}

} // namespace

ScannedNumber scan_number(const char* first, const char* last) noexcept {
    ScannedNumber out;
    out.end = first;
    const bool negative = first != last && *first == '-';
    const char* const start = first + (negative || (first != last && *first == '+') ? 1 : 0);
    const char* p = start;
    Digits digits;
    bool any_digit = false;
    for (; p != last && is_digit(*p); p++) {
        digits.add(*p);
        any_digit = true;
    }
    const Digits whole = digits;
    if (p != last && *p == '.' && (any_digit || (p + 1 != last && is_digit(p[1])))) {
        out.is_real = true;
        for (p++; p != last && is_digit(*p); p++) {
            digits.add(*p);
            digits.exponent--;
            any_digit = true;
        }
    }
    if (!any_digit) {
        if (negative) {
            out.end = start;
            out.note = ScannedNumber::Note::NoDigits;
        }
        return out;
    }
    if (p != last && (*p == 'e' || *p == 'E')) {
        out.is_real = true;
        p = scan_exponent(p + 1, last, digits.exponent);
    }
    out.end = p;
    out.real = real_value(digits, start, p);
    out.real = negative ? -out.real : out.real;
    if (!out.is_real) {
        set_integer(out, whole, negative);
        out.real = out.integer == 0 ? 0.0 : out.real; // an integer has no -0
    }
    return out;
}

} // namespace cl
