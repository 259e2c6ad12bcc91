#include "tests/core/variant_text.h"

#include "core/object/class_registry.h"
#include "core/object/object.h"
#include "core/variant/variant_parser.h"

#include <doctest/doctest.h>

#include <cmath>

namespace cl::tests {
namespace {

using Type = Variant::Type;

/// The value as Godot's var2str spells it.
std::string spelled(std::string_view text) {
    return variant_to_text(read(text), as_godot());
}

} // namespace

TEST_SUITE("core/variant/variant_parser values") {
    TEST_CASE("plain identifiers are the values they name") {
        CHECK(read("true") == Variant(true));
        CHECK(read("false") == Variant(false));
        CHECK(read("null") == Variant());
        CHECK(read("nil") == Variant());
        CHECK(read("inf") == Variant(HUGE_VAL));
        CHECK(std::isnan(read("nan").to_real()));
        CHECK(read(" ; comment\n true ; more\n") == Variant(true));
    }

    TEST_CASE("numbers keep their kind, and every pitfall of Godot's reader is read sensibly") {
        CHECK(read("5") == Variant(5));
        CHECK(read("-3978") == Variant(-3978));
        CHECK(read("5.") == Variant(5.0));
        CHECK(read("5.e3") == Variant(5000.0));
        CHECK(std::signbit(read("-0.0").to_real()));
        CHECK(read("1e-5") == Variant(1e-5));
        CHECK(read(".5") == Variant(0.5));
        CHECK(read("-.5") == Variant(-0.5));
        CHECK(read("+5") == Variant(5));
        CHECK(read("1E1") == Variant(10.0));
        CHECK(read("-inf") == Variant(-HUGE_VAL));
        CHECK(read("-inf.0") == Variant(-HUGE_VAL));
        CHECK(read("[ -inf.0, inf ]") == Variant(Array{-HUGE_VAL, HUGE_VAL}));
        CHECK(read("-") == Variant(0));
        CHECK(read("99999999999999999999") == Variant(INT64_MAX));
        CHECK(read("9007199254740993") == Variant(int64_t{9007199254740993}));
    }

    TEST_CASE("colours have 3, 4, 6 or 8 digits with alpha first, other counts are black") {
        CHECK(read("#ff8000") == Variant(Color{1, 128 / 255.0f, 0, 1}));
        CHECK(read("#80ff8040") == Variant(Color{1, 128 / 255.0f, 64 / 255.0f, 128 / 255.0f}));
        CHECK(read("#80FF8040") == read("#80ff8040"));
        CHECK(read("#fa0") == read("#ffaa00"));
        CHECK(read("#4fa0") == read("#44ffaa00"));
        CHECK(read("#12345") == Variant(Color{0, 0, 0, 1}));
        CHECK(read("#") == Variant(Color{0, 0, 0, 1}));
        CHECK(read("#ffffff00ff") == Variant(Color{0, 0, 0, 1}));
    }

    TEST_CASE("every constructor takes its numbers in the documented order") {
        CHECK(read("Vector2( 1, 2.5 )") == Variant(glm::vec2(1, 2.5f)));
        CHECK(read("Rect2( 1, 2, 3, 4 )") == Variant(Rect2{{1, 2}, {3, 4}}));
        CHECK(read("Vector3( 1, 2, 3 )") == Variant(glm::vec3(1, 2, 3)));
        CHECK(read("Plane( 0, 1, 0, 5 )") == Variant(Plane{{0, 1, 0}, 5}));
        CHECK(read("Quat( 1, 2, 3, 4 )") == Variant(glm::quat(4, 1, 2, 3))); // glm: w first
        CHECK(read("AABB( 1, 2, 3, 4, 5, 6 )") == Variant(AABB{{1, 2, 3}, {4, 5, 6}}));
        CHECK(read("Color( 2, -1, 0.5, 3 )") == Variant(Color{2, -1, 0.5f, 3})); // not clamped
        CHECK(read("RID( 5 )") == Variant(5));
        CHECK(read("NodePath( \"A/B:c\" )") == Variant(NodePath("A/B:c")));
        const Variant t2 = read("Transform2D( 1, 2, 3, 4, 5, 6 )");
        CHECK(t2 == Variant(Transform2D{{1, 2}, {3, 4}, {5, 6}}));
        const Variant t = read("Transform( 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 )");
        const glm::vec3 moved = t.get_if<Transform>()->xform({1, 0, 0});
        CHECK(moved == glm::vec3(1 + 10, 4 + 11, 7 + 12)); // the first column, and the origin
        CHECK(*read("Basis( 1, 2, 3, 4, 5, 6, 7, 8, 9 )").get_if<glm::mat3>() ==
              t.get_if<Transform>()->basis);
    }

    TEST_CASE("the old names of constructors are accepted") {
        CHECK(spelled("Matrix32( 1, 2, 3, 4, 5, 6 )") == "Transform2D( 1, 2, 3, 4, 5, 6 )");
        CHECK(spelled("Rect3( 1, 2, 3, 4, 5, 6 )") == "AABB( 1, 2, 3, 4, 5, 6 )");
        CHECK(spelled("Matrix3( 1, 2, 3, 4, 5, 6, 7, 8, 9 )") == "Basis( 1, 2, 3, 4, 5, 6, 7, 8, 9 )");
        CHECK(spelled("ByteArray( 1 )") == "PoolByteArray( 1 )");
        CHECK(spelled("IntArray( 1 )") == "PoolIntArray( 1 )");
        CHECK(spelled("FloatArray( 1 )") == "PoolRealArray( 1 )");
        CHECK(spelled("StringArray( \"1\" )") == "PoolStringArray( \"1\" )");
        CHECK(spelled("Vector2Array( 1, 2 )") == "PoolVector2Array( 1, 2 )");
        CHECK(spelled("Vector3Array( 1, 2, 3 )") == "PoolVector3Array( 1, 2, 3 )");
        CHECK(spelled("ColorArray( 1, 2, 3, 4 )") == "PoolColorArray( 1, 2, 3, 4 )");
    }

    TEST_CASE("inf and nan may stand inside constructors") {
        CHECK(read("Vector2( inf, -inf )") == Variant(glm::vec2(HUGE_VALF, -HUGE_VALF)));
        CHECK(std::isnan(read("Vector2( nan, 0 )").get_if<glm::vec2>()->x));
        CHECK(read("PoolRealArray( inf, -inf, 1e400, +inf )") ==
              Variant(PoolRealArray({HUGE_VALF, -HUGE_VALF, HUGE_VALF, HUGE_VALF})));
    }

    TEST_CASE("pool arrays of whole numbers truncate reals and wrap integers") {
        CHECK(read("PoolIntArray( 2.7, -2.7, 4294967295, -1 )") == Variant(PoolIntArray({2, -2, -1, -1})));
        CHECK(read("PoolIntArray( 2147483647, 2147483648, -2147483648, 99999999999 )") ==
              Variant(PoolIntArray({INT32_MAX, INT32_MIN, INT32_MIN, 1215752191})));
        CHECK(read("PoolIntArray( 1e10, -1e10, 3000000000.0 )") ==
              Variant(PoolIntArray({INT32_MIN, INT32_MIN, INT32_MIN})));
        CHECK(read("PoolByteArray( 1, 256, -1, 300, -1.7, 257.9 )") ==
              Variant(PoolByteArray({1, 0, 255, 44, 255, 1})));
        CHECK(read("PoolRealArray( 0.1, 1e-7, 16777217, 123456789 )") ==
              Variant(PoolRealArray({0.1f, 1e-7f, 16777216.0f, 123456792.0f})));
    }

    TEST_CASE("pool arrays may be empty, hold comments and any white space, and drop an incomplete rest") {
        CHECK(read("PoolIntArray( )") == Variant(PoolIntArray()));
        CHECK(read("PoolIntArray()") == Variant(PoolIntArray()));
        CHECK(read("PoolIntArray(;c)\n)") == Variant(PoolIntArray()));
        CHECK(read("PoolIntArray(1,2;c\n,3\n,\t4;c\n)") == Variant(PoolIntArray({1, 2, 3, 4})));
        CHECK(read("PoolIntArray(\n;c\n1)") == Variant(PoolIntArray({1})));
        CHECK(read("PoolRealArray(1.5;c\n,;c\n2.5)") == Variant(PoolRealArray({1.5f, 2.5f})));
        CHECK(read("PoolStringArray( \"a\", \"b\", )") == Variant(PoolStringArray({"a", "b"})));
        CHECK(read("PoolStringArray( )") == Variant(PoolStringArray()));
        CHECK(read("PoolVector2Array( 1, 2, 3 )") == Variant(PoolVector2Array({{1, 2}})));
        CHECK(read("PoolVector3Array( 1, 2, 3, 4, 5 )") == Variant(PoolVector3Array({{1, 2, 3}})));
        CHECK(read("PoolColorArray( 1, 2, 3, 4, 5, 6, 7 )") == Variant(PoolColorArray({{1, 2, 3, 4}})));
        CHECK(read("PoolColorArray( 1 )") == Variant(PoolColorArray()));
    }

    TEST_CASE("a long pool array holds every element once, whatever the spacing") {
        for (const char* separator : {",", ", ", " ,\n"}) {
            std::string text = "PoolIntArray(";
            std::vector<int32_t> expected;
            for (int i = -1500; i < 1500; i++) {
                text += (expected.empty() ? "" : separator) + std::to_string(i * 1000003);
                expected.push_back(i * 1000003);
            }
            CHECK(read(text + ')') == Variant(PoolIntArray(expected)));
        }
    }

    TEST_CASE("arrays and dictionaries nest and allow a comma at the end") {
        CHECK(read("[]") == Variant(Array{}));
        CHECK(read("[ 1, \"two\", [ [ ] ], null, ]") ==
              Variant(Array{1, "two", Array{Variant(Array{})}, Variant()}));
        const Variant d = read("{ \"a\": { \"b\": [ 1 ] }, 2: true, }");
        REQUIRE(d.get_if<Dictionary>());
        CHECK(*d.get_if<Dictionary>()->find("a")->get_if<Dictionary>()->find("b") == Variant(Array{1}));
        CHECK(*d.get_if<Dictionary>()->find(Variant(2)) == Variant(true));
        CHECK(read("{}") == Variant(Dictionary{}));
    }

    TEST_CASE("of a key that a dictionary has twice the last value counts") {
        const Variant d = read("{ \"a\": 1, \"b\": 2, \"a\": 3, nan: 1, nan: 2 }");
        CHECK(spelled("{ \"a\": 1, \"b\": 2, \"a\": 3 }") == "{\n\"a\": 3,\n\"b\": 2\n}");
        CHECK(d.get_if<Dictionary>()->size() == 3);
    }

    TEST_CASE("white space and comments may stand between any two tokens") {
        CHECK(read("Vector2 ; c\n ( ;)\n1\n,\n2 ; c\n)") == Variant(glm::vec2(1, 2)));
        CHECK(read("{;\n\"a\";\n:;\n1;\n}") == read("{\"a\":1}"));
    }
}

TEST_SUITE("core/variant/variant_parser objects") {
    TEST_CASE("resources come from the caller by their id or path") {
        VariantReadOptions options;
        options.ext_resource = [](int64_t id) -> Expected<Variant> {
            return Variant("ext " + std::to_string(id));
        };
        options.sub_resource = [](int64_t id) -> Expected<Variant> {
            return Variant("sub " + std::to_string(id));
        };
        options.resource = [](const std::string& path) -> Expected<Variant> {
            return Variant("file " + path);
        };
        const Expected<Variant> value = parse_variant(
            "[ ExtResource( 1 ), SubResource( -2 ), Resource( \"res://a.tres\" ) ]", "", options);
        REQUIRE(value.has_value());
        CHECK(*value == Variant(Array{"ext 1", "sub -2", "file res://a.tres"}));
    }

    TEST_CASE("an error of the caller gets the place of the constructor, unless it has one") {
        VariantReadOptions options;
        options.ext_resource = [](int64_t) -> Expected<Variant> {
            return Error{ErrorCode::NotFound, "no such id"};
        };
        options.sub_resource = [](int64_t) -> Expected<Variant> {
            return Error{ErrorCode::ParseError, "bad", {"other.tres", 7, 1}};
        };
        CHECK(error_of("[ 1,\n ExtResource( 9 ) ]", options) == "2:2: error: no such id");
        CHECK(error_of("SubResource( 9 )", options) == "other.tres:7:1: error: bad");
    }

    TEST_CASE("without a caller's function resources are located errors") {
        CHECK(error_of("  ExtResource( 1 )") ==
              "1:3: error: expected a value that needs no other file or section, found ExtResource( 1 )");
        CHECK(error_of("Resource( \"a\" )") ==
              "1:1: error: expected a value that needs no other file or section, found Resource( \"a\" )");
    }

    TEST_CASE("an object of a class that we do not have is kept and written back") {
        register_core_types(ClassRegistry::instance());
        const std::string text = "Object(Foo,\"size\":Vector3( 1, 2, 3 ),\"list\":[ 1 ])\n";
        const Variant value = read("Object( Foo, \"size\": Vector3( 1, 2, 3 ), \"list\": [ 1 ], )");
        REQUIRE(value.to_object());
        CHECK(value.to_object()->class_name() == StringName("Foo"));
        CHECK(value.to_object()->get("size") == Variant(glm::vec3(1, 2, 3)));
        CHECK(variant_to_text(value) == text);
        CHECK(variant_to_text(read(text)) == text);
    }

    TEST_CASE("the caller may make the objects") {
        VariantReadOptions options;
        options.object = [](const std::string& name,
                            std::vector<TextProperty> properties) -> Expected<Variant> {
            return Variant(name + std::to_string(properties.size()) + properties.at(0).name);
        };
        const Expected<Variant> value = parse_variant("Object( Node, \"x\": 1, \"y\": 2 )", "", options);
        REQUIRE(value.has_value());
        CHECK(*value == Variant("Node2x"));
    }

    TEST_CASE("input events of Godot 2 become the objects that took their place") {
        register_core_types(ClassRegistry::instance());
        CHECK(variant_to_text(read("InputEvent( KEY, 16777217, CS )")) ==
              "Object(InputEventKey,\"scancode\":16777217,\"shift\":true,\"control\":true)\n");
        CHECK(variant_to_text(read("InputEvent( KEY, a )")) == "Object(InputEventKey,\"scancode\":65)\n");
        CHECK(variant_to_text(read("InputEvent( KEY, Escape )")) ==
              "Object(InputEventKey,\"scancode\":\"Escape\")\n");
        CHECK(variant_to_text(read("InputEvent( MBUTTON, 1 )")) ==
              "Object(InputEventMouseButton,\"button_index\":1)\n");
        CHECK(variant_to_text(read("InputEvent( JBUTTON, 3 )")) ==
              "Object(InputEventJoypadButton,\"button_index\":3)\n");
        CHECK(variant_to_text(read("InputEvent( JAXIS, 1, -1 )")) ==
              "Object(InputEventJoypadMotion,\"axis\":1,\"axis_value\":-1.0)\n");
        CHECK(read("InputEvent( NONE )") == Variant(ObjectRef()));
    }
}

} // namespace cl::tests
