#include "tests/scene/scene_fixture.h"

#include "scene/main/scene_tree.h"

#include <doctest/doctest.h>

#include <functional>

using namespace cl;
using namespace cl::scene;
using cl::tests::Journal;
using cl::tests::JournalScript;
using cl::tests::register_types;

namespace {

const std::vector<Notification> kLife{Notification::EnterTree, Notification::Ready, Notification::ExitTree};

/// A node "name" that writes the wanted notifications into the journal.
std::unique_ptr<Node> journalled(std::string_view name, Journal& journal,
                                 std::vector<Notification> wanted = kLife) {
    auto node = std::make_unique<Node>();
    node->set_name(name);
    node->set_script_instance(std::make_unique<JournalScript>(journal, std::move(wanted)));
    return node;
}

/// Runs a function at each step.
class OnProcess final : public ScriptInstance {
public:
    explicit OnProcess(std::function<void(Node&)> f) : f_(std::move(f)) {}
    void process(Node& node, double) override { f_(node); }

private:
    std::function<void(Node&)> f_;
};

/// Runs a function on one kind of notification.
class On final : public ScriptInstance {
public:
    On(Notification what, std::function<void(Node&)> f) : what_(what), f_(std::move(f)) {}
    void notification(Node& node, Notification what) override {
        if (what == what_) {
            f_(node);
        }
    }

private:
    Notification what_;
    std::function<void(Node&)> f_;
};

} // namespace

