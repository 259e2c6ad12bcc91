#include "tests/scene/text_scene.h"

#include "scene/resources/array_mesh.h"

#include "core/variant/variant_parser.h"

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

/// The worked example of the specification, tscn section 9.1 (its third vertex is ours).
constexpr std::string_view kWorkedExample = R"({
"aabb": AABB( 0, 0, 0, 1, 1, 0.25 ),
"array_data": PoolByteArray( 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 127, 0, 127, 0, 0, 127, 255, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 63, 0, 0, 0, 0, 0, 89, 89, 0, 127, 0, 0, 129, 0, 127, 0, 255, 0, 60, 85, 53, 0, 60, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63, 0, 0, 128, 62, 0, 0, 127, 0, 127, 0, 0, 127, 0, 0, 255, 255, 0, 0, 0, 60, 0, 0, 0, 60 ),
"array_index_data": PoolByteArray( 0, 0, 1, 0, 2, 0 ),
"blend_shape_data": [  ],
"format": 97599,
"index_count": 3,
"primitive": 4,
"skeleton_aabb": [  ],
"vertex_count": 3
})";

Variant value_of(std::string_view text) {
    Expected<Variant> value = parse_variant(text);
    REQUIRE_MESSAGE(value.has_value(), (value ? "" : value.error().message));
    return *value;
}

/// The worked example with one entry replaced (or taken out: empty text).
Variant example_with(std::string_view key, std::string_view text) {
    Dictionary changed;
    const Variant example = value_of(kWorkedExample);
    for (const auto& [k, v] : example.get_if<Dictionary>()->entries()) {
        if (k.to_text() != key) {
            changed.set(k, v);
        }
    }
    if (!text.empty()) {
        changed.set(Variant(key), value_of(text));
    }
    return changed;
}

std::string refusal_of(const Variant& surface, const char* property = "surfaces/0") {
    register_types();
    ArrayMesh mesh;
    const SetResult result = mesh.set(property, surface);
    CHECK(mesh.surface_count() == (result == SetResult::Done ? 1 : 0));
    return result == SetResult::Done ? "accepted" : mesh.refusal();
}

/// A triangle as exporters write it.
constexpr std::string_view kPlainArrays = R"({
"primitive": 4, "name": "tri", "morph_arrays": [  ],
"arrays": [ PoolVector3Array( 0, 0, 0, 1, 0.5, 0, 0, 1, 0.25 ), PoolVector3Array( 0, 0, 1, 0, 0.7071, 0.7071, 0, 0, 1 ),
PoolRealArray( 1, 0, 0, 1, 1, 0, 0, -1, 1, 0, 0, 1 ), PoolColorArray( 1, 0, 0, 1, 0, 0.5, 0, 1, 0, 0, 1, 1 ),
PoolVector2Array( 0, 0, 1, 0.3333, 0, 1 ), PoolVector2Array( 0, 0, 1, 0, 0, 1 ), null, null, PoolIntArray( 0, 1, 2 ) ] })";

} // namespace

