#include "core/object/class_registry.h"
#include "core/object/resource.h"

#include <doctest/doctest.h>

using namespace cl;

namespace {

/// As a node: `script` is last of all, extras aside.
class Base : public Object {
public:
    static constexpr std::string_view kClassName = "TestStoredBase";
    static void bind(ClassBuilder<Base>& c) {
        c.property("script", &Base::script, &Base::set_script).saved_last();
        c.property("mode", &Base::mode, &Base::set_mode);
        c.property("alias", &Base::mode, &Base::set_mode).not_stored();
    }
    [[nodiscard]] Ref<Resource> script() const { return script_; }
    void set_script(Ref<Resource> script) { script_ = std::move(script); }
    [[nodiscard]] int mode() const { return mode_; }
    void set_mode(int mode) { mode_ = mode; }

protected:
    int mode_ = 0;

private:
    Ref<Resource> script_;
};

/// As a mesh instance: static properties, then one dynamic one a slot.
class Slots : public Base {
public:
    static constexpr std::string_view kClassName = "TestStoredSlots";
    static void bind(ClassBuilder<Slots>& c) {
        c.dynamic();
        c.property("mesh", &Slots::mesh, &Slots::set_mesh);
    }
    [[nodiscard]] Ref<Resource> mesh() const { return mesh_; }
    void set_mesh(Ref<Resource> mesh) { mesh_ = std::move(mesh); }

protected:
    void list_dynamic(std::vector<PropertyValue>& out) const override {
        if (mesh_) {
            out.push_back({"material/0", Variant()});
        }
    }

private:
    Ref<Resource> mesh_;
};

class Derived : public Slots {
public:
    static constexpr std::string_view kClassName = "TestStoredDerived";
    Derived() { mode_ = 3; }
    static void bind(ClassBuilder<Derived>& c) { c.property("speed", &Derived::speed, &Derived::set_speed); }
    [[nodiscard]] float speed() const { return speed_; }
    void set_speed(float speed) { speed_ = speed; }

private:
    float speed_ = 1.0f;
};

/// As a material: a feature's properties are saved while it is on, even when default.
class Paint : public Resource {
public:
    static constexpr std::string_view kClassName = "TestStoredPaint";
    static void bind(ClassBuilder<Paint>& c) {
        const auto shines = [](const Paint& paint) { return paint.shine_enabled_; };
        c.property("shine_enabled", &Paint::shine_enabled, &Paint::set_shine_enabled);
        c.property("shine", &Paint::shine, &Paint::set_shine).stored_if(shines).always_stored();
        c.property("shine_map", &Paint::map, &Paint::set_map).stored_if(shines).always_stored();
    }
    [[nodiscard]] bool shine_enabled() const { return shine_enabled_; }
    void set_shine_enabled(bool on) { shine_enabled_ = on; }
    [[nodiscard]] float shine() const { return shine_; }
    void set_shine(float shine) { shine_ = shine; }
    [[nodiscard]] Ref<Resource> map() const { return map_; }
    void set_map(Ref<Resource> map) { map_ = std::move(map); }

private:
    bool shine_enabled_ = false;
    float shine_ = 1.0f;
    Ref<Resource> map_;
};

void register_test_classes() {
    ClassRegistry& registry = ClassRegistry::instance();
    register_core_types(registry);
    registry.add<Base, Object>();
    registry.add<Slots, Base>();
    registry.add<Derived, Slots>();
    registry.add<Paint, Resource>();
}

/// "a b c": the names that saving writes.
std::string stored_names(const Object& object) {
    std::string names;
    for (const Object::PropertyValue& p : object.stored_properties()) {
        names += (names.empty() ? "" : " ") + p.name.str();
    }
    return names;
}

} // namespace

TEST_SUITE("core/object/object_storage") {
    TEST_CASE("a fresh instance stores nothing") {
        register_test_classes();
        CHECK(stored_names(Derived()) == "");
        CHECK(stored_names(Paint()) == "");
    }

    TEST_CASE(
        "base classes come first, dynamic ones after their class, script after all, unknown ones last") {
        register_test_classes();
        Derived object;
        object.set("unknown", 1);
        object.set("speed", 2);
        object.set("mesh", make_ref<Resource>());
        object.set("mode", 1);
        object.set("script", make_ref<Resource>());
        CHECK(stored_names(object) == "mode mesh material/0 speed script unknown");
    }

    TEST_CASE("a default is that of the object's own class, not of the class that declares the property") {
        register_test_classes();
        Derived object;
        object.set("mode", 0);
        CHECK(stored_names(object) == "mode");
        object.set("mode", 3);
        CHECK(stored_names(object) == "");
    }

    TEST_CASE("properties of a feature are stored, default or not, only while it is on") {
        register_test_classes();
        Paint paint;
        paint.set("shine", 0.25);
        CHECK(stored_names(paint) == "");
        paint.set("shine", 1.0);
        paint.set("shine_enabled", true);
        CHECK(stored_names(paint) == "shine_enabled shine"); // and a null object of a resource is left out
        paint.set("shine_map", make_ref<Resource>());
        CHECK(stored_names(paint) == "shine_enabled shine shine_map");
    }

    TEST_CASE("setting what was stored on a fresh instance gives an object that stores the same") {
        register_test_classes();
        Derived object;
        object.set("mode", 7);
        object.set("speed", 0.1);
        object.set("note", "kept");
        Derived copy;
        for (const Object::PropertyValue& p : object.stored_properties()) {
            copy.set(p.name, p.value);
        }
        const auto expected = object.stored_properties();
        const auto found = copy.stored_properties();
        REQUIRE(found.size() == expected.size());
        for (size_t i = 0; i < found.size(); ++i) {
            CHECK(found[i].name == expected[i].name);
            CHECK(found[i].value == expected[i].value);
        }
    }
}
