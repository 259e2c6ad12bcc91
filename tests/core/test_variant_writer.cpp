#include "tests/core/variant_text.h"

#include "core/object/class_registry.h"
#include "core/object/object.h"
#include "core/variant/variant_writer.h"

#include <doctest/doctest.h>

namespace cl::tests {
namespace {

Ref<Reference> declared_object(std::string_view class_name) {
    register_core_types(ClassRegistry::instance());
    Ref<Reference> object(new Reference);
    object->set_declared_class(StringName(class_name));
    return object;
}

} // namespace

TEST_SUITE("core/variant/variant_writer") {
    TEST_CASE("constructors have one blank inside their parentheses, two when empty, node paths none") {
        CHECK(variant_to_text(glm::vec3(1, 2.5f, 0)) == "Vector3( 1, 2.5, 0 )");
        CHECK(variant_to_text(PoolIntArray({1, -2})) == "PoolIntArray( 1, -2 )");
        CHECK(variant_to_text(PoolIntArray()) == "PoolIntArray(  )");
        CHECK(variant_to_text(PoolVector2Array({{1, 2}, {3, 4}})) == "PoolVector2Array( 1, 2, 3, 4 )");
        CHECK(variant_to_text(PoolColorArray({{1, 0, 0, 1}})) == "PoolColorArray( 1, 0, 0, 1 )");
        CHECK(variant_to_text(NodePath("A/B:c")) == "NodePath(\"A/B:c\")");
        CHECK(variant_to_text(TextRID{4}) == "RID( 4 )");
        CHECK(variant_to_text(Transform{glm::mat3(1, 2, 3, 4, 5, 6, 7, 8, 9), {10, 11, 12}}) ==
              "Transform( 1, 4, 7, 2, 5, 8, 3, 6, 9, 10, 11, 12 )");
    }

    TEST_CASE("arrays are on one line, dictionaries have a line for each key") {
        CHECK(variant_to_text(Array{1, "a", Variant(), true}) == "[ 1, \"a\", null, true ]");
        CHECK(variant_to_text(Array{}) == "[  ]");
        CHECK(variant_to_text(Dictionary{}) == "{\n\n}");
        Dictionary d;
        d.set("b", Array{});
        d.set("a", 1.0);
        CHECK(variant_to_text(d) == "{\n\"a\": 1.0,\n\"b\": [  ]\n}");
    }

    TEST_CASE(
        "dictionary keys are sorted by type, then value, and keep their order where Godot does not compare") {
        const Variant d =
            read("{ \"b\": 1, \"a\": 2, 3: 4, 1.5: 2, 2: 0, null: 3, true: 4, false: 5, Vector2( 3, 4 ): 1,"
                 "Vector2( 3, 3 ): 1, [ 2 ]: 1, [ 1, 5 ]: 1, [ 1 ]: 2, Color( 1, 0, 0, 1 ): 1,"
                 "Color( 0, 1, 0, 1 ): 2, \"\xc3\xa9\": 1, \"ab\": 1, \"C\": 1 }");
        CHECK(variant_to_text(d) ==
              "{\nnull: 3,\nfalse: 5,\ntrue: 4,\n2: 0,\n3: 4,\n1.5: 2,\n\"C\": 1,\n\"a\": 2,\n\"ab\": "
              "1,\n\"b\": 1,\n"
              "\"\xc3\xa9\": 1,\nVector2( 3, 3 ): 1,\nVector2( 3, 4 ): 1,\nColor( 1, 0, 0, 1 ): 1,\n"
              "Color( 0, 1, 0, 1 ): 2,\n[ 2 ]: 1,\n[ 1 ]: 2,\n[ 1, 5 ]: 1\n}");
    }

    TEST_CASE("string values escape only backslash and quote, names and lists use C escapes") {
        const std::string all = "a\\b\"c'd\te\nf\rg?\ah\bi\vj\fk";
        CHECK(variant_to_text(all) == "\"a\\\\b\\\"c'd\te\nf\rg?\ah\bi\vj\fk\"");
        CHECK(variant_to_text(PoolStringArray({all}), as_godot()) ==
              "PoolStringArray( \"a\\\\b\\\"c\\'d\\te\\nf\\rg\\?\\ah\\bi\\vj\\fk\" )");
        CHECK(variant_to_text(NodePath("a'b"), as_godot()) == "NodePath(\"a\\'b\")");
    }

    TEST_CASE("strings of any characters read back as they were, in exact style") {
        std::string all;
        for (int c = 1; c < 128; c++) {
            all += static_cast<char>(c);
        }
        for (const Variant& value : {Variant(all), Variant(PoolStringArray({all, "", "x"}))}) {
            CHECK(read(variant_to_text(value)) == value);
        }
    }

    TEST_CASE("objects are written by the caller, or in place with their class and properties") {
        Ref<Reference> object = declared_object("InputEventKey");
        object->set("scancode", 65);
        CHECK(variant_to_text(object) == "Object(InputEventKey,\"scancode\":65)\n");
        VariantWriteOptions options;
        options.object_text = [](const Reference&) { return std::string("SubResource( 3 )"); };
        CHECK(variant_to_text(Array{object, ObjectRef()}, options) == "[ SubResource( 3 ), null ]");
    }

    TEST_CASE("an object that contains itself ends in null") {
        Ref<Reference> object = declared_object("Loop");
        object->set("me", object);
        const std::string text = variant_to_text(object);
        CHECK(text.size() < 10000);
        CHECK(text.find("\"me\":null") != std::string::npos);
        object->set("me", Variant()); // lets go of itself
    }

    TEST_CASE("keys are quoted when a reader would not take them for one name") {
        CHECK(property_key_text("material/0") == "material/0");
        CHECK(property_key_text("my key") == "\"my key\"");
        CHECK(property_key_text("a=b") == "\"a=b\"");
        CHECK(property_key_text("a\"b") == "\"a\\\"b\"");
        CHECK(property_key_text("caf\xc3\xa9") == "\"caf\xc3\xa9\"");
        CHECK(property_key_text("a;b") == "\"a;b\"");
        CHECK(property_key_text("[a]") == "\"[a]\"");
        CHECK(property_key_text("").size() == 2);
        for (const std::string key :
             {"plain", "my key", "a=b", "a\"b\\", "caf\xc3\xa9", "a;b", "[a]", "a\nb"}) {
            CAPTURE(key);
            CHECK(assignments_of(property_key_text(key) + " = 1\nnext = 2\n") == key + "=1\nnext=2\n");
        }
    }
}

TEST_SUITE("core/variant/variant_str") {
    TEST_CASE("every type is shown as Godot's str shows it") {
        CHECK(variant_to_str(Variant()) == "Null");
        CHECK(variant_to_str(true) == "True");
        CHECK(variant_to_str("a\"b") == "a\"b");
        CHECK(variant_to_str(read("Rect2( 1, 2, 3, 4 )")) == "(1, 2, 3, 4)");
        CHECK(variant_to_str(read("Quat( 0.1, 0.2, 0.3, 0.9 )")) == "(0.1, 0.2, 0.3, 0.9)");
        CHECK(variant_to_str(read("Plane( 0, 1, 0, 5 )")) == "0, 1, 0, 5");
        CHECK(variant_to_str(read("AABB( 1, 2, 3, 4, 5, 6 )")) == "1, 2, 3 - 4, 5, 6");
        CHECK(variant_to_str(read("Basis( 1, 2, 3, 4, 5, 6, 7, 8, 9 )")) ==
              "((1, 2, 3), (4, 5, 6), (7, 8, 9))");
        CHECK(variant_to_str(read("Transform2D( 1, 2, 3, 4, 5, 6 )")) == "((1, 2), (3, 4), (5, 6))");
        CHECK(variant_to_str(read("Transform( 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 )")) ==
              "1, 2, 3, 4, 5, 6, 7, 8, 9 - 10, 11, 12");
        CHECK(variant_to_str(read("#ff8000")) == "1,0.501961,0,1");
        CHECK(variant_to_str(PoolByteArray({1})) == "[PoolByteArray]");
        CHECK(variant_to_str(PoolStringArray({"a", "b"})) == "[a, b]");
        CHECK(variant_to_str(PoolVector2Array({{1, 2}})) == "[(1, 2)]");
        CHECK(variant_to_str(ObjectRef()) == "[Object:null]");
        CHECK(variant_to_str(declared_object("CubeMesh")) == "[CubeMesh]");
    }

    TEST_CASE("dictionaries are sorted by the text of their keys") {
        CHECK(variant_to_str(
                  read("{ 3: 1, 1.5: 2, 20: 3, true: 4, null: 0, \"b\": [ 1 ], Vector2( 1, 2 ): 5 }")) ==
              "{(1, 2):5, 1.5:2, 20:3, 3:1, Null:0, True:4, b:[1]}");
    }

    TEST_CASE("from the second on empty containers are shown as dots, as in Godot") {
        CHECK(variant_to_str(read("[ [], [ [] ], {}, PoolIntArray(), [ 1 ] ]")) ==
              "[[], [[...]], {...}, [], [1]]");
        CHECK(variant_to_str(read("{ \"b\": {}, \"a\": [] }")) == "{a:[...], b:{}}");
    }

    TEST_CASE("to_text of a variant is its str form") {
        CHECK(Variant(glm::vec2(1, 2)).to_text() == "(1, 2)");
        CHECK(Variant(NodePath("a:b")).to_text() == "a:b");
    }
}

} // namespace cl::tests
