#include "core/variant/number_scanner.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>

namespace cl {
namespace {

ScannedNumber scan(std::string_view text) {
    return scan_number(text.data(), text.data() + text.size());
}

size_t length(std::string_view text) {
    return static_cast<size_t>(scan(text).end - text.data());
}

} // namespace

TEST_SUITE("core/variant/number_scanner") {
    TEST_CASE("digits alone are an integer, a point or an exponent makes a real") {
        CHECK(scan("0").integer == 0);
        CHECK(scan("-42").integer == -42);
        CHECK(scan("+5").integer == 5);
        CHECK_FALSE(scan("007").is_real);
        CHECK(scan("007").integer == 7);
        for (const char* real :
             {"5.", ".5", "-.5", "5.e3", "1e5", "1E5", "1e+5", "1e-5", "1e", "1e+", "0.0"}) {
            CAPTURE(real);
            CHECK(scan(real).is_real);
            CHECK(length(real) == std::string_view(real).size());
        }
        CHECK(scan("5.e3").real == 5000.0);
        CHECK(scan("-.5").real == -0.5);
        CHECK(scan("1E1").real == 10.0);
        CHECK(scan("1e").real == 1.0);
    }

    TEST_CASE("the number ends where nothing of it can follow") {
        CHECK(length("0x10") == 1);
        CHECK(length("1.5.6") == 3);
        CHECK(length("1-1") == 1);
        CHECK(length("1e5e") == 3);
        CHECK(length("12,") == 2);
        CHECK(length("") == 0);
        CHECK(length("abc") == 0);
        CHECK(length(".") == 0);
        CHECK(length("+") == 0);
        CHECK(length("+.") == 0);
        CHECK(length("-") == 1);
        CHECK(scan("-").note == ScannedNumber::Note::NoDigits);
        CHECK(scan("-.").integer == 0);
    }

    TEST_CASE("nothing at or behind the end is looked at") {
        const std::string text = "12345";
        for (size_t n = 1; n <= text.size(); n++) {
            const ScannedNumber number = scan_number(text.data(), text.data() + n);
            CHECK(number.integer == std::stoi(text.substr(0, n)));
        }
    }

    TEST_CASE("integers saturate at 64 bits and say so") {
        CHECK(scan("9223372036854775807").integer == INT64_MAX);
        CHECK(scan("9223372036854775807").note == ScannedNumber::Note::None);
        CHECK(scan("9223372036854775808").integer == INT64_MAX);
        CHECK(scan("9223372036854775808").note == ScannedNumber::Note::Saturated);
        CHECK(scan("-9223372036854775808").integer == INT64_MIN);
        CHECK(scan("-9223372036854775808").note == ScannedNumber::Note::None);
        CHECK(scan("-9223372036854775809").note == ScannedNumber::Note::Saturated);
        CHECK(scan("99999999999999999999999").integer == INT64_MAX);
        CHECK(scan("00000000000000000000000012").integer == 12);
    }

    TEST_CASE("zero keeps its sign as a real and has none as an integer") {
        CHECK(std::signbit(scan("-0.0").real));
        CHECK_FALSE(std::signbit(scan("-0").real));
    }

    TEST_CASE("reals are rounded correctly, as the C library does") {
        std::mt19937_64 random(11);
        for (int i = 0; i < 20000; i++) {
            char text[64];
            const int digits = static_cast<int>(random() % 20) + 1;
            const int exponent = static_cast<int>(random() % 120) - 60;
            const double mantissa = static_cast<double>(random() >> 11) / 9007199254740992.0;
            std::snprintf(text, sizeof text, "%.*fe%d", digits, mantissa * 100.0, exponent);
            CAPTURE(text);
            REQUIRE(scan(text).real == std::strtod(text, nullptr));
        }
        for (const char* text :
             {"0.1234567890123456789", "9007199254740993.0", "9007199254740993", "4.9e-324",
              "1.7976931348623157e308", "2.2250738585072011e-308", "123456789012345678901234567890.5",
              "0.000000000000000000000000000000000000000000000000000000001", "18446744073709551616", "8.5e22",
              "1e23"}) {
            CAPTURE(text);
            CHECK(scan(text).real == std::strtod(text, nullptr));
        }
    }

    TEST_CASE("beyond a double's range a real is infinite or zero, however long its exponent") {
        CHECK(scan("1e400").real == HUGE_VAL);
        CHECK(scan("-1e400").real == -HUGE_VAL);
        CHECK(scan("1e99999999999999999999").real == HUGE_VAL);
        CHECK(scan("1e-400").real == 0.0);
        CHECK(scan("1e-99999999999999999999").real == 0.0);
        CHECK(scan("0e99999999999999999999").real == 0.0);
        CHECK(scan(std::string(5000, '9') + ".5").real == HUGE_VAL);
        CHECK(scan("0." + std::string(5000, '0') + "1").real == 0.0);
        CHECK(scan("1" + std::string(5000, '0') + "e-5000").real == 1.0);
    }
}

} // namespace cl
