// Tags and assignments: the file level of the text format.

#include "tests/core/variant_text.h"

#include <doctest/doctest.h>

namespace cl::tests {
namespace {

TextTag first_tag(std::string_view text, TagSyntax syntax = TagSyntax::Fields) {
    VariantReader reader(text, "f");
    const Expected<TextItem> item = reader.next_item(syntax);
    const TextTag* tag = item ? std::get_if<TextTag>(&*item) : nullptr;
    return tag ? *tag : TextTag{};
}

std::string place(const SourceLocation& where) {
    return std::to_string(where.line) + ':' + std::to_string(where.column);
}

} // namespace

TEST_SUITE("core/variant/variant_parser tags") {
    TEST_CASE("a tag has a name and fields without commas, with values of any kind and their places") {
        const TextTag tag =
            first_tag("\n [node name=\"A\" index = 3 groups=[\n\"g\",\n] binds= [ 1, \"x\" ]]");
        CHECK(tag.name == "node");
        CHECK(place(tag.where) == "2:2");
        REQUIRE(tag.fields.size() == 4);
        CHECK(tag.fields[0].value == Variant("A"));
        CHECK(place(tag.fields[0].where) == "2:8");
        CHECK(place(tag.fields[0].value_where) == "2:13");
        CHECK(tag.find("index")->value == Variant(3));
        CHECK(tag.find("groups")->value == Variant(Array{"g"}));
        CHECK(place(tag.find("binds")->where) == "4:3");
        CHECK(tag.find("binds")->value == Variant(Array{1, "x"}));
        CHECK(tag.find("parent") == nullptr);
        CHECK(tag.where.file == "f");
        CHECK(tag.raw.starts_with("[node name"));
        CHECK(tag.raw.ends_with("\"x\" ]]"));
    }

    TEST_CASE("of a repeated field the last counts") {
        CHECK(first_tag("[a x=1 x=2]").find("x")->value == Variant(2));
    }

    TEST_CASE("names may have parts, and comments may stand inside a tag") {
        CHECK(first_tag("[a.b:c]").name == "a.b:c");
        CHECK(first_tag("[ node ; c ]\n x=1 ]").find("x")->value == Variant(1));
    }

    TEST_CASE("headings of settings files are taken as they stand") {
        CHECK(first_tag("[editor/plugins x]", TagSyntax::Heading).name == "editor/plugins x");
    }

    TEST_CASE("damaged tags are located errors") {
        CHECK(remarks_of("[") == "1:2: error: expected the name of a tag, found end of text\n");
        CHECK(remarks_of("[]") == "1:2: error: expected the name of a tag, found ']'\n");
        CHECK(remarks_of("[a.]") == "1:4: error: expected the name of a tag, found ']'\n");
        CHECK(remarks_of("[node") ==
              "1:6: error: expected a field or ']' in tag [node], found end of text\n");
        CHECK(remarks_of("[node \"x\"]") ==
              "1:7: error: expected a field or ']' in tag [node], found string \"x\"\n");
        CHECK(remarks_of("[node name]") ==
              "1:11: error: expected '=' after field 'name' of tag [node], found ']'\n");
        CHECK(remarks_of("[node name=]") == "1:12: error: expected a value, found ']'\n");
        CHECK(remarks_of("[node name=\"A\", x=1]") ==
              "1:15: error: expected a field or ']' in tag [node], found ','\n");
        VariantReader reader("[abc", "");
        CHECK(reader.next_item(TagSyntax::Heading).error().to_string() ==
              "1:5: error: expected ']' after a section's name, found end of text");
    }
}

TEST_SUITE("core/variant/variant_parser assignments") {
    TEST_CASE("newlines have no meaning: several on a line, over lines, without blanks") {
        CHECK(assignments_of("a=1 b = 2 c=\"x\"d=5\ne\n=\n[ 1,\n2 ]\nf=Vector2(1,2)g=2") ==
              "a=1\nb=2\nc=\"x\"\nd=5\ne=[ 1, 2 ]\nf=Vector2( 1, 2 )\ng=2\n");
        CHECK(assignments_of("a=1\r\nb=2\r\n") == "a=1\nb=2\n");
        CHECK(assignments_of("a=1b=2") == "a=1\nb=2\n");
        CHECK(assignments_of("") == "");
        CHECK(assignments_of("\n;only a comment") == "");
    }

    TEST_CASE("keys are all characters above the blank up to '=', quoted keys are taken whole") {
        CHECK(assignments_of(
                  "material/0=1\nsurface_1/material=2\n__meta__=3\na:b=4\nc.d=5\ne{=6\na[0]=7\nb]=8") ==
              "material/0=1\nsurface_1/material=2\n__meta__=3\na:b=4\nc.d=5\ne{=6\na[0]=7\nb]=8\n");
        CHECK(assignments_of("\"my key\" = 1\n\"a\\\"b\"=2\nx\"y\"=3\n\"q\"z=4\n\"a;b\"=5") ==
              "my key=1\na\"b=2\ny=3\nqz=4\na;b=5\n");
        CHECK(assignments_of("caf\xc3\xa9=1") == "caf\xc3\xa9=1\n");
    }

    TEST_CASE("comments may stand before, within and behind a key, '#' starts none") {
        CHECK(assignments_of(";x\nb ;x=y\n=2\n ; z\nc=3;end") == "b=2\nc=3\n");
        CHECK(assignments_of("# comment\na=1\nb=2") == "#commenta=1\nb=2\n");
    }

    TEST_CASE("white space inside a key is dropped, with a remark") {
        CHECK(assignments_of("tonemap exposure = 2") == "tonemapexposure=2\n");
        CHECK(remarks_of("tonemap exposure = 2") ==
              "1:1: warning: expected a property name without gaps, found one read as 'tonemapexposure'\n");
        CHECK(remarks_of("exposure = 2") == "");
    }

    TEST_CASE("places of keys and values are given, and the value as written") {
        VariantReader reader("a = 1\n  bc =\n Vector2( 1,2 ) ; c", "f");
        static_cast<void>(reader.next_item());
        const Expected<TextItem> item = reader.next_item();
        REQUIRE(item.has_value());
        const auto* assignment = std::get_if<TextAssignment>(&*item);
        REQUIRE(assignment);
        CHECK(place(assignment->where) == "2:3");
        CHECK(place(assignment->value_where) == "3:2");
        CHECK(assignment->raw == "Vector2( 1,2 )");
    }

    TEST_CASE("what Godot glues to the next key is dropped instead, so that the next assignment is kept") {
        CHECK(assignments_of("a=0x10\nb=2") == "a=0\nb=2\n");
        CHECK(assignments_of("a=1.5.6\nb=2") == "a=1.5\nb=2\n");
        CHECK(assignments_of("a=inf.0\nb=2") == "a=inf\nb=2\n");
        CHECK(assignments_of("a=--5\nb=2") == "a=0\nb=2\n");
        CHECK(assignments_of("a=1E1\nb=-inf\nc=2") == "a=10.0\nb=-1e400\nc=2\n");
        CHECK(remarks_of("\na=0x10\nb=2") ==
              "2:3: warning: expected a number, found one followed by 'x10', which is left out\n");
    }

    TEST_CASE("oddities that are read nevertheless are remarked") {
        CHECK(remarks_of("a=99999999999999999999") == "1:3: warning: expected an integer of 64 bits, found "
                                                      "99999999999999999999: 9223372036854775807 is taken\n");
        CHECK(remarks_of("a=[ - ]") == "1:5: warning: expected digits after '-', found none: 0 is taken\n");
        CHECK(remarks_of("a=#12345") ==
              "1:3: warning: expected a colour of 3, 4, 6 or 8 digits, found '#12345': black is taken\n");
        CHECK(remarks_of("=1") == "1:1: warning: expected a property name, found '='\n");
    }

    TEST_CASE("damaged assignments are located errors") {
        CHECK(remarks_of("abc") == "1:4: error: expected '=' after 'abc', found end of text\n");
        CHECK(remarks_of("a =") == "1:4: error: expected a value, found end of text\n");
        CHECK(remarks_of("a = \nb = 2") == "2:1: error: expected a value, found identifier 'b'\n");
        CHECK(remarks_of("a == 1") == "1:4: error: expected a value, found '='\n");
        CHECK(remarks_of("\"abc = 1") ==
              "1:1: error: expected a closing '\"' for this string, found end of text\n");
    }
}

} // namespace cl::tests
