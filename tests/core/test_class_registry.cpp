#include "core/object/class_registry.h"
#include "core/object/resource.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace cl;

namespace {

class Animal : public Object {
public:
    static constexpr std::string_view kClassName = "TestAnimal";
    static void bind(ClassBuilder<Animal>& c) {
        c.doc("Has legs.").abstract();
        c.property("legs", &Animal::legs, &Animal::set_legs).doc("How many.").range("0,8,1").default_value(4);
        c.method("kick", &Animal::kick, "Moves the ball.");
        c.signal("ran", {"metres"});
        c.enumeration("Gait", {{"WALK", 0}, {"TROT", 1}});
    }
    virtual void speak() = 0;
    [[nodiscard]] int legs() const { return legs_; }
    void set_legs(int legs) { legs_ = legs; }
    [[nodiscard]] std::string kick(float strength, const std::string& what) const {
        return what + (strength > 1.0f ? " far" : " near");
    }

protected:
    int legs_ = 4;
};

class Bird : public Animal {
public:
    static constexpr std::string_view kClassName = "TestBird";
    Bird() { legs_ = 2; }
    static void bind(ClassBuilder<Bird>& c) {
        auto span = c.property("span", &Bird::span, &Bird::set_span);
        c.property("tail", &Bird::span, &Bird::set_span); // the first builder stays valid
        span.doc("Wing to wing [m].").default_value(1);
    }
    void speak() override {}
    [[nodiscard]] float span() const { return span_m_; }
    void set_span(float span_m) { span_m_ = span_m; }

private:
    float span_m_ = 1.0f;
};

class Unregistered : public Bird {};

void register_test_classes() {
    ClassRegistry& registry = ClassRegistry::instance();
    register_core_types(registry);
    registry.add<Animal, Object>();
    registry.add<Bird, Animal>();
}

} // namespace

TEST_SUITE("core/object/class_registry") {
    TEST_CASE("registering a class again changes nothing") {
        register_test_classes();
        const size_t before = ClassRegistry::instance().classes().size();
        const ClassInfo* bird = ClassRegistry::instance().find("TestBird");
        register_test_classes();
        CHECK(ClassRegistry::instance().classes().size() == before);
        CHECK(ClassRegistry::instance().find("TestBird") == bird);
        CHECK(bird->properties.size() == 2);
    }

    TEST_CASE("a class knows its bases and inherits their members") {
        register_test_classes();
        const ClassInfo* bird = ClassRegistry::instance().find("TestBird");
        REQUIRE(bird);
        CHECK(bird->is_a("TestBird"));
        CHECK(bird->is_a("Object"));
        CHECK_FALSE(bird->is_a("Resource"));
        CHECK(bird->find_property("legs") != nullptr);
        CHECK(bird->find_property("wheels") == nullptr);
        CHECK(bird->has_signal("ran"));
        CHECK_FALSE(bird->has_signal("flew"));
        const std::vector<const ClassInfo*> lineage = bird->lineage();
        REQUIRE(lineage.size() == 3);
        CHECK(lineage[0]->name.view() == "Object");
        CHECK(lineage[2] == bird);
    }

    TEST_CASE("bases come before what derives from them in classes()") {
        register_test_classes();
        std::vector<const ClassInfo*> seen;
        for (const ClassInfo* c : ClassRegistry::instance().classes()) {
            CHECK((!c->parent || std::find(seen.begin(), seen.end(), c->parent) != seen.end()));
            seen.push_back(c);
        }
    }

    TEST_CASE("create() makes registered concrete classes and no others") {
        register_test_classes();
        const ClassRegistry& registry = ClassRegistry::instance();
        const std::unique_ptr<Object> bird = registry.create("TestBird");
        REQUIRE(bird);
        CHECK(bird->class_name().view() == "TestBird");
        CHECK(registry.create("TestAnimal") == nullptr);
        CHECK(registry.create("NoSuchClass") == nullptr);
        CHECK(registry.create_ref("Resource").cast<Resource>());
        CHECK_FALSE(registry.create_ref("TestBird")); // not ref-counted
    }

    TEST_CASE("an object of a class that is not registered is described by its nearest base") {
        register_test_classes();
        const Unregistered object;
        CHECK(object.class_info().name.view() == "TestBird");
        CHECK(object.class_name().view() == "TestBird");
    }

    TEST_CASE("an object that stands in for a class we do not have keeps that class's name") {
        register_test_classes();
        Bird bird;
        bird.set_declared_class("Penguin");
        CHECK(bird.class_name().view() == "Penguin");
        CHECK(bird.class_info().name.view() == "TestBird");
    }

    TEST_CASE("a default is the value of a fresh instance, converted to the property's type") {
        register_test_classes();
        const ClassInfo& animal = *ClassRegistry::instance().find("TestAnimal");
        const ClassInfo& bird = *ClassRegistry::instance().find("TestBird");
        CHECK(animal.default_of(*animal.find_property("legs")) == Variant(4)); // abstract: as declared
        CHECK(bird.default_of(*bird.find_property("legs")) == Variant(2));     // its constructor says so
        CHECK(bird.default_of(*bird.find_property("tail")) == Variant(1.0));   // none was declared
        CHECK(*bird.find_property("span")->declared_default == Variant(1.0));  // declared as an int
        CHECK(bird.find_property("span")->doc == "Wing to wing [m].");
    }

    TEST_CASE("every declared default is what a fresh instance has") {
        register_test_classes();
        for (const ClassInfo* c : ClassRegistry::instance().classes()) {
            for (const PropertyInfo& p : c->properties) {
                if (c->create && p.declared_default) {
                    CAPTURE(std::string(c->name.view()) + "." + p.name.str());
                    CHECK(*p.declared_default == c->default_of(p));
                }
            }
        }
    }

    TEST_CASE("a method is called by name with converted arguments") {
        register_test_classes();
        Bird bird;
        const Expected<Variant> result = bird.call("kick", std::vector<Variant>{Variant(2), Variant("ball")});
        REQUIRE(result);
        CHECK(*result == Variant("ball far"));
        CHECK(bird.class_info().find_method("kick")->arguments ==
              std::vector<Variant::Type>{Variant::Type::Real, Variant::Type::String});
        CHECK(bird.class_info().find_method("kick")->result == Variant::Type::String);
    }

    TEST_CASE("a wrong call says what was expected and what was found") {
        register_test_classes();
        Bird bird;
        const auto message = [&](const StringName& method, const std::vector<Variant>& arguments) {
            const Expected<Variant> result = bird.call(method, arguments);
            return result ? std::string("no error") : result.error().message;
        };
        CHECK(message("fly", {}) == "TestBird has no method \"fly\"");
        CHECK(message("kick", {Variant(1)}) == "TestBird.kick(): expected 2 arguments, found 1");
        CHECK(message("kick", {Variant("a"), Variant("b")}) ==
              "TestBird.kick(): argument 1: expected float, found String");
    }
}