TEST_SUITE("scene/main/scene_tree") {
    TEST_CASE("parents enter before children, children are ready before parents, and leave before them") {
        register_types();
        Journal journal;
        {
            SceneTree tree;
            std::unique_ptr<Node> a = journalled("A", journal);
            REQUIRE(a->add_child(journalled("A1", journal)).ok());
            REQUIRE(a->add_child(journalled("A2", journal)).ok());
            REQUIRE(a->children()[0]->add_child(journalled("A11", journal)).ok());
            REQUIRE(tree.set_scene(std::move(a)).ok());
            CHECK(journal == Journal{"enter A", "enter A1", "enter A11", "enter A2", "ready A11", "ready A1",
                                     "ready A2", "ready A"});
            journal.clear();
        }
        CHECK(journal == Journal{"exit A2", "exit A11", "exit A1", "exit A"});
    }

    TEST_CASE("a node is ready once in its life, however often it enters") {
        register_types();
        Journal journal;
        SceneTree tree;
        REQUIRE(tree.root().add_child(journalled("A", journal)).ok());
        Expected<std::unique_ptr<Node>> removed = tree.root().remove_child(*tree.root().get_node("A"));
        REQUIRE(removed.has_value());
        CHECK(!(*removed)->is_inside_tree());
        REQUIRE(tree.root().add_child(std::move(*removed)).ok());
        CHECK(journal == Journal{"enter A", "ready A", "exit A", "enter A"});
    }

    TEST_CASE("the signals of a node's life come with its notifications") {
        register_types();
        Journal journal;
        SceneTree tree;
        auto node = std::make_unique<Node>();
        for (const char* signal : {"tree_entered", "ready", "tree_exiting", "tree_exited"}) {
            REQUIRE(
                node->connect(signal, [&journal, signal](auto) { journal.push_back(signal); }).has_value());
        }
        Node& added = *node;
        REQUIRE(tree.root().add_child(std::move(node)).ok());
        REQUIRE(tree.root().remove_child(added).has_value());
        CHECK(journal == Journal{"tree_entered", "ready", "tree_exiting", "tree_exited"});
    }

    TEST_CASE("while a node notifies its children, changing them is refused and can be deferred") {
        register_types();
        SceneTree tree;
        Status refused;
        auto child = std::make_unique<Node>();
        child->set_name("Child");
        child->set_script_instance(std::make_unique<On>(Notification::Ready, [&](Node& self) {
            auto sibling = std::make_unique<Node>();
            sibling->set_name("Sibling");
            refused = self.parent()->add_child(std::move(sibling));
            CHECK(!self.parent()->remove_child(self).has_value());
            CHECK(!tree.root().remove_child(*tree.root().get_node("Parent")).has_value());
            self.tree()->defer([&self] { self.parent()->add_new<Node>("Later"); });
            self.add_new<Node>("Own"); // below itself it may
        }));
        auto parent = std::make_unique<Node>();
        parent->set_name("Parent");
        REQUIRE(parent->add_child(std::move(child)).ok());
        Node& p = *parent;
        REQUIRE(tree.set_scene(std::move(parent)).ok());
        REQUIRE(!refused.ok());
        CHECK(refused.error().message == "node 'Parent' is notifying its children: defer adding 'Sibling'");
        CHECK(p.get_node("Child/Own") != nullptr);
        CHECK(p.get_node("Child/Own")->is_ready());
        CHECK(p.get_node("Later") == nullptr);
        tree.step(0.1);
        CHECK(p.get_node("Later") != nullptr);
    }

    TEST_CASE("a child that a node adds to itself on entering enters once") {
        register_types();
        Journal journal;
        SceneTree tree;
        auto parent = std::make_unique<Node>();
        parent->set_script_instance(std::make_unique<On>(Notification::EnterTree, [&](Node& self) {
            CHECK(self.add_child(journalled("New", journal)).ok());
        }));
        REQUIRE(tree.set_scene(std::move(parent)).ok());
        CHECK(journal == Journal{"enter New", "ready New"});
    }

    TEST_CASE("nodes are processed by priority, then in tree order, with the step's time") {
        register_types();
        Journal journal;
        SceneTree tree;
        const std::vector<Notification> wanted{Notification::Process};
        REQUIRE(tree.root().add_child(journalled("A", journal, wanted)).ok());
        REQUIRE(tree.root().add_child(journalled("B", journal, wanted)).ok());
        REQUIRE(tree.root().get_node("A")->add_child(journalled("A1", journal, wanted)).ok());
        tree.step(0.25);
        CHECK(journal == Journal{"process A", "process A1", "process B"});
        CHECK(tree.delta_s() == 0.25);
        journal.clear();
        tree.root().get_node("B")->set_process_priority(-1);
        tree.root().get_node("A")->set_process_priority(5);
        tree.step(0.5);
        CHECK(journal == Journal{"process B", "process A1", "process A"});
        CHECK(tree.time_s() == 0.75);
        CHECK(tree.step_count() == 2);
        journal.clear();
        REQUIRE(tree.root().move_child(*tree.root().get_node("A"), 1).ok());
        tree.root().get_node("A")->set_process_priority(-1);
        tree.root().get_node("A/A1")->set_process(false);
        tree.step(0.5);
        CHECK(journal == Journal{"process B", "process A"});
    }

    TEST_CASE("nodes freed while the tree is processed go at the end of the step, those freed before it not "
              "at all") {
        register_types();
        Journal journal;
        SceneTree tree;
        auto killer = std::make_unique<Node>();
        killer->set_name("Killer");
        killer->set_script_instance(std::make_unique<OnProcess>([&](Node& self) {
            self.queue_free();
            self.queue_free();
            self.get_node("../Victim")->queue_free();
            self.get_node("../Victim/Below")->queue_free();
            journal.push_back("killed");
        }));
        REQUIRE(tree.root().add_child(std::move(killer)).ok());
        const std::vector<Notification> wanted{Notification::Process, Notification::ExitTree};
        REQUIRE(tree.root().add_child(journalled("Victim", journal, wanted)).ok());
        REQUIRE(tree.root().get_node("Victim")->add_child(journalled("Below", journal, wanted)).ok());
        REQUIRE(tree.root().add_child(journalled("Bystander", journal, {Notification::Process})).ok());
        tree.step(0.1);
        CHECK(journal == Journal{"killed", "process Victim", "process Below", "process Bystander",
                                 "exit Below", "exit Victim"});
        CHECK(tree.root().children().size() == 1);
        tree.step(0.1);
        CHECK(journal.back() == "process Bystander");
    }

    TEST_CASE("a node that another removes while the tree is processed is not processed any more") {
        register_types();
        Journal journal;
        SceneTree tree;
        std::unique_ptr<Node> kept;
        auto remover = std::make_unique<Node>();
        remover->set_script_instance(std::make_unique<OnProcess>([&](Node& self) {
            if (Node* next = self.get_node("../Next")) {
                kept = std::move(*self.parent()->remove_child(*next));
            }
            if (Node* last = self.get_node("../Last")) {
                CHECK(self.parent()->remove_child(*last).has_value()); // destroyed here
            }
        }));
        REQUIRE(tree.root().add_child(std::move(remover)).ok());
        REQUIRE(tree.root().add_child(journalled("Next", journal, {Notification::Process})).ok());
        REQUIRE(tree.root().add_child(journalled("Last", journal, {Notification::Process})).ok());
        tree.step(0.1);
        CHECK(journal.empty());
        REQUIRE(kept != nullptr);
        CHECK(!kept->is_inside_tree());
    }

    TEST_CASE("a pause stops the nodes that do not ask to go on") {
        register_types();
        Journal journal;
        SceneTree tree;
        const std::vector<Notification> wanted{Notification::Process, Notification::Paused,
                                               Notification::Unpaused};
        REQUIRE(tree.root().add_child(journalled("Game", journal, wanted)).ok());
        REQUIRE(tree.root().add_child(journalled("Menu", journal, wanted)).ok());
        REQUIRE(tree.root().get_node("Menu")->add_child(journalled("Item", journal, wanted)).ok());
        CHECK(tree.root().get_node("Menu")->set_pause_mode(PauseMode::Process) == SetResult::Done);
        tree.set_paused(true);
        tree.step(0.1);
        tree.set_paused(false);
        CHECK(journal == Journal{"paused Game", "process Menu", "process Item", "resumed Game"});
        CHECK(tree.root().set_pause_mode(static_cast<PauseMode>(7)) == SetResult::Refused);
    }

    TEST_CASE("what is deferred runs at the end of the step, and what that defers in the next one") {
        register_types();
        SceneTree tree;
        int runs = 0;
        std::function<void()> again = [&] {
            ++runs;
            tree.defer(again);
        };
        tree.defer(again);
        CHECK(runs == 0);
        tree.step(0.1);
        CHECK(runs == 1);
        tree.step(0.1);
        CHECK(runs == 2);
    }

    TEST_CASE("a deferred call of a node that is gone by then is dropped") {
        register_types();
        SceneTree tree;
        Node& a = tree.root().add_new<Node>("A");
        Node& b = tree.root().add_new<Node>("B");
        a.call_deferred("queue_free");
        b.call_deferred("queue_free");
        REQUIRE(tree.root().remove_child(b).has_value());
        tree.step(0.1); // asks A to be freed
        CHECK(tree.root().get_node("A") == nullptr);
    }

    TEST_CASE("outside of a tree queue_free() destroys at once") {
        register_types();
        Node parent;
        parent.add_new<Node>("A").queue_free();
        CHECK(parent.children().empty());
    }

    TEST_CASE(
        "a signal reaches a method of another node, with its arguments and binds, while that node lives") {
        register_types();
        SceneTree tree;
        Node& source = tree.root().add_new<Node>("Source");
        Node& target = tree.root().add_new<Node>("Target");
        REQUIRE(source.connect_method("renamed", target, "queue_free").ok());
        CHECK(!source.connect_method("no_such_signal", target, "queue_free").ok());
        source.set_name("X");
        CHECK(target.is_queued_for_deletion());
        tree.step(0.1);
        CHECK(tree.root().get_node("Target") == nullptr);
        source.set_name("Y"); // nobody listens any more

        Node& later = tree.root().add_new<Node>("Later");
        REQUIRE(source.connect_method("renamed", later, "queue_free", ConnectFlags::Deferred).ok());
        source.set_name("Z");
        CHECK(!later.is_queued_for_deletion());
        tree.step(0.1);
        CHECK(tree.root().get_node("Later") == nullptr);
    }

    TEST_CASE("another scene takes the place of the one before") {
        register_types();
        Journal journal;
        SceneTree tree;
        CHECK(tree.scene() == nullptr);
        REQUIRE(tree.set_scene(journalled("First", journal)).ok());
        REQUIRE(tree.set_scene(journalled("Second", journal)).ok());
        CHECK(journal == Journal{"enter First", "ready First", "exit First", "enter Second", "ready Second"});
        REQUIRE(tree.scene() != nullptr);
        CHECK(tree.scene()->name().str() == "Second");
        CHECK(tree.root().children().size() == 1);
    }
}

