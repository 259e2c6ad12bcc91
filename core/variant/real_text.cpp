#include "core/variant/real_text.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

namespace cl {
namespace {

constexpr int kGodotDigits = 6;

/// True and appended if the value is not finite: `infinity` or `minus_infinity`, or "nan".
bool append_if_not_finite(std::string& out, double value, std::string_view infinity,
                          std::string_view minus_infinity) {
    if (std::isfinite(value)) {
        return false;
    }
    out += std::isnan(value) ? "nan" : value > 0.0 ? infinity : minus_infinity;
    return true;
}

/// printf's %g with the fewest digits, but at least Godot's six, that read back as `value`.
template <typename Real>
void append_exact(std::string& out, Real value) {
    const size_t start = out.size();
    for (int digits = kGodotDigits;; digits++) {
        out.resize(start);
        fmt::format_to(std::back_inserter(out), "{:.{}g}", value, digits);
        Real back = 0;
        fast_float::from_chars(out.data() + start, out.data() + out.size(), back);
        if (back == value || digits >= std::numeric_limits<Real>::max_digits10) {
            return;
        }
    }
}

void append_finite(std::string& out, double value, TextStyle style) {
    const float rounded = static_cast<float>(value);
    if (style == TextStyle::Godot) {
        fmt::format_to(std::back_inserter(out), "{:.{}g}", rounded, kGodotDigits);
    } else if (static_cast<double>(rounded) == value) {
        append_exact(out, rounded); // most reals end in a float property: its digits, not the double's
    } else {
        append_exact(out, value);
    }
}

} // namespace

void append_real(std::string& out, double value, TextStyle style) {
    const bool godot = style == TextStyle::Godot;
    const double shown = godot ? static_cast<double>(static_cast<float>(value)) : value;
    if (append_if_not_finite(out, shown, "inf", godot ? "-inf.0" : "-1e400")) {
        return;
    }
    if (shown == 0.0) { // also -0
        out += "0.0";
        return;
    }
    const size_t start = out.size();
    append_finite(out, shown, style);
    if (out.find_first_of(".e", start) == std::string::npos) {
        out += ".0";
    }
}

void append_component(std::string& out, float value, TextStyle style) {
    if (style == TextStyle::Exact && std::isnan(value)) {
        value = 0.0f;
    }
    // Short cut (and -0 as "0"): most numbers of a scene are small and whole.
    if (std::abs(value) < 1e6f && value == std::trunc(value)) {
        fmt::format_to(std::back_inserter(out), "{}", static_cast<int>(value));
        return;
    }
    const bool godot = style == TextStyle::Godot;
    if (!append_if_not_finite(out, value, godot ? "inf" : "1e400", godot ? "-inf" : "-1e400")) {
        append_finite(out, value, style);
    }
}

void append_shown_real(std::string& out, double value) {
    if (append_if_not_finite(out, value, "inf", "-inf")) {
        return;
    }
    fmt::format_to(std::back_inserter(out), "{:.6f}", value);
    const size_t last = out.find_last_not_of('0'); // stops at the point, if not before
    out.resize(out[last] == '.' ? last : last + 1);
}

} // namespace cl
