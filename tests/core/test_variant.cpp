#include "core/object/class_registry.h"
#include "core/object/object.h"
#include "core/variant/variant.h"
#include "core/variant/variant_components.h"

#include <doctest/doctest.h>

#include <limits>

namespace cl {
namespace {

using Type = Variant::Type;

/// One value of every type, none of them the type's zero.
std::vector<Variant> one_of_each() {
    Dictionary dictionary;
    dictionary.set("a", 1);
    return {Variant(),
            true,
            7,
            1.5,
            "text",
            glm::vec2(1, 2),
            Rect2{{1, 2}, {3, 4}},
            glm::vec3(1, 2, 3),
            Transform2D{{1, 2}, {3, 4}, {5, 6}},
            Plane{{0, 1, 0}, 2},
            glm::quat(1, 2, 3, 4),
            AABB{{1, 2, 3}, {4, 5, 6}},
            glm::mat3(2.0f),
            Transform{glm::mat3(2.0f), {1, 2, 3}},
            Color{1, 0.5f, 0.25f, 1},
            NodePath("a:b"),
            TextRID{5},
            Ref<Reference>(new Reference),
            dictionary,
            Array{1, "x"},
            PoolByteArray({1, 2}),
            PoolIntArray({1, -2}),
            PoolRealArray({1.5f}),
            PoolStringArray({"a", "b"}),
            PoolVector2Array({{1, 2}}),
            PoolVector3Array({{1, 2, 3}}),
            PoolColorArray({{1, 0, 0, 1}})};
}

Variant converted(const Variant& value, Type to) {
    const std::optional<Variant> result = value.converted_to(to);
    return result ? *result : Variant("refused");
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace

TEST_SUITE("core/variant") {
    TEST_CASE("each value has the type number that binary files of Godot 3 give it") {
        const std::vector<Variant> values = one_of_each();
        REQUIRE(values.size() == static_cast<size_t>(Type::Count));
        for (size_t i = 0; i < values.size(); i++) {
            CHECK(static_cast<size_t>(values[i].type()) == i);
        }
        CHECK(static_cast<int>(Type::String) == 4);
        CHECK(static_cast<int>(Type::Transform) == 13);
        CHECK(static_cast<int>(Type::Array) == 19);
        CHECK(static_cast<int>(Type::PoolColorArray) == 26);
        CHECK(type_name(Type::Nil) == "Nil");
        CHECK(type_name(Type::Real) == "float");
        CHECK(type_name(Type::PoolColorArray) == "PoolColorArray");
    }

    TEST_CASE("a value equals its copy and no value of another type") {
        const std::vector<Variant> a = one_of_each();
        const std::vector<Variant> copy = a;
        for (size_t i = 0; i < a.size(); i++) {
            for (size_t j = 0; j < a.size(); j++) {
                CAPTURE(i);
                CAPTURE(j);
                CHECK((a[i] == copy[j]) == (i == j));
            }
        }
        CHECK_FALSE(Variant(1) == Variant(1.0));
        CHECK_FALSE(Variant(kInfinity - kInfinity) == Variant(kInfinity - kInfinity));
        CHECK(Variant(0.0) == Variant(-0.0));
    }

    TEST_CASE("containers compare by what is in them, dictionaries in any order") {
        CHECK(Variant(Array{1, Array{2}}) == Variant(Array{1, Array{2}}));
        CHECK_FALSE(Variant(Array{1, Array{2}}) == Variant(Array{1, Array{3}}));
        Dictionary ab, ba;
        ab.set("a", 1);
        ab.set("b", 2);
        ba.set("b", 2);
        ba.set("a", 1);
        CHECK(Variant(ab) == Variant(ba));
        ba.set("a", 3);
        CHECK_FALSE(Variant(ab) == Variant(ba));
        CHECK_FALSE(Variant(PoolIntArray({1, 2})) == Variant(PoolIntArray({1, 3})));
    }

    TEST_CASE("a pool array that is edited leaves its copies alone") {
        PoolIntArray a({1, 2, 3});
        const PoolIntArray b = a;
        a.edit()[0] = 9;
        CHECK(b[0] == 1);
        CHECK(a[0] == 9);
        const int* before = a.span().data();
        a.edit()[1] = 8; // not shared any more: no copy
        CHECK(a.span().data() == before);
    }

    TEST_CASE("numbers and booleans convert into each other, reals towards zero") {
        CHECK(converted(1.7, Type::Int) == Variant(1));
        CHECK(converted(-1.7, Type::Int) == Variant(-1));
        CHECK(converted(3, Type::Real) == Variant(3.0));
        CHECK(converted(true, Type::Int) == Variant(1));
        CHECK(converted(true, Type::Real) == Variant(1.0));
        CHECK(converted(0.5, Type::Bool) == Variant(true));
        CHECK(converted(0, Type::Bool) == Variant(false));
        CHECK(converted(1e300, Type::Int) == Variant(INT64_MAX));
        CHECK(converted(-kInfinity, Type::Int) == Variant(INT64_MIN));
        CHECK(converted(kInfinity - kInfinity, Type::Int) == Variant(0));
    }

    TEST_CASE("strings convert to node paths and back, null to no object") {
        CHECK(converted("A/B:c", Type::NodePath) == Variant(NodePath("A/B:c")));
        CHECK(converted(NodePath("A/B:c"), Type::String) == Variant("A/B:c"));
        CHECK(converted(Variant(), Type::Object) == Variant(ObjectRef()));
    }

    TEST_CASE("an array converts to a pool array if every element fits, and back") {
        CHECK(converted(Array{1, 2.9, true}, Type::PoolIntArray) == Variant(PoolIntArray({1, 2, 1})));
        CHECK(converted(Array{256, -1}, Type::PoolByteArray) == Variant(PoolByteArray({0, 255})));
        CHECK(converted(Array{int64_t{4294967295}}, Type::PoolIntArray) == Variant(PoolIntArray({-1})));
        CHECK(converted(Array{1, 0.5}, Type::PoolRealArray) == Variant(PoolRealArray({1.0f, 0.5f})));
        CHECK(converted(Array{"a", NodePath("b")}, Type::PoolStringArray) ==
              Variant(PoolStringArray({"a", "b"})));
        CHECK(converted(Array{glm::vec3(1, 2, 3)}, Type::PoolVector3Array) ==
              Variant(PoolVector3Array({{1, 2, 3}})));
        CHECK(converted(Array{}, Type::PoolColorArray) == Variant(PoolColorArray()));
        CHECK(converted(Array{1, "x"}, Type::PoolIntArray) == Variant("refused"));
        CHECK(converted(Array{glm::vec2(1, 2)}, Type::PoolVector3Array) == Variant("refused"));
        CHECK(converted(PoolByteArray({7, 255}), Type::Array) == Variant(Array{7, 255}));
        CHECK(converted(PoolColorArray({{1, 0, 0, 1}}), Type::Array) == Variant(Array{Color{1, 0, 0, 1}}));
    }

    TEST_CASE("every value converts to its own type and to any, and what is not named above is refused") {
        const auto group = [](Type t) { // types of one group convert into each other, some only in part
            const bool number = t == Type::Bool || t == Type::Int || t == Type::Real;
            const bool name = t == Type::String || t == Type::NodePath;
            const bool list = t >= Type::Array;
            return number ? 1 : name ? 2 : list ? 3 : 10 + static_cast<int>(t);
        };
        for (const Variant& value : one_of_each()) {
            CHECK(converted(value, Type::Nil) == value);
            for (int t = 1; t < static_cast<int>(Type::Count); t++) {
                const Type to = static_cast<Type>(t);
                CAPTURE(static_cast<int>(value.type()));
                CAPTURE(t);
                if (to == value.type()) {
                    CHECK(converted(value, to) == value);
                } else if (group(to) != group(value.type()) && !(value.is_nil() && to == Type::Object)) {
                    CHECK_FALSE(value.converted_to(to).has_value());
                }
            }
        }
    }

    TEST_CASE("getters of the wrong type give the type's zero") {
        CHECK(Variant("7").to_int() == 0);
        CHECK(Variant("x").to_real() == 0.0);
        CHECK_FALSE(Variant("true").to_bool());
        CHECK(Variant(5).to_object() == nullptr);
        CHECK(Variant(5).get_if<std::string>() == nullptr);
        CHECK(Variant(5).get_if<Array>() == nullptr);
    }

    TEST_CASE("a variant shares its object and the last one lets it go") {
        Ref<Reference> object(new Reference);
        {
            const Variant a(object);
            Variant b = a;
            CHECK(object->use_count() == 3);
            Variant c = std::move(b);
            CHECK(object->use_count() == 3);
            CHECK(c.to_object() == object.get());
            c = Variant();
            CHECK(object->use_count() == 2);
        }
        CHECK(object->use_count() == 1);
    }

    TEST_CASE("the numbers of a mathematical value rebuild it") {
        int mathematical = 0;
        for (const Variant& value : one_of_each()) {
            const Components components = components_of(value);
            CHECK(components.count == component_count(value.type()));
            if (components.count > 0) {
                mathematical++;
                CHECK(from_components(value.type(), components.span()) == value);
            }
        }
        CHECK(mathematical == 10);
        const Components rows =
            components_of(glm::mat3(glm::vec3(1, 2, 3), glm::vec3(4, 5, 6), glm::vec3(7, 8, 9)));
        CHECK(rows.values[1] == 4.0f); // row 0 is the x of every column
    }
}

} // namespace cl
