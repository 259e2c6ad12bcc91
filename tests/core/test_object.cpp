#include "core/object/class_registry.h"
#include "core/object/resource.h"

#include <doctest/doctest.h>

using namespace cl;

namespace {

class Dial : public Object {
public:
    static constexpr std::string_view kClassName = "TestDial";
    static void bind(ClassBuilder<Dial>& c) {
        c.property("level", &Dial::level, &Dial::set_level);
        c.property("label", &Dial::label, &Dial::set_label);
    }
    [[nodiscard]] float level() const { return level_; }
    SetResult set_level(float level) {
        if (level < 0.0f) {
            return SetResult::Refused;
        }
        level_ = level;
        return SetResult::Done;
    }
    [[nodiscard]] const std::string& label() const { return label_; }
    void set_label(const std::string& label) { label_ = label; }

protected:
    SetResult set_dynamic(const StringName& property, const Variant& value) override {
        if (property.view() != "slot/0") {
            return SetResult::UnknownProperty;
        }
        if (value.type() != Variant::Type::Int) {
            return SetResult::WrongType;
        }
        slot_ = value.to_int();
        return SetResult::Done;
    }
    bool get_dynamic(const StringName& property, Variant& value) const override {
        if (property.view() != "slot/0") {
            return false;
        }
        value = Variant(slot_);
        return true;
    }

private:
    float level_ = 0.5f;
    std::string label_;
    int64_t slot_ = 0;
};

void register_test_classes() {
    register_core_types(ClassRegistry::instance());
    ClassRegistry::instance().add<Dial, Object>();
}

} // namespace

TEST_SUITE("core/object/object") {
    TEST_CASE("a property takes what converts to its type") {
        register_test_classes();
        Dial dial;
        CHECK(dial.set("level", 2) == SetResult::Done);
        CHECK(dial.get("level") == Variant(2.0));
        CHECK(dial.set("level", true) == SetResult::Done);
        CHECK(dial.get("level") == Variant(1.0));
    }

    TEST_CASE("a property keeps its value when the new one is of a wrong type or refused") {
        register_test_classes();
        Dial dial;
        CHECK(dial.set("level", "loud") == SetResult::WrongType);
        CHECK(dial.set("level", -1.0) == SetResult::Refused);
        CHECK(dial.get("level") == Variant(0.5));
        CHECK(dial.extra_properties().empty());
    }

    TEST_CASE("an unknown property is kept, in order of first assignment, with its last value") {
        register_test_classes();
        Dial dial;
        CHECK(dial.set("wobble", 1) == SetResult::UnknownProperty);
        CHECK(dial.set("twist", "x") == SetResult::UnknownProperty);
        CHECK(dial.set("wobble", 3) == SetResult::UnknownProperty);
        REQUIRE(dial.extra_properties().size() == 2);
        CHECK(dial.extra_properties()[0].name.view() == "wobble");
        CHECK(dial.extra_properties()[0].value == Variant(3));
        CHECK(dial.get("twist") == Variant("x"));
        CHECK(dial.has_property("twist"));
        CHECK_FALSE(dial.has_property("shake"));
        CHECK(dial.get("shake").is_nil());
    }

    TEST_CASE("a dynamic property goes to the class, with the class's own checks") {
        register_test_classes();
        Dial dial;
        CHECK(dial.set("slot/0", 9) == SetResult::Done);
        CHECK(dial.set("slot/0", "nine") == SetResult::WrongType);
        CHECK(dial.get("slot/0") == Variant(9));
        CHECK(dial.has_property("slot/0"));
        CHECK(dial.extra_properties().empty());
    }

    TEST_CASE("a handle leads to the object until the object is gone") {
        register_test_classes();
        std::weak_ptr<Object*> handle;
        {
            Dial dial;
            handle = dial.handle();
            CHECK(*handle.lock() == &dial);
        }
        CHECK(handle.expired());
    }

    TEST_CASE("a handle locked while the object goes leads nowhere") {
        register_test_classes();
        auto dial = std::make_unique<Dial>();
        const std::shared_ptr<Object*> held = dial->handle().lock();
        dial.reset();
        CHECK(*held == nullptr);
    }
}
