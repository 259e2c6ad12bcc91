#include "tests/servers/probe_octree.h"
#include "tests/servers/server_fixture.h"

#include "servers/visual/instance_storage.h"
#include "servers/visual/storage.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

using namespace cl;
using tests::at;

namespace {

/// The storage below the door, where pairs can be seen.
struct Pairs {
    dummy::DummyRasterizer rasterizer;
    Storage storage{rasterizer};
    InstanceStorage instances{storage, rasterizer};
    RID scenario = instances.make_scenario();
    RID box = storage.meshes.make({tests::box_surface()});

    RID place(RID base, const Transform& world_from_local = {}) {
        const RID rid = instances.make();
        instances.set_scenario(rid, scenario);
        instances.set_base(rid, base);
        instances.set_transform(rid, world_from_local);
        return rid;
    }
    RID probe_base() {
        const RID base = storage.gi_probes.make({});
        REQUIRE(set_probe_data(*storage.gi_probes.get(base), tests::make_probe_data({4, 4, 4}, {}),
                               storage.clock));
        return base;
    }
    RID light_base(LightType type = LightType::Omni, float range_m = 2.0f) {
        Light light;
        light.desc.type = type;
        light.desc.range_m = range_m;
        return storage.lights.make(light);
    }
    const std::vector<RID>& probes(RID mesh) {
        instances.update();
        return instances.get(mesh)->probes;
    }
    const std::vector<RID>& lights(RID mesh) {
        instances.update();
        return instances.get(mesh)->lights;
    }
};

using RIDs = std::vector<RID>;

} // namespace

