// Hostile input: nesting bombs, truncation, rubbish. Nothing may crash, hang or take memory that the input
// does not justify.

#include "tests/core/variant_text.h"
#include "tests/shared_dir.h"

#include "core/object/class_registry.h"

#include <doctest/doctest.h>

#include <random>

namespace cl::tests {
namespace {

std::string repeated(std::string_view part, size_t times) {
    std::string out;
    for (size_t i = 0; i < times; i++) {
        out += part;
    }
    return out;
}

// A text with every construct of the format.
constexpr std::string_view kEverything =
    "\xef\xbb\xbf[gd_scene load_steps=2 format=2] ; comment\n"
    "[node name=\"A\\n\\u00e9\" groups=[ \"g\", ] x=1]\n"
    "a = Transform( 1, 0, 0, 0, 1, 0, 0, 0, 1, .5, -1e-3, +2 )\n"
    "material/0 = { \"k\": [ 1, 2.5, null, true, inf ], Vector2( 1, 2 ): #80ff8040, }\n"
    "\"quoted key\" = PoolIntArray( 1, -2, 3.7, 99999999999 )\n"
    "b = PoolVector3Array( 1, 2, 3, 4 ) c = PoolStringArray( \"a\", \"b\" )\n"
    "d = Object( Foo, \"p\": InputEvent( KEY, 65, S ), \"q\": NodePath( \"A/B:c\" ) )\n"
    "e = ExtResource( 1 ) f = SubResource( 2 ) g = Resource( \"res://x\" ) h = RID( 3 )\n"
    "i = PoolColorArray( 0.1, 0.2, 0.3, 1 ) j = 0x10\nk = -inf\n";

/// Reads all items of `text`; returns how many there are before its end or its first error.
size_t read_all(std::string_view text) {
    VariantReadOptions options;
    Diagnostics diagnostics;
    options.diagnostics = &diagnostics;
    options.ext_resource = options.sub_resource = [](int64_t) -> Expected<Variant> { return Variant(); };
    options.resource = [](const std::string&) -> Expected<Variant> { return Variant(); };
    VariantReader reader(text, "fuzz", options);
    size_t count = 0;
    for (;;) {
        const Expected<TextItem> item = reader.next_item();
        if (!item) {
            CHECK(item.error().where.line > 0);
            CHECK(item.error().where.column > 0);
            CHECK(item.error().message.size() < 300);
            return count;
        }
        if (std::holds_alternative<std::monostate>(*item)) {
            return count;
        }
        if (const auto* assignment = std::get_if<TextAssignment>(&*item)) {
            static_cast<void>(variant_to_text(assignment->value));
            static_cast<void>(variant_to_str(assignment->value));
        }
        count++;
    }
}

} // namespace

TEST_SUITE("core/variant/variant_parser limits") {
    TEST_CASE("values nest 256 deep and no deeper, of whatever kind") {
        CHECK(error_of(repeated("[", 256) + repeated("]", 256)) == "no error");
        CHECK(error_of(repeated("[", 257) + repeated("]", 257)) ==
              "1:257: error: expected at most 256 nested values, found more");
        for (const std::string_view part : {"[", "{", "{1:", "[{1:[", "Object(A,\"p\":"}) {
            CAPTURE(part);
            const std::string error = error_of(repeated(part, 100'000));
            CHECK(error.find("expected at most 256 nested values, found more") != std::string::npos);
        }
        const std::string deepest = repeated("{1:", 255) + "0" + repeated("}", 255);
        CHECK(variant_to_text(read(deepest)).size() > 255);
        CHECK(variant_to_str(read(deepest)).size() > 255);
    }

    TEST_CASE("deeply nested keys are hashed, compared and printed") {
        const std::string key = repeated("{", 200) + "1" + repeated(":0}", 200);
        std::string text = "{";
        for (int i = 0; i < 20; i++) {
            text += key + ":" + std::to_string(i) + ",";
        }
        const Variant value = read(text + "}");
        REQUIRE(value.get_if<Dictionary>());
        CHECK(value.get_if<Dictionary>()->size() == 1);
        CHECK(variant_to_str(value).size() > 200);
    }

    TEST_CASE("claims of huge sizes are just numbers or missing input") {
        CHECK(error_of("PoolByteArray( 1000000000") ==
              "1:26: error: PoolByteArray: expected ',' or ')', found end of text");
        CHECK(error_of("PoolVector3Array(1000000000)") == "no error");
        CHECK(error_of("[1000000000") == "1:12: error: expected ',' or ']' in an array, found end of text");
        CHECK(remarks_of("[gd_scene load_steps=1000000000 format=2]") == "");
    }

    TEST_CASE("an array takes memory for its elements, not for commas elsewhere") {
        const Variant value = read("[ PoolByteArray( 1 ;" + repeated(",", 100'000) + ")\n), 2 ]");
        REQUIRE(value.get_if<Array>());
        CHECK((*value.get_if<Array>())[0] == Variant(PoolByteArray({1})));
    }

    TEST_CASE("dictionaries of many like keys stay quick") {
        // 20,000 different arrays, dictionaries and not-a-numbers as keys: seconds, if look-up were one by
        // one.
        std::string text = "{";
        for (int i = 0; i < 20'000; i++) {
            const std::string n = std::to_string(i);
            text += "[" + n + "]:0,{" + n + ":1}:0,Vector2(nan," + n + "):0,nan:" + n + ",\n";
        }
        const Variant value = read(text + "}");
        REQUIRE(value.get_if<Dictionary>());
        CHECK(value.get_if<Dictionary>()->size() == 60'001);
    }

    TEST_CASE("every truncation of a file of everything is read or refused with a place") {
        register_core_types(ClassRegistry::instance());
        const size_t all = read_all(kEverything);
        CHECK(all == 15);
        for (size_t n = 0; n < kEverything.size(); n++) {
            CHECK(read_all(kEverything.substr(0, n)) <= all);
        }
    }

    TEST_CASE("a file of everything with bytes changed, dropped or doubled is read or refused") {
        register_core_types(ClassRegistry::instance());
        std::mt19937 random(20);
        constexpr std::string_view kBytes = "[]{}()\"\\=:,.;#-+eE019 \nxu\xc3\xff";
        for (int i = 0; i < 4000; i++) {
            std::string text(kEverything);
            for (int change = 0; change < 4; change++) {
                const size_t at = random() % text.size();
                switch (random() % 4) {
                case 0:
                    text[at] = kBytes[random() % kBytes.size()];
                    break;
                case 1:
                    text[at] = static_cast<char>(random());
                    break;
                case 2:
                    text.erase(at, random() % 20);
                    break;
                default:
                    text.insert(at, text.substr(random() % text.size(), random() % 40));
                }
            }
            read_all(text);
        }
    }

    TEST_CASE("random bytes and random tokens are read or refused") {
        register_core_types(ClassRegistry::instance());
        std::mt19937 random(21);
        const std::vector<std::string_view> tokens = {"[",
                                                      "]",
                                                      "{",
                                                      "}",
                                                      "(",
                                                      ")",
                                                      ":",
                                                      ",",
                                                      ".",
                                                      "=",
                                                      "\"a\"",
                                                      "\"",
                                                      "1",
                                                      "-",
                                                      "2.5",
                                                      "e",
                                                      "inf",
                                                      "nan",
                                                      "true",
                                                      "Vector2",
                                                      "PoolIntArray",
                                                      "PoolStringArray",
                                                      "Object",
                                                      "InputEvent",
                                                      "KEY",
                                                      "NodePath",
                                                      "#fff",
                                                      ";",
                                                      "\n",
                                                      " ",
                                                      "ExtResource",
                                                      "RID",
                                                      "Transform",
                                                      "null",
                                                      "\\u",
                                                      "+"};
        for (int i = 0; i < 4000; i++) {
            std::string bytes, text;
            for (size_t n = random() % 60; n > 0; n--) {
                bytes += static_cast<char>(random());
                text += tokens[random() % tokens.size()];
            }
            read_all(bytes);
            read_all(text);
            read_all("a = " + text);
        }
    }

    TEST_CASE("what is read from a changed file is written so that it reads back to the same text") {
        register_core_types(ClassRegistry::instance());
        std::mt19937 random(22);
        int compared = 0;
        for (int i = 0; i < 2000; i++) {
            std::string text(kEverything);
            text[random() % text.size()] = static_cast<char>(random());
            VariantReadOptions options;
            options.ext_resource =
                options.sub_resource = [](int64_t) -> Expected<Variant> { return Variant(); };
            VariantReader reader(text, "", options);
            for (;;) {
                const Expected<TextItem> item = reader.next_item();
                const auto* assignment = item ? std::get_if<TextAssignment>(&*item) : nullptr;
                if (assignment) {
                    const std::string written = variant_to_text(assignment->value);
                    CHECK(variant_to_text(read(written)) == written);
                    compared++;
                }
                if (!item || std::holds_alternative<std::monostate>(*item)) {
                    break;
                }
            }
        }
        CHECK(compared > 1000);
    }
}

} // namespace cl::tests
