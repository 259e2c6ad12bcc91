#include "tests/scene/scene_fixture.h"

#include "scene/main/scene_tree.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

std::vector<std::string> child_names(const Node& node) {
    std::vector<std::string> names;
    for (const auto& child : node.children()) {
        names.push_back(child->name().str());
    }
    return names;
}

std::unique_ptr<Node> named(std::string_view name) {
    auto node = std::make_unique<Node>();
    node->set_name(name);
    return node;
}

} // namespace

TEST_SUITE("scene/main/node") {
    TEST_CASE("children keep the order in which they were added, and know their place") {
        register_types();
        Node parent;
        for (const char* name : {"A", "B", "C", "D"}) {
            parent.add_new<Node>(name);
        }
        REQUIRE(parent.move_child(*parent.get_node("A"), 2).ok());
        CHECK(child_names(parent) == std::vector<std::string>{"B", "C", "A", "D"});
        REQUIRE(parent.move_child(*parent.get_node("D"), 0).ok());
        CHECK(child_names(parent) == std::vector<std::string>{"D", "B", "C", "A"});
        REQUIRE(parent.move_child(*parent.get_node("B"), 99).ok());
        CHECK(child_names(parent) == std::vector<std::string>{"D", "C", "A", "B"});
        for (size_t i = 0; i < parent.children().size(); ++i) {
            CHECK(parent.children()[i]->index() == i);
            CHECK(parent.children()[i]->parent() == &parent);
        }
    }

    TEST_CASE("a removed child belongs to the caller, and the others close ranks") {
        register_types();
        Node parent;
        parent.add_new<Node>("A");
        Node& b = parent.add_new<Node>("B");
        Node& c = parent.add_new<Node>("C");
        Expected<std::unique_ptr<Node>> removed = parent.remove_child(b);
        REQUIRE(removed.has_value());
        CHECK(removed->get() == &b);
        CHECK(b.parent() == nullptr);
        CHECK(child_names(parent) == std::vector<std::string>{"A", "C"});
        CHECK(c.index() == 1);

        Node stranger;
        stranger.set_name("Stranger");
        parent.set_name("Parent");
        const Expected<std::unique_ptr<Node>> refused = parent.remove_child(stranger);
        REQUIRE(!refused.has_value());
        CHECK(refused.error().message == "expected a child of 'Parent', found 'Stranger'");
    }

    TEST_CASE("a node cannot become its own descendant, and stays with the caller") {
        register_types();
        std::unique_ptr<Node> top = named("Top");
        Node& middle = top->add_new<Node>("Middle");
        Node& bottom = middle.add_new<Node>("Bottom");
        const Status status = bottom.add_child(std::move(top));
        REQUIRE(!status.ok());
        CHECK(status.error().message == "expected a node that is no ancestor of 'Bottom', found 'Top'");
        REQUIRE(top != nullptr);
        CHECK(bottom.children().empty());
        CHECK(bottom.add_child(nullptr).error().message == "expected a node to add, found null");
    }

    TEST_CASE("nesting ends with an error before it can overflow the stack") {
        register_types();
        auto top = std::make_unique<Node>();
        Node* at = top.get();
        int depth = 1;
        Status status;
        while ((status = at->add_child(std::make_unique<Node>())).ok()) {
            at = at->children()[0].get();
            REQUIRE(++depth <= Node::kMaxDepth);
        }
        CHECK(depth == Node::kMaxDepth);
        CHECK(status.error().message == "expected at most 2000 levels of nodes below each other");
    }

    TEST_CASE("names from code are made unique with a number, those of a file are kept") {
        register_types();
        Node parent;
        for (int i = 0; i < 3; ++i) {
            parent.add_new<Node>("Lamp");
        }
        REQUIRE(parent.add_child(named("Lamp2")).ok());
        REQUIRE(parent.add_child(named("Lamp"), Naming::Keep).ok());
        REQUIRE(parent.add_child(std::make_unique<Node>()).ok());
        CHECK(child_names(parent) ==
              std::vector<std::string>{"Lamp", "Lamp2", "Lamp3", "Lamp4", "Lamp", "Node"});
        CHECK(parent.get_node("Lamp") == parent.children()[0].get());
    }

    TEST_CASE("a name loses the characters that paths are made of") {
        register_types();
        Node node;
        node.set_name("a/b.c:d@e\"f");
        CHECK(node.name().str() == "abcdef");
        node.set_name("./:");
        CHECK(node.name().str() == "abcdef");
        node.set_name_verbatim("a/b");
        CHECK(node.name().str() == "a/b");
    }

    TEST_CASE("renaming says so and keeps siblings apart") {
        register_types();
        Node parent;
        parent.add_new<Node>("A");
        Node& b = parent.add_new<Node>("B");
        int renamed = 0;
        REQUIRE(b.connect("renamed", [&](auto) { ++renamed; }).has_value());
        b.set_name("A");
        CHECK(b.name().str() == "A2");
        CHECK(renamed == 1);
        b.set_name("A2");
        CHECK(b.name().str() == "A2");
    }

    TEST_CASE("is_before() is the order of a walk, parents before children") {
        register_types();
        Node top;
        Node& a = top.add_new<Node>("A");
        Node& a1 = a.add_new<Node>("A1");
        Node& a2 = a.add_new<Node>("A2");
        Node& b = top.add_new<Node>("B");
        Node& b1 = b.add_new<Node>("B1");
        const std::vector<Node*> walk{&top, &a, &a1, &a2, &b, &b1};
        for (size_t i = 0; i < walk.size(); ++i) {
            for (size_t j = 0; j < walk.size(); ++j) {
                CAPTURE(i);
                CAPTURE(j);
                CHECK(walk[i]->is_before(*walk[j]) == (i < j));
            }
        }
    }

    TEST_CASE("an owner is an ancestor, and forgotten when it no longer is") {
        register_types();
        Node top;
        Node& a = top.add_new<Node>("A");
        Node& a1 = a.add_new<Node>("A1");
        Node& a2 = a1.add_new<Node>("A2");
        REQUIRE(a1.set_owner(&top).ok());
        REQUIRE(a2.set_owner(&a1).ok());
        CHECK(!a.set_owner(&a1).ok());
        const Expected<std::unique_ptr<Node>> removed = top.remove_child(a);
        REQUIRE(removed.has_value());
        CHECK(a1.owner() == nullptr);
        CHECK(a2.owner() == &a1);
    }
}

