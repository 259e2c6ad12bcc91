#include "servers/render_types.h"
#include "servers/visual/box_tree.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

using namespace cl;

namespace {

struct World {
    BoxTree tree;
    struct Entry {
        BoxTree::Entry entry;
        AABB box;
        RID rid;
    };
    std::vector<Entry> boxes;
    uint32_t next = 1;

    void add(const AABB& box) {
        const RID rid{next++, 1};
        boxes.push_back({tree.insert(box, rid), box, rid});
    }
    std::set<RID> found(const AABB& box) const {
        std::set<RID> result;
        tree.overlapping(box, [&result](RID rid) { CHECK(result.insert(rid).second); });
        return result;
    }
    std::set<RID> expected(const AABB& box) const {
        std::set<RID> result;
        for (const Entry& e : boxes) {
            if (e.box.intersects_inclusive(box)) {
                result.insert(e.rid);
            }
        }
        return result;
    }
};

AABB random_box(std::mt19937& random) {
    // Whole numbers, so that boxes that merely touch are common.
    std::uniform_int_distribution<int> place(-20, 20), size(0, 5);
    const auto vec = [&random](auto& d) { return glm::vec3(d(random), d(random), d(random)); };
    return {vec(place), vec(size)};
}

} // namespace

TEST_SUITE("servers/visual/box_tree") {
    TEST_CASE("any history of inserts, moves and removals finds what a plain search finds") {
        std::mt19937 random(7);
        World world;
        for (int step = 0; step < 3000; ++step) {
            const auto what = random() % 10;
            if (what < 4 || world.boxes.empty()) {
                world.add(random_box(random));
            } else {
                World::Entry& entry = world.boxes[random() % world.boxes.size()];
                if (what < 8) {
                    entry.box = random_box(random);
                    world.tree.move(entry.entry, entry.box);
                } else {
                    world.tree.remove(entry.entry);
                    entry = world.boxes.back();
                    world.boxes.pop_back();
                }
            }
            if (step % 10 == 0) {
                const AABB wanted = random_box(random);
                REQUIRE(world.found(wanted) == world.expected(wanted));
                REQUIRE(world.tree.size() == world.boxes.size());
            }
        }
        CHECK(world.boxes.size() > 100); // the history did grow a tree
    }

    TEST_CASE("all() finds each box once, also after everything was removed") {
        World world;
        for (int i = 0; i < 200; ++i) {
            world.add({glm::vec3(static_cast<float>(i)), glm::vec3(1.0f)});
        }
        const auto count = [&world] {
            size_t n = 0;
            world.tree.all([&n](RID) { ++n; });
            return n;
        };
        CHECK(count() == 200);
        for (const World::Entry& e : world.boxes) {
            world.tree.remove(e.entry);
        }
        CHECK(count() == 0);
        CHECK(world.tree.size() == 0);
    }

    TEST_CASE("a box that is not finite is never found and hides no other") {
        World world;
        const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
        for (int i = 0; i < 100; ++i) {
            world.add({glm::vec3(static_cast<float>(i)), glm::vec3(0.5f)});
            world.tree.insert({glm::vec3(nan), glm::vec3(1.0f)}, RID{1000, 1});
            world.tree.insert({glm::vec3(0.0f), glm::vec3(inf)}, RID{1001, 1});
        }
        const AABB everything{glm::vec3(-1e6f), glm::vec3(2e6f)};
        CHECK(world.found(everything).size() == 100);
        CHECK(world.found({glm::vec3(nan), glm::vec3(1.0f)}).empty());
    }

    TEST_CASE("a query of one place among 10,000 looks at a hundredth of them at most") {
        World world;
        for (int i = 0; i < 10000; ++i) {
            world.add(
                {glm::vec3(static_cast<float>(i % 100) * 2.0f, 0.0f, static_cast<float>(i / 100) * 2.0f),
                 glm::vec3(1.0f)});
        }
        const AABB spot{glm::vec3(50.5f, 0.5f, 50.5f), glm::vec3(0.0f)};
        CHECK(world.found(spot).size() == 1);
        CHECK(world.tree.boxes_looked_at(spot) < 100);
    }

    TEST_CASE("the frustum of a matrix keeps what the matrix maps into the clip volume") {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> place(-30.0f, 30.0f), size(0.1f, 4.0f);
        CameraDesc camera;
        camera.far_m = 40.0f;
        const glm::mat4 clip_from_world = projection_matrix(camera, {160, 90});
        const Frustum frustum = frustum_from_clip(clip_from_world);
        int seen = 0, culled = 0;
        for (int i = 0; i < 5000; ++i) {
            const glm::vec3 p(place(random), place(random), place(random)), extent(size(random));
            const bool may = may_see(frustum, p, p + extent);
            bool inside = false; // some point of a grid in the box is in the clip volume
            for (int n = 0; n < 27; ++n) {
                const glm::vec3 corner = p + extent * glm::vec3(n % 3, n / 3 % 3, n / 9) * 0.5f;
                const glm::vec4 c = clip_from_world * glm::vec4(corner, 1.0f);
                inside = inside || (std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && std::abs(c.z) <= c.w);
            }
            REQUIRE((may || !inside));
            seen += inside ? 1 : 0;
            culled += may ? 0 : 1;
        }
        CHECK(seen > 100);
        CHECK(culled > 2000);
    }
}