TEST_SUITE("scene/main/groups") {
    TEST_CASE("a group lists its nodes of the tree in tree order") {
        register_types();
        SceneTree tree;
        Node& b = tree.root().add_new<Node>("B");
        Node& b1 = b.add_new<Node>("B1");
        Node& a = tree.root().add_new<Node>("A");
        for (Node* node : {&b1, &a, &b}) {
            node->add_to_group("lamps");
            node->add_to_group("lamps");
        }
        CHECK(tree.nodes_in_group("lamps") == std::vector<Node*>{&b, &b1, &a});
        REQUIRE(tree.root().move_child(a, 0).ok());
        CHECK(tree.nodes_in_group("lamps") == std::vector<Node*>{&a, &b, &b1});
        b.remove_from_group("lamps");
        CHECK(tree.nodes_in_group("lamps") == std::vector<Node*>{&a, &b1});
        CHECK(!b.is_in_group("lamps"));
        CHECK(b1.is_in_group("lamps"));
        CHECK(tree.nodes_in_group("doors").empty());
    }

    TEST_CASE("membership is carried into the tree and out of it") {
        register_types();
        SceneTree tree;
        auto node = std::make_unique<Node>();
        node->add_to_group("lamps", GroupSaving::Saved);
        Node& lamp = *node;
        CHECK(tree.nodes_in_group("lamps").empty());
        REQUIRE(tree.root().add_child(std::move(node)).ok());
        CHECK(tree.nodes_in_group("lamps") == std::vector<Node*>{&lamp});
        const Expected<std::unique_ptr<Node>> removed = tree.root().remove_child(lamp);
        CHECK(tree.nodes_in_group("lamps").empty());
        REQUIRE(lamp.groups().size() == 1);
        CHECK(lamp.groups()[0].saving == GroupSaving::Saved);
    }

    TEST_CASE("calling a group calls each of its nodes, even those that the calls remove") {
        register_types();
        SceneTree tree;
        for (const char* name : {"A", "B", "C"}) {
            tree.root().add_new<Node>(name).add_to_group("doomed");
        }
        tree.call_group("doomed", "no_such_method");
        tree.call_group("doomed", "queue_free");
        tree.step(0.1);
        CHECK(tree.root().children().empty());
        CHECK(tree.nodes_in_group("doomed").empty());
    }
}
