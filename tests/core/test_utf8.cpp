#include "core/utf8.h"

#include <doctest/doctest.h>

namespace cl {
namespace {

std::string encoded(uint32_t code_point) {
    std::string out;
    append_utf8(out, code_point);
    return out;
}

} // namespace

TEST_SUITE("core/utf8") {
    TEST_CASE("every code point that is no surrogate encodes to one valid sequence") {
        for (const uint32_t c :
             {0u, 0x7fu, 0x80u, 0x7ffu, 0x800u, 0xd7ffu, 0xe000u, 0xffffu, 0x10000u, 0x10ffffu}) {
            CAPTURE(c);
            const std::string text = encoded(c);
            CHECK(utf8_sequence_length(text) == text.size());
        }
        CHECK(encoded(0xe9) == "\xc3\xa9");
        CHECK(encoded(0x20ac) == "\xe2\x82\xac");
        CHECK(encoded(0x1f600) == "\xf0\x9f\x98\x80");
    }

    TEST_CASE("what is no code point becomes the replacement character") {
        CHECK(encoded(0xd800) == encoded(0xfffd));
        CHECK(encoded(0xdfff) == encoded(0xfffd));
        CHECK(encoded(0x110000) == encoded(0xfffd));
    }

    TEST_CASE("overlong, surrogate, cut and stray bytes are not UTF-8") {
        for (const std::string bad :
             {"\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80",
              "\xf8\x88\x80\x80", "\x80", "\xff", "\xc3", "\xe2\x82"}) {
            CHECK_FALSE(is_utf8(bad));
            CHECK(is_utf8(utf8_repaired("a" + bad + "b")));
        }
        CHECK(is_utf8("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80 plain"));
    }

    TEST_CASE("repairing replaces the damaged bytes one by one and keeps the rest") {
        CHECK(utf8_repaired("a\xff\xc3\xa9\xc3z") == "a\xef\xbf\xbd\xc3\xa9\xef\xbf\xbdz");
        CHECK(utf8_repaired("fine") == "fine");
    }
}

} // namespace cl
