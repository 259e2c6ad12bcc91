#include "tests/scene/scene_fixture.h"

#include "scene/3d/spatial.h"
#include "scene/main/missing_node.h"
#include "scene/main/scene_tree.h"

#include <doctest/doctest.h>

using namespace cl;
using namespace cl::scene;
using cl::tests::Journal;
using cl::tests::register_types;

namespace {

/// Counts what happens to it.
class Counter final : public ScriptInstance {
public:
    static constexpr std::string_view kClassName = "TestCounter";
    static void bind(ClassBuilder<Counter>& c) {
        c.property(
             "step_size", [](const Counter& o) { return o.step_size; },
             [](Counter& o, double v) { o.step_size = v; })
            .doc("Added each step.")
            .default_value(1.0);
        c.method("double_it", &Counter::double_it, "Twice the total.");
    }
    double double_it() { return total *= 2.0; }
    void ready(Node&) override { ++ready_calls; }
    void process(Node&, double delta_s) override { total += step_size * delta_s; }

    double step_size = 1.0;
    double total = 0.0;
    int ready_calls = 0;
};

Counter& attach_counter(Node& node) {
    register_types();
    ClassRegistry::instance().add<Counter, ScriptInstance>();
    auto counter = std::make_unique<Counter>();
    Counter& attached = *counter;
    node.set_script_instance(std::move(counter));
    return attached;
}

} // namespace

TEST_SUITE("scene/main/script_instance") {
    TEST_CASE("a script is told when its node is ready and at each step") {
        register_types();
        SceneTree tree;
        auto node = std::make_unique<Node>();
        Counter& counter = attach_counter(*node);
        CHECK(counter.ready_calls == 0);
        REQUIRE(tree.set_scene(std::move(node)).ok());
        CHECK(counter.ready_calls == 1);
        tree.step(0.5);
        tree.step(0.25);
        CHECK(counter.total == 0.75);
        CHECK(counter.ready_calls == 1);
    }

    TEST_CASE("a script attached to a node that is ready is made ready at once") {
        register_types();
        SceneTree tree;
        Node& node = tree.root().add_new<Node>("A");
        CHECK(attach_counter(node).ready_calls == 1);
    }

    TEST_CASE("the node gets, sets and calls what its script has, under the same names") {
        register_types();
        Node node;
        Counter& counter = attach_counter(node);
        CHECK(node.get("step_size") == Variant(1.0));
        CHECK(node.set("step_size", 3) == SetResult::Done);
        CHECK(counter.step_size == 3.0);
        CHECK(node.set("step_size", "three") == SetResult::WrongType);
        CHECK(node.has_property("step_size"));
        CHECK(node.set("other", 3) == SetResult::UnknownProperty);
        counter.total = 2.0;
        const Expected<Variant> doubled = node.call_method("double_it");
        REQUIRE(doubled.has_value());
        CHECK(*doubled == Variant(4.0));
        const Expected<Variant> unknown = node.call_method("treble_it");
        REQUIRE(!unknown.has_value());
        CHECK(unknown.error().code == ErrorCode::NotFound);
    }

    TEST_CASE("a script takes the values that a file gave its node before") {
        register_types();
        Node node;
        CHECK(node.set("step_size", 2.5) == SetResult::UnknownProperty);
        CHECK(attach_counter(node).step_size == 2.5);
        node.set_script_instance(nullptr);
        CHECK(node.script_instance() == nullptr);
    }

    TEST_CASE("a script may take itself off its node") {
        register_types();
        class Quitter final : public ScriptInstance {
        public:
            void process(Node& node, double) override {
                node.set_script_instance(nullptr);
                ++steps; // still alive
            }
            int steps = 0;
        };
        SceneTree tree;
        Node& node = tree.root().add_new<Node>("A");
        node.set_script_instance(std::make_unique<Quitter>());
        tree.step(0.1);
        tree.step(0.1);
        CHECK(node.script_instance() == nullptr);
    }
}

