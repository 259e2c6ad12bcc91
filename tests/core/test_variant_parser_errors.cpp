#include "tests/core/variant_text.h"

#include <doctest/doctest.h>

namespace cl::tests {

TEST_SUITE("core/variant/variant_parser errors") {
    TEST_CASE("what is no value is named with its place") {
        CHECK(error_of("") == "1:1: error: expected a value, found end of text");
        CHECK(error_of(" \n ; c\n  ") == "3:3: error: expected a value, found end of text");
        CHECK(error_of("@") == "1:1: error: expected a value, found '@'");
        CHECK(error_of("'x'") == "1:1: error: expected a value, found '''");
        CHECK(error_of("abc") == "1:1: error: expected a value, found identifier 'abc'");
        CHECK(error_of("NULL") == "1:1: error: expected a value, found identifier 'NULL'");
        CHECK(error_of("Foo( 1 )") == "1:1: error: expected a value, found unknown constructor 'Foo'");
        CHECK(error_of(")") == "1:1: error: expected a value, found ')'");
        CHECK(error_of("+") == "1:1: error: expected a value, found '+'");
    }

    TEST_CASE("arrays say what may follow an element") {
        CHECK(error_of("[ 1 2 ]") == "1:5: error: expected ',' or ']' in an array, found number 2");
        CHECK(error_of("[ 1,, 2 ]") == "1:5: error: expected a value, found ','");
        CHECK(error_of("[ ,") == "1:3: error: expected a value, found ','");
        CHECK(error_of("[ 1") == "1:4: error: expected ',' or ']' in an array, found end of text");
        CHECK(error_of("[ 1,\n") == "2:1: error: expected a value, found end of text");
        CHECK(error_of("[1-1]") == "1:3: error: expected ',' or ']' in an array, found number -1");
        CHECK(error_of("[0x10]") == "1:3: error: expected ',' or ']' in an array, found 'x10'");
    }

    TEST_CASE("dictionaries say what is missing") {
        CHECK(error_of("{ \"a\" 1 }") == "1:7: error: expected ':' after a dictionary's key, found number 1");
        CHECK(error_of("{ \"a\": }") == "1:8: error: expected a value, found '}'");
        CHECK(error_of("{ a: 1 }") == "1:3: error: expected a value, found identifier 'a'");
        CHECK(error_of("{ \"a\": 1 \"b\": 2 }") ==
              "1:10: error: expected ',' or '}' in a dictionary, found string \"b\"");
        CHECK(error_of("{\n\"a\": 1") ==
              "2:7: error: expected ',' or '}' in a dictionary, found end of text");
        CHECK(error_of("{,}") == "1:2: error: expected a value, found ','");
    }

    TEST_CASE("constructors count their numbers") {
        CHECK(error_of("Vector3( 1, 2 )") == "1:15: error: Vector3: expected 3 numbers, found 2");
        CHECK(error_of("Vector3( 1, 2, 3, 4 )") == "1:17: error: Vector3: expected 3 numbers, found more");
        CHECK(error_of("Vector3( 1, 2, 3, )") == "1:17: error: Vector3: expected 3 numbers, found more");
        CHECK(error_of("Color( 1, 2, 3 )") == "1:16: error: Color: expected 4 numbers, found 3");
        CHECK(error_of("Vector3( )") == "1:10: error: Vector3: expected a number, found ')'");
        CHECK(error_of("Vector3( \"a\", 2, 3 )") ==
              "1:10: error: Vector3: expected a number, found string \"a\"");
        CHECK(error_of("Vector3( true, 2, 3 )") == "1:10: error: Vector3: expected a number, found 'true'");
        CHECK(error_of("Vector3( 1; 2, 3 )") == "1:19: error: Vector3: expected ',', found end of text");
        CHECK(error_of("Vector3( 1 2 )") == "1:12: error: Vector3: expected ',', found number 2");
        CHECK(error_of("Vector2( 0x10, 1 )") == "1:11: error: Vector2: expected ',', found 'x10'");
        CHECK(error_of("Vector2( 1, 2") == "1:14: error: Vector2: expected ')', found end of text");
        CHECK(error_of("Vector2") == "1:8: error: Vector2: expected '(', found end of text");
        CHECK(error_of("Matrix32( 1 )") == "1:13: error: Matrix32: expected 6 numbers, found 1");
        CHECK(error_of("RID( )") == "1:6: error: RID: expected a number, found ')'");
    }

    TEST_CASE("pool arrays name the constructor and the place inside a long list") {
        CHECK(error_of("PoolIntArray( 1, )") == "1:18: error: PoolIntArray: expected a number, found ')'");
        CHECK(error_of("PoolIntArray( , )") == "1:15: error: PoolIntArray: expected a number, found ','");
        CHECK(error_of("PoolIntArray( 1 2 )") ==
              "1:17: error: PoolIntArray: expected ',' or ')', found number 2");
        CHECK(error_of("PoolIntArray( 1, \"a\" )") ==
              "1:18: error: PoolIntArray: expected a number, found string \"a\"");
        CHECK(error_of("PoolByteArray( 1,\n2,\n3x )") ==
              "3:2: error: PoolByteArray: expected ',' or ')', found 'x'");
        CHECK(error_of("PoolRealArray( 1.5, true )") ==
              "1:21: error: PoolRealArray: expected a number, found 'true'");
        CHECK(error_of("PoolIntArray( 1, 2") ==
              "1:19: error: PoolIntArray: expected ',' or ')', found end of text");
        CHECK(error_of("PoolIntArray( 1,") ==
              "1:17: error: PoolIntArray: expected a number, found end of text");
        CHECK(error_of("PoolIntArray(") == "1:14: error: PoolIntArray: expected a number, found end of text");
        CHECK(error_of("PoolIntArray 1") == "1:14: error: PoolIntArray: expected '(', found number 1");
        CHECK(error_of("PoolStringArray( 1 )") ==
              "1:18: error: PoolStringArray: expected a string, found number 1");
        CHECK(error_of("PoolStringArray( \"a\" \"b\" )") ==
              "1:22: error: PoolStringArray: expected ',' or ')', found string \"b\"");
        CHECK(error_of("PoolStringArray( \"a\", , )") ==
              "1:23: error: PoolStringArray: expected a string, found ','");
        CHECK(error_of("PoolIntArray( \"a") ==
              "1:15: error: expected a closing '\"' for this string, found end of text");
    }

    TEST_CASE("constructors that take no numbers say what they take") {
        CHECK(error_of("NodePath( a )") == "1:11: error: NodePath: expected a string, found 'a'");
        CHECK(error_of("NodePath( \"a\"") == "1:14: error: NodePath: expected ')', found end of text");
        CHECK(error_of("Resource( 1 )") == "1:11: error: Resource: expected a string, found number 1");
        CHECK(error_of("ExtResource( \"1\" )") ==
              "1:14: error: ExtResource: expected an integer, found string \"1\"");
        CHECK(error_of("SubResource( 1.5 )") ==
              "1:14: error: SubResource: expected an integer, found number 1.5");
        CHECK(error_of("Object( )") == "1:9: error: Object: expected a class name, found ')'");
        CHECK(error_of("Object( Foo 1 )") == "1:13: error: Object: expected ',' or ')', found number 1");
        CHECK(error_of("Object( Foo, 1: 2 )") ==
              "1:14: error: Object: expected a property name in quotes or ')', found number 1");
        CHECK(error_of("Object( Foo, \"a\" 2 )") == "1:18: error: Object: expected ':', found number 2");
        CHECK(error_of("InputEvent( FOO )") ==
              "1:13: error: InputEvent: expected NONE, KEY, MBUTTON, JBUTTON or JAXIS, found 'FOO'");
        CHECK(error_of("InputEvent( KEY, \"A\" )") ==
              "1:18: error: InputEvent: expected a key code or name, found string \"A\"");
        CHECK(error_of("InputEvent( KEY, 65, XY )") ==
              "1:22: error: InputEvent: expected modifiers out of S, A, C and M, found 'XY'");
        CHECK(error_of("InputEvent( JAXIS, 1 )") == "1:22: error: InputEvent: expected ',', found ')'");
        CHECK(error_of("InputEvent( MBUTTON, 1, S )") == "1:23: error: InputEvent: expected ')', found ','");
    }

    TEST_CASE("a text that goes on behind its value is an error") {
        CHECK(error_of("1 2") == "1:3: error: expected end of text, found number 2");
        CHECK(error_of("[ ] ]") == "1:5: error: expected end of text, found ']'");
        CHECK(error_of("5 ; comment") == "no error");
    }

    TEST_CASE("the file's name stands before the place") {
        const Expected<Variant> value = parse_variant("[", "a.tscn");
        REQUIRE_FALSE(value.has_value());
        CHECK(value.error().to_string() == "a.tscn:1:2: error: expected a value, found end of text");
        CHECK(value.error().code == ErrorCode::ParseError);
    }

    TEST_CASE("a reader repeats its error") {
        VariantReader reader("a = )\nb = 1\n", "");
        const std::string first = reader.next_item().error().to_string();
        CHECK(first == "1:5: error: expected a value, found ')'");
        CHECK(reader.next_item().error().to_string() == first);
        CHECK(reader.read_value().error().to_string() == first);
        CHECK(reader.expect_end().error().to_string() == first);
    }
}

} // namespace cl::tests