TEST_SUITE("servers/visual/pairing") {
    TEST_CASE(
        "of probes that enter together the later ones pair first, wherever the mesh stands in the order") {
        for (int mesh_place : {0, 1, 3}) {
            Pairs p;
            RIDs order;
            RID mesh;
            for (int i = 0; i < 4; ++i) {
                if (i == mesh_place) {
                    mesh = p.place(p.box);
                }
                if (i < 3) {
                    order.push_back(p.place(p.probe_base()));
                }
            }
            CAPTURE(mesh_place);
            CHECK(p.probes(mesh) == RIDs{order[2], order[1], order[0]});
        }
    }

    TEST_CASE("probes that enter one after the other pair in that order") {
        Pairs p;
        const RID mesh = p.place(p.box);
        const RID first = p.place(p.probe_base());
        p.instances.update();
        const RID second = p.place(p.probe_base());
        CHECK(p.probes(mesh) == RIDs{first, second});
        // and a mesh that comes last finds them in the same order
        CHECK(p.probes(p.place(p.box)) == RIDs{first, second});
    }

    TEST_CASE("hiding a probe unpairs it, showing it puts it at the end, also within one frame") {
        Pairs p;
        const RID mesh = p.place(p.box);
        const RID a = p.place(p.probe_base()), b = p.place(p.probe_base());
        CHECK(p.probes(mesh) == RIDs{b, a});
        p.instances.set_visible(b, false);
        CHECK(p.probes(mesh) == RIDs{a});
        p.instances.set_visible(b, true);
        CHECK(p.probes(mesh) == RIDs{a, b});
        p.instances.set_visible(a, false);
        p.instances.set_visible(a, true);
        CHECK(p.probes(mesh) == RIDs{b, a});
    }

    TEST_CASE("three probes given new data in one frame pair as if they had just entered") {
        Pairs p;
        const RID mesh = p.place(p.box);
        RIDs bases, probes;
        for (int i = 0; i < 3; ++i) {
            bases.push_back(p.probe_base());
            probes.push_back(p.place(bases.back()));
            p.instances.update();
        }
        CHECK(p.probes(mesh) == probes);
        for (RID base : bases) {
            p.instances.probe_data_changed(base);
        }
        CHECK(p.probes(mesh) == RIDs{probes[2], probes[1], probes[0]});
    }

    TEST_CASE("a pair that lasts keeps its place while mesh and probe move") {
        Pairs p;
        const RID mesh = p.place(p.box);
        const RID first = p.place(p.probe_base());
        p.instances.update();
        const RID second = p.place(p.probe_base());
        p.instances.set_transform(first, at(0.5f, 0.0f, 0.0f));
        CHECK(p.probes(mesh) == RIDs{first, second});
        p.instances.set_transform(mesh, at(1.0f, 0.0f, 0.0f));
        CHECK(p.probes(mesh) == RIDs{first, second});
        p.instances.set_transform(first, at(50.0f, 0.0f, 0.0f));
        CHECK(p.probes(mesh) == RIDs{second});
        p.instances.set_transform(first, Transform{});
        CHECK(p.probes(mesh) == RIDs{second, first});
    }

    TEST_CASE(
        "boxes that merely touch pair; a hidden mesh or light pairs too; a directional light never does") {
        Pairs p;
        const RID mesh = p.place(p.box, at(2.5f, 0.0f, 0.0f)); // 2.0 to 3.0
        const RID touching = p.place(p.light_base(LightType::Omni, 2.0f));
        p.place(p.light_base(LightType::Omni, 1.99f));
        p.place(p.light_base(LightType::Directional));
        p.instances.set_visible(mesh, false);
        p.instances.set_visible(touching, false);
        CHECK(p.lights(mesh) == RIDs{touching});
    }

    TEST_CASE("a margin makes a mesh's box pair farther") {
        Pairs p;
        const RID mesh = p.place(p.box, at(4.0f, 0.0f, 0.0f));
        const RID light = p.place(p.light_base(LightType::Omni, 2.0f));
        CHECK(p.lights(mesh).empty());
        p.instances.set_extra_margin(mesh, 1.5f);
        CHECK(p.lights(mesh) == RIDs{light});
    }

    TEST_CASE("a light that becomes directional leaves every pair and comes back at the end") {
        Pairs p;
        const RID mesh = p.place(p.box);
        const RID base = p.light_base();
        const RID changing = p.place(base);
        p.instances.update();
        const RID other = p.place(p.light_base());
        CHECK(p.lights(mesh) == RIDs{changing, other});
        p.storage.lights.get(base)->desc.type = LightType::Directional;
        p.instances.base_changed(base);
        CHECK(p.lights(mesh) == RIDs{other});
        CHECK(p.instances.scenario(p.scenario)->directional_lights == RIDs{changing});
        p.storage.lights.get(base)->desc.type = LightType::Spot;
        p.instances.base_changed(base);
        CHECK(p.lights(mesh) == RIDs{other, changing});
        CHECK(p.instances.scenario(p.scenario)->directional_lights.empty());
    }

    TEST_CASE("after any history pairs are just the overlaps of the boxes") {
        std::mt19937 random(11);
        const auto place = [&random] {
            std::uniform_real_distribution<float> d(-12.0f, 12.0f);
            return at(d(random), d(random), 0.0f);
        };
        Pairs p;
        RIDs meshes, partners;
        for (int step = 0; step < 1500; ++step) {
            RIDs& some = random() % 3 == 0 ? partners : meshes;
            if (some.size() < 10 || random() % 12 == 0) {
                const RID base = &some == &meshes ? p.box : random() % 2 ? p.probe_base() : p.light_base();
                some.push_back(p.place(base, place()));
            } else if (random() % 12 == 0) {
                const size_t i = random() % some.size();
                REQUIRE(p.instances.free(some[i]));
                some.erase(some.begin() + static_cast<std::ptrdiff_t>(i));
            } else if (random() % 4 == 0) {
                const RID rid = some[random() % some.size()];
                p.instances.set_visible(rid, !p.instances.get(rid)->visible);
            } else {
                p.instances.set_transform(some[random() % some.size()], place());
            }
            if (step % 7 != 0) {
                continue;
            }
            p.instances.update();
            for (RID mesh : meshes) {
                const Instance& m = *p.instances.get(mesh);
                for (RID partner : partners) {
                    const Instance& other = *p.instances.get(partner);
                    const bool probe = other.kind == InstanceKind::GIProbe;
                    const RIDs& list = probe ? m.probes : m.lights;
                    const AABB box = *p.instances.world_bounds_of(other);
                    const bool expected = p.instances.world_bounds_of(m)->intersects_inclusive(box) &&
                                          (other.visible || !probe);
                    REQUIRE(std::count(list.begin(), list.end(), partner) == (expected ? 1 : 0));
                }
            }
        }
        CHECK(meshes.size() > 20);
        CHECK(partners.size() > 10);
    }
}
