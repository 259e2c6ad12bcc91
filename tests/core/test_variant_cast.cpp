#include "core/object/class_registry.h"
#include "core/object/resource.h"
#include "core/object/variant_cast.h"

#include <doctest/doctest.h>

#include <limits>

using namespace cl;

namespace {

enum class Mode : uint8_t { A, B, C };

class Cloth : public Resource {
public:
    static constexpr std::string_view kClassName = "TestCastCloth";
};
class Wood : public Resource {};

/// What every cast promises: the Variant has the declared type and gives the value back.
template <typename T>
void check_round_trip(const T& value) {
    const Variant stored = VariantCast<T>::to_variant(value);
    CHECK(stored.type() == VariantCast<T>::kType);
    const std::optional<T> back = VariantCast<T>::from_variant(stored);
    REQUIRE(back);
    CHECK((*back == value));
}

} // namespace

TEST_SUITE("core/object/variant_cast") {
    TEST_CASE("every type comes back from the Variant it is saved as") {
        check_round_trip(true);
        check_round_trip(-7);
        check_round_trip(std::numeric_limits<int64_t>::min());
        check_round_trip(std::numeric_limits<uint32_t>::max());
        check_round_trip(0.98f);
        check_round_trip(0.1);
        check_round_trip(std::string("text"));
        check_round_trip(StringName("name"));
        check_round_trip(glm::vec2(1, 2));
        check_round_trip(glm::vec3(1, 2, 3));
        check_round_trip(glm::quat(1, 0, 0, 0));
        check_round_trip(glm::mat3(2.0f));
        check_round_trip(Rect2{{1, 2}, {3, 4}});
        check_round_trip(AABB{{1, 2, 3}, {4, 5, 6}});
        check_round_trip(Plane{{0, 1, 0}, 2});
        check_round_trip(Transform{glm::mat3(3.0f), {1, 2, 3}});
        check_round_trip(Transform2D{{1, 2}, {3, 4}, {5, 6}});
        check_round_trip(Color{0.1f, 0.2f, 0.3f, 0.4f});
        check_round_trip(NodePath("../A:b"));
        check_round_trip(Array{Variant(1), Variant("x")});
        check_round_trip(PoolByteArray({1, 2}));
        check_round_trip(PoolIntArray({1, 2}));
        check_round_trip(PoolRealArray({1.5f}));
        check_round_trip(PoolStringArray({"a"}));
        check_round_trip(PoolVector2Array({{1, 2}}));
        check_round_trip(PoolVector3Array({{1, 2, 3}}));
        check_round_trip(PoolColorArray({Color{}}));
        check_round_trip(Mode::C);
        check_round_trip(make_ref<Cloth>());
        Dictionary dictionary;
        dictionary.set("key", 1);
        check_round_trip(dictionary);
    }

    TEST_CASE("numbers and bool convert into each other, a real to int by truncation") {
        CHECK(VariantCast<int>::from_variant(1.7) == 1);
        CHECK(VariantCast<int>::from_variant(-1.7) == -1);
        CHECK(VariantCast<float>::from_variant(3) == 3.0f);
        CHECK(VariantCast<bool>::from_variant(2) == true);
        CHECK(VariantCast<Mode>::from_variant(1.0) == Mode::B);
    }

    TEST_CASE("a value of an unrelated type does not convert") {
        CHECK_FALSE(VariantCast<float>::from_variant("1.5"));
        CHECK_FALSE(VariantCast<glm::vec3>::from_variant(1));
        CHECK_FALSE(VariantCast<Color>::from_variant(glm::vec3(1)));
        CHECK_FALSE(VariantCast<Mode>::from_variant("B"));
    }

    TEST_CASE("a mask of -1 has all 32 bits set") {
        CHECK(VariantCast<uint32_t>::from_variant(-1) == 0xFFFFFFFFu);
    }

    TEST_CASE("a number beyond an enum's type cannot wrap to a valid enumerator") {
        const std::optional<Mode> mode = VariantCast<Mode>::from_variant(256);
        REQUIRE(mode);
        CHECK(static_cast<int>(*mode) == 255);
    }

    TEST_CASE("a null Ref is Nil, Nil is a null Ref, and an object of another class is refused") {
        using ClothCast = VariantCast<Ref<Cloth>>;
        CHECK(ClothCast::resource_class() == "TestCastCloth");
        CHECK(ClothCast::to_variant(Ref<Cloth>()).is_nil());
        REQUIRE(ClothCast::from_variant(Variant()));
        CHECK_FALSE(*ClothCast::from_variant(Variant()));
        CHECK_FALSE(ClothCast::from_variant(Variant(make_ref<Wood>())));
        CHECK_FALSE(ClothCast::from_variant(Variant(1)));
        CHECK(VariantCast<Ref<Resource>>::from_variant(Variant(make_ref<Wood>())));
    }
}
