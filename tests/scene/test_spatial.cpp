#include "tests/scene/scene_fixture.h"

#include "scene/3d/omni_light.h"
#include "scene/3d/spatial.h"
#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

using namespace cl;
using namespace cl::scene;
using cl::tests::Journal;
using cl::tests::JournalScript;
using cl::tests::register_types;

namespace {

void check_close(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    CAPTURE(a.x);
    CAPTURE(a.y);
    CAPTURE(a.z);
    CAPTURE(b.x);
    CAPTURE(b.y);
    CAPTURE(b.z);
    CHECK(glm::length(a - b) < tolerance);
}

void check_close(const Transform& a, const Transform& b) {
    for (int i = 0; i < 3; ++i) {
        check_close(a.basis[i], b.basis[i]);
    }
    check_close(a.origin, b.origin);
}

const std::vector<Notification> kMoves{Notification::TransformChanged};

} // namespace

TEST_SUITE("scene/3d/spatial") {
    TEST_CASE("a global transform is the product of the chain of Spatial parents") {
        register_types();
        Spatial top;
        Spatial& middle = top.add_new<Spatial>("Middle");
        Spatial& bottom = middle.add_new<Spatial>("Bottom");
        top.set_rotation_degrees({0, 90, 0});
        middle.set_translation({1, 0, 0});
        bottom.set_scale({2, 3, 4});
        check_close(bottom.global_transform(), top.transform() * middle.transform() * bottom.transform());
        check_close(bottom.global_transform().origin, {0, 0, -1});
        top.set_translation({0, 7, 0}); // the cached value must follow
        check_close(bottom.global_transform().origin, {0, 7, -1});
    }

    TEST_CASE("a node that is no Spatial breaks the chain, of transforms and of visibility") {
        register_types();
        Spatial top;
        Spatial& below = top.add_new<Node>("Plain").add_new<Spatial>("Below");
        top.set_translation({5, 0, 0});
        top.set_visible(false);
        check_close(below.global_transform(), Transform());
        CHECK(below.is_visible_in_tree());
    }

    TEST_CASE("a global transform that was set is there, whatever the parent's is") {
        register_types();
        Spatial top;
        Spatial& node = top.add_new<Spatial>("Node");
        top.set_rotation_degrees({10, 20, 30});
        top.set_scale({2, 1, 0.5f});
        top.set_translation({1, 2, 3});
        Transform wanted;
        wanted.basis = basis_from_euler_yxz({0.3f, -0.2f, 0.1f});
        wanted.origin = {-4, 5, 6};
        CHECK(node.set_global_transform(wanted) == SetResult::Done);
        check_close(node.global_transform(), wanted);
        top.set_scale({1, 0, 1});
        CHECK(node.set_global_transform(wanted) == SetResult::Refused);
    }

    TEST_CASE("moving a node to another parent keeps its own transform") {
        register_types();
        Spatial a;
        Spatial b;
        a.set_translation({1, 0, 0});
        b.set_translation({0, 1, 0});
        Spatial& node = a.add_new<Spatial>("Node");
        Spatial& below = node.add_new<Spatial>("Below");
        node.set_translation({0, 0, 1});
        check_close(below.global_transform().origin, {1, 0, 1});
        Expected<std::unique_ptr<Node>> removed = a.remove_child(node);
        REQUIRE(removed.has_value());
        check_close(below.global_transform().origin, {0, 0, 1});
        REQUIRE(b.add_child(std::move(*removed)).ok());
        check_close(below.global_transform().origin, {0, 1, 1});
    }

    TEST_CASE("rotation and scale that were set come back as they were") {
        register_types();
        Spatial node;
        node.set_rotation_degrees({370, -45, 720});
        node.set_scale({2, -1, 0});
        check_close(node.rotation_degrees(), {370, -45, 720}, 1e-3f);
        check_close(node.scale(), {2, -1, 0});
        node.set_translation({1, 1, 1});
        check_close(node.rotation_degrees(), {370, -45, 720}, 1e-3f);
    }

    TEST_CASE("rotation and scale of a transform make that transform again") {
        register_types();
        for (const glm::vec3& scale : {glm::vec3(1), glm::vec3(2, 0.5f, 3), glm::vec3(-2)}) {
            for (const glm::vec3& euler_deg :
                 {glm::vec3(0), glm::vec3(20, 130, -70), glm::vec3(-89, 10, 0)}) {
                Spatial source;
                source.set_scale(scale);
                source.set_rotation_degrees(euler_deg);
                Spatial copy;
                copy.set_transform(source.transform());
                Spatial rebuilt;
                rebuilt.set_rotation_degrees(copy.rotation_degrees());
                rebuilt.set_scale(copy.scale());
                check_close(rebuilt.transform(), source.transform());
            }
        }
    }

    TEST_CASE("angles are applied about Z, then X, then Y") {
        register_types();
        Spatial node;
        node.set_rotation_degrees({90, 90, 0});
        // Y axis: to +Z by the turn about X, then to +X by the turn about Y.
        check_close(node.transform().basis * glm::vec3(0, 1, 0), {1, 0, 0});
    }

    TEST_CASE("a light takes no scale, neither its own nor its parents', and gives none on") {
        register_types();
        Spatial top;
        top.set_scale({2, 3, 4});
        top.set_rotation_degrees({0, 45, 0});
        OmniLight& lamp = top.add_new<OmniLight>("Lamp");
        lamp.set_scale({5, 5, 5});
        lamp.set_translation({1, 0, 0});
        const glm::mat3 basis = lamp.global_transform().basis;
        check_close(Transform{glm::transpose(basis) * basis, {}}, Transform());
        check_close(lamp.global_transform().origin, top.transform().xform({1, 0, 0}));
        const Spatial& below = lamp.add_new<Spatial>("Below");
        check_close(below.global_transform(), lamp.global_transform());
    }

    TEST_CASE("look_at() turns -Z to the point and keeps place, scale and up") {
        register_types();
        Spatial top;
        top.set_rotation_degrees({0, 30, 0});
        Spatial& node = top.add_new<Spatial>("Node");
        node.set_translation({1, 2, 3});
        node.set_scale({2, 2, 2});
        const glm::vec3 from = node.global_transform().origin;
        const glm::vec3 target{-3, 1, 8};
        node.look_at(target);
        check_close(glm::normalize(-node.global_transform().basis[2]), glm::normalize(target - from));
        check_close(node.global_transform().origin, from);
        check_close(node.scale(), {2, 2, 2});
        CHECK(node.global_transform().basis[1].y > 0.0f);
        CHECK(std::abs(node.global_transform().basis[0].y) < 1e-5f);
        const Transform before = node.transform();
        node.look_at(from);
        node.look_at(from + glm::vec3(0, 1, 0));
        CHECK(node.transform() == before);
    }

    TEST_CASE("moves are told once a step, to the node and to all chained below it") {
        register_types();
        Journal journal;
        SceneTree tree;
        Spatial& top = tree.root().add_new<Spatial>("Top");
        Spatial& below = top.add_new<Spatial>("Below");
        Spatial& other = tree.root().add_new<Spatial>("Other");
        for (Spatial* node : {&top, &below, &other}) {
            node->set_script_instance(std::make_unique<JournalScript>(journal, kMoves));
        }
        tree.step(0.1);
        journal.clear(); // all were told of where they started
        tree.step(0.1);
        CHECK(journal.empty());
        top.set_translation({1, 0, 0});
        top.set_translation({2, 0, 0});
        below.set_translation({2, 0, 0});
        tree.step(0.1);
        CHECK(journal == Journal{"transform Top", "transform Below"});
        journal.clear();
        below.set_translation({3, 0, 0});
        tree.step(0.1);
        CHECK(journal == Journal{"transform Below"});
    }

    TEST_CASE("a node that enters below one that has moved already is told of the next move") {
        register_types();
        Journal journal;
        SceneTree tree;
        Spatial& top = tree.root().add_new<Spatial>("Top");
        top.set_translation({1, 0, 0});
        Spatial& below = top.add_new<Spatial>("Below");
        below.set_script_instance(std::make_unique<JournalScript>(journal, kMoves));
        tree.step(0.1);
        CHECK(journal == Journal{"transform Below"});
        top.set_translation({2, 0, 0});
        tree.step(0.1);
        CHECK(journal.size() == 2);
    }

    TEST_CASE("a node that leaves and comes back is told once") {
        register_types();
        Journal journal;
        SceneTree tree;
        Spatial& node = tree.root().add_new<Spatial>("Node");
        node.set_script_instance(std::make_unique<JournalScript>(journal, kMoves));
        Expected<std::unique_ptr<Node>> removed = tree.root().remove_child(node);
        REQUIRE(removed.has_value());
        REQUIRE(tree.root().add_child(std::move(*removed)).ok());
        tree.step(0.1);
        CHECK(journal == Journal{"transform Node"});
    }

    TEST_CASE("hiding a node is told to all that are shown below it in the chain") {
        register_types();
        Journal journal;
        SceneTree tree;
        Spatial& top = tree.root().add_new<Spatial>("Top");
        Spatial& shown = top.add_new<Spatial>("Shown");
        Spatial& hidden = top.add_new<Spatial>("Hidden");
        Spatial& below_hidden = hidden.add_new<Spatial>("BelowHidden");
        hidden.set_visible(false);
        for (Spatial* node : {&top, &shown, &hidden, &below_hidden}) {
            node->set_script_instance(std::make_unique<JournalScript>(
                journal, std::vector<Notification>{Notification::VisibilityChanged}));
        }
        int signals = 0;
        REQUIRE(shown.connect("visibility_changed", [&](auto) { ++signals; }).has_value());
        top.set_visible(false);
        top.set_visible(false);
        CHECK(journal == Journal{"visibility Top", "visibility Shown"});
        CHECK(signals == 1);
        CHECK(!shown.is_visible_in_tree());
        CHECK(shown.is_visible());
        top.set_visible(true);
        CHECK(shown.is_visible_in_tree());
        CHECK(!below_hidden.is_visible_in_tree());
    }

    TEST_CASE("aliases of the transform are set by name and never stored") {
        register_types();
        Spatial node;
        CHECK(node.set("translation", glm::vec3(1, 2, 3)) == SetResult::Done);
        CHECK(node.set("rotation_degrees", glm::vec3(0, 90, 0)) == SetResult::Done);
        CHECK(node.set("scale", glm::vec3(2, 2, 2)) == SetResult::Done);
        const std::vector<Object::PropertyValue> stored = node.stored_properties();
        REQUIRE(stored.size() == 1);
        CHECK(stored[0].name.str() == "transform");
        CHECK(stored[0].value == Variant(node.transform()));
    }
}