TEST_SUITE("scene/main/node_path_lookup") {
    TEST_CASE("relative paths go down by name, up by two dots, and stay by one") {
        register_types();
        Node top;
        top.set_name("Top");
        Node& a = top.add_new<Node>("A");
        Node& b = a.add_new<Node>("B");
        Node& c = top.add_new<Node>("C");
        CHECK(top.get_node("A/B") == &b);
        CHECK(top.get_node("./A/./B") == &b);
        CHECK(b.get_node("../../C") == &c);
        CHECK(b.get_node(".") == &b);
        CHECK(b.get_node("..:visible") == &a);
        CHECK(top.get_node("..") == nullptr);
        CHECK(top.get_node("A/X/B") == nullptr);
        CHECK(top.get_node("/root/Top") == nullptr); // no tree
    }

    TEST_CASE("absolute paths start at the tree's root") {
        register_types();
        SceneTree tree;
        Node& main = tree.root().add_new<Node>("Main");
        Node& lamp = main.add_new<Node>("Lamp");
        CHECK(lamp.path().to_string() == "/root/Main/Lamp");
        CHECK(main.get_node("/root/Main/Lamp") == &lamp);
        CHECK(lamp.get_node("/root") == &tree.root());
        CHECK(lamp.get_node("/other/Main") == nullptr);
    }

    TEST_CASE("path_to() is the way that get_node() goes") {
        register_types();
        Node top;
        top.set_name("Top");
        Node& a = top.add_new<Node>("A");
        Node& a1 = a.add_new<Node>("A1");
        Node& b = top.add_new<Node>("B");
        Node& b1 = b.add_new<Node>("B1");
        const std::vector<Node*> all{&top, &a, &a1, &b, &b1};
        for (const Node* from : all) {
            for (Node* to : all) {
                CAPTURE(from->path_to(*to).to_string());
                CHECK(from->get_node(from->path_to(*to)) == to);
            }
        }
        CHECK(a1.path_to(b1).to_string() == "../../B/B1");
        const Node stranger;
        CHECK(a1.path_to(stranger).is_empty());
    }
}
