#include "core/object/object.h"
#include "core/ref.h"

#include <doctest/doctest.h>

using namespace cl;

namespace {

class Counted : public Reference {
public:
    explicit Counted(int& alive) : alive_(alive) { ++alive_; }
    ~Counted() override { --alive_; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;

private:
    int& alive_;
};

class Other : public Reference {};

} // namespace

TEST_SUITE("core/ref") {
    TEST_CASE("an object lives as long as its last Ref") {
        int alive = 0;
        Ref<Counted> a = make_ref<Counted>(alive);
        {
            Ref<Counted> b = a;
            Ref<Reference> base = b; // shared with a Ref to the base class
            CHECK(a->use_count() == 3);
        }
        CHECK(a->use_count() == 1);
        CHECK(alive == 1);
        a = nullptr;
        CHECK(alive == 0);
    }

    TEST_CASE("moving passes ownership on, assigning to itself keeps it") {
        int alive = 0;
        Ref<Counted> a = make_ref<Counted>(alive);
        Ref<Counted> b = std::move(a);
        CHECK(b->use_count() == 1);
        const Ref<Counted>& same = b;
        b = same;
        CHECK(alive == 1);
        CHECK(b->use_count() == 1);
        b = make_ref<Counted>(alive);
        CHECK(alive == 1);
    }

    TEST_CASE("cast() gives null for an object of another class") {
        int alive = 0;
        const Ref<Reference> object = make_ref<Counted>(alive);
        CHECK(object.cast<Counted>().get() == object.get());
        CHECK_FALSE(object.cast<Other>());
        CHECK(object->use_count() == 1);
    }
}
