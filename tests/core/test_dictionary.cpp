#include "core/variant/variant.h"
#include "core/variant/variant_compare.h"

#include <doctest/doctest.h>

#include <limits>

namespace cl {

TEST_SUITE("core/variant/dictionary") {
    TEST_CASE("entries stay in insertion order, and a key set again keeps its place") {
        Dictionary d;
        d.set("b", 1);
        d.set("a", 2);
        d.set("b", 3);
        REQUIRE(d.size() == 2);
        CHECK(d.entries()[0] == Dictionary::Entry("b", 3));
        CHECK(d.entries()[1] == Dictionary::Entry("a", 2));
    }

    TEST_CASE("look-up finds every key before and after the index is built, and no other") {
        Dictionary d;
        for (int i = 0; i < 2000; i++) {
            d.set("key " + std::to_string(i), i);
            d.set(i, -i);
            REQUIRE(d.size() == static_cast<size_t>(2 * i + 2));
        }
        for (int i = 0; i < 2000; i++) {
            const std::string key = "key " + std::to_string(i);
            REQUIRE(d.find(key));
            CHECK(*d.find(key) == Variant(i));
            CHECK(d.find(Variant(key)) == d.find(key));
            REQUIRE(d.find(Variant(i)));
            CHECK(*d.find(Variant(i)) == Variant(-i));
        }
        CHECK(d.find("key 2000") == nullptr);
        CHECK(d.find(Variant(2000)) == nullptr);
        CHECK(d.find(Variant(1.0)) == nullptr);
    }

    TEST_CASE("a copy is independent of its original, index included") {
        Dictionary a;
        for (int i = 0; i < 100; i++) {
            a.set(i, i);
        }
        Dictionary b = a;
        b.set(100, 100);
        b.set(5, "changed");
        CHECK(a.size() == 100);
        CHECK(*a.find(Variant(5)) == Variant(5));
        CHECK(*b.find(Variant(100)) == Variant(100));
        CHECK(*b.find(Variant(5)) == Variant("changed"));
    }

    TEST_CASE("keys are the same by type and value: 1 and 1.0 differ, 0 and -0 and all NaN do not") {
        constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
        for (const int fillers : {0, 50}) { // with and without an index
            CAPTURE(fillers);
            Dictionary d;
            for (int i = 0; i < fillers; i++) {
                d.set("filler " + std::to_string(i), i);
            }
            const size_t before = d.size();
            d.set(1, "int");
            d.set(1.0, "real");
            d.set(0.0, 1);
            d.set(-0.0, 2);
            d.set(kNan, 1);
            d.set(-kNan, 2);
            d.set(glm::vec2(0.0f, 1.0f), 1);
            d.set(glm::vec2(-0.0f, 1.0f), 2);
            d.set(PoolRealArray({static_cast<float>(kNan)}), 1);
            d.set(PoolRealArray({static_cast<float>(kNan)}), 2);
            d.set(Array{1, kNan}, 1);
            d.set(Array{1, kNan}, 2);
            CHECK(d.size() == before + 7);
            CHECK(*d.find(Variant(kNan)) == Variant(2));
            CHECK(*d.find(Variant(1)) == Variant("int"));
        }
    }

    TEST_CASE("keys of every type are found again through the index") {
        Dictionary inner;
        inner.set("x", 1);
        const std::vector<Variant> keys = {Variant(),
                                           true,
                                           false,
                                           1,
                                           2.5,
                                           "s",
                                           glm::vec2(1, 2),
                                           glm::vec3(1, 2, 3),
                                           Rect2{{1, 2}, {3, 4}},
                                           Color{1, 0, 0, 1},
                                           NodePath("a:b"),
                                           TextRID{3},
                                           ObjectRef(),
                                           inner,
                                           Array{1, 2},
                                           PoolByteArray({1}),
                                           PoolIntArray({1}),
                                           PoolRealArray({1}),
                                           PoolStringArray({"1"}),
                                           PoolVector2Array({{1, 1}}),
                                           PoolVector3Array({{1, 1, 1}}),
                                           PoolColorArray({{1, 1, 1, 1}})};
        Dictionary d;
        for (size_t i = 0; i < keys.size(); i++) {
            d.set(keys[i], static_cast<int>(i));
        }
        REQUIRE(d.size() == keys.size());
        for (size_t i = 0; i < keys.size(); i++) {
            REQUIRE(d.find(keys[i]));
            CHECK(*d.find(keys[i]) == Variant(static_cast<int>(i)));
        }
    }

    TEST_CASE("dictionaries as keys hash alike in any order") {
        Dictionary ab, ba;
        ab.set("a", 1);
        ab.set("b", 2);
        ba.set("b", 2);
        ba.set("a", 1);
        CHECK(hash_key(ab) == hash_key(ba));
        CHECK(same_key(ab, ba));
        CHECK(hash_key(Variant("text")) == hash_key(std::string_view("text")));
    }

    TEST_CASE("the sort order of keys is a strict weak order, NaN included") {
        constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
        const std::vector<Variant> keys = {
            Variant(),       false,           true,    -3,      2,       kNan, -1.5, 0.0, "A", "a", "ab",
            glm::vec2(1, 2), glm::vec2(1, 3), Color{}, Array{}, Array{1}};
        for (size_t i = 0; i < keys.size(); i++) {
            for (size_t j = 0; j < keys.size(); j++) {
                CAPTURE(i);
                CAPTURE(j);
                CHECK(key_less(keys[i], keys[j]) == (i < j)); // they are listed in order
            }
        }
    }
}

} // namespace cl
