#include "core/object/class_registry.h"
#include "core/object/resource.h"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

using namespace cl;

namespace {

class Bell : public Object {
public:
    static constexpr std::string_view kClassName = "TestBell";
    static void bind(ClassBuilder<Bell>& c) {
        c.signal("rang", {"times"});
        c.signal("broke");
    }
};

class Dye : public Resource {
public:
    static constexpr std::string_view kClassName = "TestDye";
    void set_strength(float) { emit_changed(); }
};

void register_test_classes() {
    register_core_types(ClassRegistry::instance());
    ClassRegistry::instance().add<Bell, Object>();
}

} // namespace

TEST_SUITE("core/object/object_signals") {
    TEST_CASE("slots are called in order of connection, with the arguments") {
        register_test_classes();
        Bell bell;
        std::string heard;
        REQUIRE(bell.connect("rang", [&](std::span<const Variant> a) { heard += "a" + a[0].to_text(); }));
        REQUIRE(bell.connect("rang", [&](std::span<const Variant> a) { heard += "b" + a[0].to_text(); }));
        REQUIRE(bell.connect("broke", [&](std::span<const Variant>) { heard += "!"; }));
        const Variant times(3);
        bell.emit_signal("rang", {&times, 1});
        CHECK(heard == "a3b3");
    }

    TEST_CASE("connecting to a signal that the class does not have is an error") {
        register_test_classes();
        Bell bell;
        const Expected<uint64_t> id = bell.connect("sang", [](std::span<const Variant>) {});
        REQUIRE_FALSE(id);
        CHECK(id.error().message == "TestBell has no signal \"sang\"");
    }

    TEST_CASE("a one-shot slot is called once, even when it emits itself") {
        register_test_classes();
        Bell bell;
        int calls = 0;
        const auto slot = [&](std::span<const Variant>) {
            ++calls;
            bell.emit_signal("rang");
        };
        REQUIRE(bell.connect("rang", slot, ConnectFlags::OneShot));
        bell.emit_signal("rang");
        bell.emit_signal("rang");
        CHECK(calls == 1);
    }

    TEST_CASE("a slot that is disconnected during the emission is not called any more") {
        register_test_classes();
        Bell bell;
        std::string heard;
        uint64_t second = 0;
        uint64_t first = 0;
        first = *bell.connect("rang", [&](std::span<const Variant>) {
            heard += "1";
            bell.disconnect("rang", first); // itself, too: its callable must outlive the connection
            bell.disconnect("rang", second);
            heard += "-";
        });
        second = *bell.connect("rang", [&](std::span<const Variant>) { heard += "2"; });
        REQUIRE(bell.connect("rang", [&](std::span<const Variant>) { heard += "3"; }));
        bell.emit_signal("rang");
        CHECK(heard == "1-3");
        bell.emit_signal("rang");
        CHECK(heard == "1-33");
    }

    TEST_CASE("a slot that is connected during the emission is called from the next one") {
        register_test_classes();
        Bell bell;
        int late_calls = 0;
        REQUIRE(bell.connect(
            "rang",
            [&](std::span<const Variant>) {
                for (int i = 0; i < 100; ++i) { // enough to move the list of connections
                    REQUIRE(bell.connect("rang", [&](std::span<const Variant>) { ++late_calls; }));
                }
            },
            ConnectFlags::OneShot));
        bell.emit_signal("rang");
        CHECK(late_calls == 0);
        bell.emit_signal("rang");
        CHECK(late_calls == 100);
    }

    TEST_CASE("a slot may delete the object that emits; later slots are not called") {
        register_test_classes();
        auto bell = std::make_unique<Bell>();
        int calls = 0;
        REQUIRE(bell->connect("rang", [&](std::span<const Variant>) {
            ++calls;
            bell.reset();
        }));
        REQUIRE(bell->connect("rang", [&](std::span<const Variant>) { ++calls; }));
        bell->emit_signal("rang");
        CHECK(bell == nullptr);
        CHECK(calls == 1);
    }

    TEST_CASE("a resource calls those who asked to hear of its changes, until they are removed") {
        register_test_classes();
        ClassRegistry::instance().add<Dye, Resource>();
        const Ref<Dye> dye = make_ref<Dye>();
        int first = 0;
        int second = 0;
        const uint64_t id = dye->on_changed([&] { ++first; });
        dye->on_changed([&] { ++second; });
        dye->set_strength(1.0f);
        dye->remove_on_changed(id);
        dye->set_strength(2.0f);
        CHECK(first == 1);
        CHECK(second == 2);
    }
}
