#include "core/variant/real_text.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

namespace cl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string real(double value, TextStyle style = TextStyle::Exact) {
    std::string out;
    append_real(out, value, style);
    return out;
}
std::string component(double value, TextStyle style = TextStyle::Exact) {
    std::string out;
    append_component(out, static_cast<float>(value), style);
    return out;
}
std::string shown(double value) {
    std::string out;
    append_shown_real(out, value);
    return out;
}

/// A float of random bits, finite.
float random_float(std::mt19937& random) {
    for (;;) {
        const uint32_t bits = static_cast<uint32_t>(random());
        float value = 0;
        std::memcpy(&value, &bits, sizeof value);
        if (std::isfinite(value)) {
            return value;
        }
    }
}

} // namespace

TEST_SUITE("core/variant/real_text") {
    TEST_CASE("both styles print a value of six digits as Godot does") {
        for (const TextStyle style : {TextStyle::Exact, TextStyle::Godot}) {
            CHECK(real(0.1, style) == "0.1");
            CHECK(real(564.0, style) == "564.0");
            CHECK(real(-0.483649, style) == "-0.483649");
            CHECK(real(1.5e-7, style) == "1.5e-07");
            CHECK(real(100000.0, style) == "100000.0");
            CHECK(real(1000000.0, style) == "1e+06");
            CHECK(real(0.0, style) == "0.0");
            CHECK(real(-0.0, style) == "0.0");
            CHECK(component(1, style) == "1");
            CHECK(component(-0.0, style) == "0");
            CHECK(component(0.5, style) == "0.5");
            CHECK(component(-8.74228e-08, style) == "-8.74228e-08");
            CHECK(component(999999, style) == "999999");
            CHECK(component(1e6, style) == "1e+06");
            CHECK(component(1e-4, style) == "0.0001");
            CHECK(component(1e-5, style) == "1e-05");
        }
    }

    TEST_CASE(
        "Godot's style rounds to six digits of a float32, exact style adds the digits that are missing") {
        CHECK(real(123456.789, TextStyle::Godot) == "123457.0");
        CHECK(real(123456.789) == "123456.789");
        CHECK(component(16777217.0, TextStyle::Godot) == "1.67772e+07");
        CHECK(component(16777216.0) == "16777216");
        CHECK(component(0.1234567, TextStyle::Godot) == "0.123457");
        CHECK(component(0.1234567) == "0.1234567");
        CHECK(real(static_cast<double>(0.1f)) == "0.1"); // came from a float: its digits are enough
    }

    TEST_CASE("exact style reads back to the same float from inside a constructor") {
        std::mt19937 random(3);
        for (int i = 0; i < 20000; i++) {
            const float value = random_float(random);
            const std::string text = component(static_cast<double>(value));
            CAPTURE(text);
            REQUIRE(static_cast<float>(std::strtod(text.c_str(), nullptr)) == value);
        }
    }

    TEST_CASE("exact style reads back to the same double unless the value is a float, then to that float") {
        std::mt19937_64 random(5);
        for (int i = 0; i < 20000; i++) {
            const double value = (static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5) *
                                 std::pow(10.0, static_cast<double>(random() % 80) - 40.0);
            const std::string text = real(value);
            CAPTURE(text);
            REQUIRE(std::strtod(text.c_str(), nullptr) == value);
        }
        std::mt19937 random_bits(6);
        for (int i = 0; i < 5000; i++) {
            const float value = random_float(random_bits);
            CHECK(static_cast<float>(std::strtod(real(static_cast<double>(value)).c_str(), nullptr)) ==
                  value);
        }
    }

    TEST_CASE("infinities are written so that Godot reads them, or as Godot writes them") {
        CHECK(real(kInfinity) == "inf");
        CHECK(real(-kInfinity) == "-1e400");
        CHECK(real(kNan) == "nan");
        CHECK(component(kInfinity) == "1e400");
        CHECK(component(-kInfinity) == "-1e400");
        CHECK(component(kNan) == "0");
        CHECK(real(-kInfinity, TextStyle::Godot) == "-inf.0");
        CHECK(component(kInfinity, TextStyle::Godot) == "inf");
        CHECK(component(-kInfinity, TextStyle::Godot) == "-inf");
        CHECK(component(kNan, TextStyle::Godot) == "nan");
        CHECK(real(1e300, TextStyle::Godot) == "inf");
        CHECK(real(1e300) == "1e+300");
    }

    TEST_CASE(
        "a shown real has six decimals without the zeros at the end, and keeps the sign of a small number") {
        CHECK(shown(564.0) == "564");
        CHECK(shown(0.0166667) == "0.016667");
        CHECK(shown(1.5e-7) == "0");
        CHECK(shown(-1.5e-7) == "-0");
        CHECK(shown(100.0) == "100");
        CHECK(shown(0.0) == "0");
        CHECK(shown(1e21) == "1000000000000000000000");
        CHECK(shown(200.134995) == "200.134995");
        CHECK(shown(-kInfinity) == "-inf");
        CHECK(shown(-kNan) == "nan");
    }
}

} // namespace cl
