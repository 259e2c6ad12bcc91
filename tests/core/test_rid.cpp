#include "core/rid.h"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

using namespace cl;

TEST_SUITE("core/rid") {
    TEST_CASE("a RID leads to its own object only") {
        RID_Owner<std::string> owner;
        const RID a = owner.make("a");
        const RID b = owner.make("b");
        CHECK(a != b);
        REQUIRE(owner.get(a));
        REQUIRE(owner.get(b));
        CHECK(*owner.get(a) == "a");
        CHECK(*owner.get(b) == "b");
    }

    TEST_CASE("a stale RID is refused, also after its slot holds another object") {
        RID_Owner<std::string> owner;
        const RID old = owner.make("old");
        CHECK(owner.free(old));
        CHECK(owner.get(old) == nullptr);
        CHECK_FALSE(owner.free(old));

        const RID fresh = owner.make("fresh");
        CHECK(fresh.slot == old.slot); // the slot is used again, or this test tests nothing
        CHECK(owner.get(old) == nullptr);
        CHECK_FALSE(owner.free(old));
        CHECK(*owner.get(fresh) == "fresh");
    }

    TEST_CASE("the null RID and RIDs of another kind are refused") {
        RID_Owner<int> lights(1);
        RID_Owner<int> probes(2);
        const RID light = lights.make(5);
        static_cast<void>(probes.make(6));
        CHECK_FALSE(RID().is_valid());
        CHECK(lights.get(RID()) == nullptr);
        CHECK(probes.get(light) == nullptr);
        CHECK_FALSE(probes.free(light));
        CHECK(lights.owns(light));
    }

    TEST_CASE("freeing destroys the object at once, and the owner destroys the rest") {
        const auto token = std::make_shared<int>(0);
        {
            RID_Owner<std::shared_ptr<int>> owner;
            const RID a = owner.make(token);
            static_cast<void>(owner.make(token));
            CHECK(token.use_count() == 3);
            owner.free(a);
            CHECK(token.use_count() == 2);
        }
        CHECK(token.use_count() == 1);
    }

    TEST_CASE("for_each visits the live objects, in slot order, and size counts them") {
        RID_Owner<int> owner(7);
        std::vector<RID> made;
        for (int i = 0; i < 5; ++i) {
            made.push_back(owner.make(i));
        }
        owner.free(made[1]);
        owner.free(made[4]);
        CHECK(owner.size() == 3);
        std::vector<int> seen;
        owner.for_each([&](RID rid, int& value) {
            CHECK(rid == made[static_cast<size_t>(value)]);
            seen.push_back(value);
        });
        CHECK(seen == std::vector<int>{0, 2, 3});
    }
}