TEST_SUITE("scene/main/node_duplicate") {
    TEST_CASE("a copy has the original's properties, groups, children, owners and script") {
        register_types();
        SceneTree tree;
        Spatial& original = tree.root().add_new<Spatial>("Original");
        original.set_translation({1, 2, 3});
        original.set_visible(false);
        original.add_to_group("lamps", GroupSaving::Saved);
        CHECK(original.set("unknown", 5) == SetResult::UnknownProperty);
        Spatial& child = original.add_new<Spatial>("Child");
        child.set_scale({2, 2, 2});
        REQUIRE(child.set_owner(&original).ok());
        Counter& counter = attach_counter(child);
        counter.step_size = 7.0;

        const std::unique_ptr<Node> copy = original.duplicate();
        REQUIRE(copy != nullptr);
        CHECK(!copy->is_inside_tree());
        CHECK(copy->name() == original.name());
        CHECK(copy->get("translation") == Variant(glm::vec3(1, 2, 3)));
        CHECK(copy->get("visible") == Variant(false));
        CHECK(copy->get("unknown") == Variant(5));
        REQUIRE(copy->groups().size() == 1);
        CHECK(copy->groups()[0].saving == GroupSaving::Saved);
        Node* copied_child = copy->get_node("Child");
        REQUIRE(copied_child != nullptr);
        CHECK(copied_child != &child);
        CHECK(copied_child->owner() == copy.get());
        CHECK(copied_child->get("scale") == Variant(glm::vec3(2, 2, 2)));
        REQUIRE(copied_child->script_instance() != nullptr);
        CHECK(copied_child->script_instance() != &counter);
        CHECK(copied_child->get("step_size") == Variant(7.0));
    }
}

TEST_SUITE("scene/main/missing_node") {
    TEST_CASE("a class that we do not have is stood in for by its nearest base, under its own name") {
        register_types();
        const ClassRegistry& registry = ClassRegistry::instance();
        struct Case {
            const char* class_name;
            const char* base;
            NodeSupport support;
        };
        for (const Case& c : {Case{"MeshInstance", "MeshInstance", NodeSupport::Full},
                              Case{"StaticBody", "Spatial", NodeSupport::StandIn},
                              Case{"CSGBox", "GeometryInstance", NodeSupport::StandIn},
                              Case{"ReflectionProbe", "VisualInstance", NodeSupport::StandIn},
                              Case{"InterpolatedCamera", "Camera", NodeSupport::StandIn},
                              Case{"AnimationPlayer", "Node", NodeSupport::StandIn},
                              Case{"Light", "Spatial", NodeSupport::StandIn},
                              Case{"SpatialMaterial", "Node", NodeSupport::StandIn},
                              Case{"Wombat", "Node", NodeSupport::Unknown}}) {
            CAPTURE(c.class_name);
            const CreatedNode created = create_node(registry, c.class_name);
            CHECK(created.support == c.support);
            CHECK(created.node->class_name().str() == c.class_name);
            CHECK(created.node->class_info().name.str() == c.base);
        }
        const CreatedNode moved = create_node(registry, "Wombat", TransformHint::HasTransform);
        CHECK(moved.node->class_info().name.str() == "Spatial");
        CHECK(moved.support == NodeSupport::Unknown);
    }

    TEST_CASE("a stand-in moves what is below it and keeps the properties it does not know") {
        register_types();
        const CreatedNode body = create_node(ClassRegistry::instance(), "StaticBody");
        CHECK(body.node->set("translation", glm::vec3(0, 5, 0)) == SetResult::Done);
        CHECK(body.node->set("collision_layer", 3) == SetResult::UnknownProperty);
        const Spatial& below = body.node->add_new<Spatial>("Below");
        CHECK(below.global_transform().origin.y == 5.0f);
        bool kept = false;
        for (const Object::PropertyValue& p : body.node->stored_properties()) {
            kept = kept || (p.name == StringName("collision_layer") && p.value == Variant(3));
        }
        CHECK(kept);
        const std::unique_ptr<Node> copy = body.node->duplicate();
        REQUIRE(copy != nullptr);
        CHECK(copy->class_name().str() == "StaticBody");
    }
}