TEST_SUITE("scene/resources/array_mesh") {
    TEST_CASE("the specification's worked example is read to its vertices") {
        register_types();
        ArrayMesh mesh;
        REQUIRE(mesh.set("surfaces/0", value_of(kWorkedExample)) == SetResult::Done);
        const Expected<SurfaceArrays> a = decode_surface(mesh.surfaces()[0]);
        REQUIRE(a.has_value());
        CHECK(a->positions[1] == glm::vec3(1, 0.5f, 0));
        CHECK(a->normals[1].y == doctest::Approx(89.0f / 127.0f));
        CHECK(a->tangents[1].w == -1.0f);
        CHECK(a->uvs[1].y == doctest::Approx(0.3333f).epsilon(1e-3));
        CHECK(a->indices == std::vector<uint32_t>{0, 1, 2});
        CHECK(mesh.aabb().size == glm::vec3(1, 1, 0.25f));
    }

    TEST_CASE("a packed surface is saved as it was loaded, keys in alphabetical order") {
        register_types();
        ArrayMesh mesh;
        REQUIRE(mesh.set("surfaces/0", value_of(kWorkedExample)) == SetResult::Done);
        const std::vector<Object::PropertyValue> stored = mesh.stored_properties();
        REQUIRE(stored.size() == 1);
        CHECK(stored[0].name.str() == "surfaces/0");
        CHECK(stored[0].value == value_of(kWorkedExample));
    }

    TEST_CASE("plain arrays become the packed surface of the worked example") {
        register_types();
        ArrayMesh mesh;
        REQUIRE(mesh.set("surfaces/0", value_of(kPlainArrays)) == SetResult::Done);
        ArrayMesh packed;
        REQUIRE(packed.set("surfaces/0", value_of(kWorkedExample)) == SetResult::Done);
        CHECK(mesh.surfaces()[0].format == 97599);
        CHECK(mesh.surfaces()[0].vertices == packed.surfaces()[0].vertices);
        CHECK(mesh.surfaces()[0].indices == packed.surfaces()[0].indices);
        CHECK(mesh.surface_extras(0).name == "tri");
    }

    TEST_CASE("surfaces come in order") {
        CHECK(refusal_of(value_of(kWorkedExample), "surfaces/1") ==
              "expected surfaces/0 next, found surfaces/1");
        CHECK(refusal_of(value_of(kWorkedExample), "surfaces/-1") ==
              "expected surfaces/0 next, found surfaces/-1");
        register_types();
        ArrayMesh mesh;
        REQUIRE(mesh.set("surfaces/0", value_of(kWorkedExample)) == SetResult::Done);
        CHECK(mesh.set("surfaces/0", value_of(kWorkedExample)) == SetResult::Refused);
        CHECK(mesh.set("surfaces/1", value_of(kWorkedExample)) == SetResult::Done);
        CHECK(mesh.surface_count() == 2);
    }

    TEST_CASE("missing and wrong entries are named") {
        CHECK(refusal_of(example_with("format", "")) == "expected an int in \"format\", found none");
        CHECK(refusal_of(example_with("aabb", "Vector3( 1, 1, 1 )")) ==
              "expected an AABB in \"aabb\", found Vector3");
        CHECK(refusal_of(example_with("array_data", "[ 1, 2 ]")) ==
              "expected a PoolByteArray in \"array_data\", found Array");
        CHECK(refusal_of(example_with("primitive", "7")) == "expected \"primitive\" from 0 to 6, found 7");
        CHECK(refusal_of(example_with("index_count", "-3")) ==
              "expected \"index_count\" from 0 to 4294967295, found -3");
    }

    TEST_CASE("counts of a billion are held against the bytes that are there") {
        for (const char* key : {"vertex_count", "index_count"}) {
            CAPTURE(key);
            const std::string refusal = refusal_of(example_with(key, "1000000000"));
            CHECK(refusal != "accepted");
            CHECK(refusal.find("expected") != std::string::npos);
        }
        CHECK(refusal_of(example_with("array_data", "PoolByteArray( 1, 2, 3 )")) != "accepted");
        CHECK(refusal_of(example_with("array_index_data", "PoolByteArray( 0, 0, 1, 0, 3, 0 )")) !=
              "accepted");
    }

    TEST_CASE("plain arrays need nine entries of their types, and morph_arrays") {
        const auto with = [](std::string_view from, std::string_view to) {
            std::string text(kPlainArrays);
            text.replace(text.find(from), from.size(), to);
            return refusal_of(value_of(text));
        };
        CHECK(with(", \"morph_arrays\": [  ]", "") == "expected an Array in \"morph_arrays\", found none");
        CHECK(with(", null, null, PoolIntArray( 0, 1, 2 )", "") ==
              "expected 9 entries in \"arrays\", found 6");
        CHECK(with("PoolIntArray( 0, 1, 2 )", "[ 0, 1, 2 ]") ==
              "expected a PoolIntArray as index array, found Array");
        CHECK(with("PoolIntArray( 0, 1, 2 )", "PoolIntArray( 0, 1, -1 )") != "accepted");
        CHECK(with("PoolVector2Array( 0, 0, 1, 0, 0, 1 )", "PoolVector2Array( 0, 0 )") != "accepted");
    }

    TEST_CASE("the old layout of compressed positions, three halves, is widened") {
        register_types();
        // Format 1 + 512: positions as halves. (1, 2, -1) in 6 bytes.
        const Variant old =
            value_of(R"({ "aabb": AABB( 0, 0, 0, 1, 2, 1 ), "format": 513, "primitive": 0, "vertex_count": 2,
"array_data": PoolByteArray( 0, 60, 0, 64, 0, 188, 0, 0, 0, 0, 0, 0 ) })");
        ArrayMesh mesh;
        REQUIRE(mesh.set("surfaces/0", old) == SetResult::Done);
        const Expected<SurfaceArrays> a = decode_surface(mesh.surfaces()[0]);
        REQUIRE(a.has_value());
        CHECK(a->positions[0] == glm::vec3(1, 2, -1));
        CHECK(a->positions[1] == glm::vec3(0, 0, 0));
    }

    TEST_CASE("blend shapes are named before the first surface and saved with their mode") {
        register_types();
        ArrayMesh mesh;
        REQUIRE(mesh.set("blend_shape/names", value_of("PoolStringArray( \"smile\" )")) == SetResult::Done);
        REQUIRE(mesh.set("surfaces/0", value_of(kWorkedExample)) == SetResult::Done);
        CHECK(mesh.set("blend_shape/names", value_of("PoolStringArray(  )")) == SetResult::Refused);
        CHECK(mesh.refusal() == "expected blend_shape/names before surfaces/0, found it later");
        REQUIRE(mesh.blend_shape_names().size() == 1);
        const std::vector<Object::PropertyValue> stored = mesh.stored_properties();
        REQUIRE(stored.size() == 3);
        CHECK(stored[0].name.str() == "blend_shape/names");
        CHECK(stored[1].name.str() == "blend_shape/mode");
    }

    TEST_CASE("surface_<i + 1>/name and /material reach the surface") {
        register_types();
        ArrayMesh mesh;
        REQUIRE(mesh.set("surfaces/0", value_of(kWorkedExample)) == SetResult::Done);
        CHECK(mesh.set("surface_1/name", "red") == SetResult::Done);
        CHECK(mesh.surface_extras(0).name == "red");
        const Ref<Reference> material = ClassRegistry::instance().create_ref("SpatialMaterial");
        CHECK(mesh.set("surface_1/material", Variant(material)) == SetResult::Done);
        CHECK(mesh.surface_material(0).get() == material.get());
        CHECK(mesh.set("surface_2/name", "none") == SetResult::UnknownProperty);
    }
}
