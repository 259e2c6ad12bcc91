#include "tests/servers/probe_octree.h"
#include "tests/servers/server_fixture.h"

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <random>
#include <thread>
#include <vector>

using namespace cl;
using dummy::CallKind;
using tests::at;
using tests::ServerFixture;

namespace {

LightDesc lamp(float range_m = 14.0f) {
    LightDesc desc;
    desc.range_m = range_m;
    return desc;
}

/// A world with a probe of 1 m cells over a floor (world x in -8 to 8, y = -4, z in -4 to 4).
struct ProbeFixture : ServerFixture {
    RID base = server.gi_probe_create();
    RID probe = place(base);
    RID box = place_box(0, 0, 0);

    ProbeFixture() { REQUIRE(server.gi_probe_set_data(base, tests::floor_probe_data())); }

    /// All mips of the one volume, as they are now.
    std::vector<uint8_t> shown() {
        REQUIRE(dummy->volumes().size() == 1);
        std::vector<uint8_t> all;
        for (int mip = 0;; ++mip) {
            const std::span<const uint8_t> level = dummy->volume_texels(dummy->volumes().front(), mip);
            if (level.empty()) {
                return all;
            }
            all.insert(all.end(), level.begin(), level.end());
        }
    }
    /// Draws as long as the worker takes.
    void draw_until_settled(const std::function<void()>& after_each = [] {}) {
        constexpr int kMaxFrames = 10000;
        for (int frame = 0; frame < kMaxFrames && !server.is_settled(); ++frame) {
            draw();
            after_each();
            std::this_thread::sleep_for(std::chrono::milliseconds(1)); // lets it work where there is one core
        }
        REQUIRE(server.is_settled());
    }
    /// shown() after everything came to rest.
    std::vector<uint8_t> texels() {
        server.settle();
        REQUIRE(server.is_settled());
        return shown();
    }
};

/// What a history of edits leaves behind, enough to build the same world anew.
struct LightState {
    LightDesc desc;
    Transform place;
    bool visible = true;
    RID light, instance;
};

struct History {
    std::mt19937 random;
    ProbeFixture world;
    std::vector<LightState> lights;
    Transform probe_place;
    float propagation = 0.7f;
    int dynamic_range = 4;

    explicit History(unsigned seed) : random(seed) {}

    float number(float least, float most) {
        return std::uniform_real_distribution<float>(least, most)(random);
    }
    Transform place() {
        Transform t = at(number(-12, 12), number(-3, 4), number(-5, 5));
        t.basis = basis_from_euler_yxz({number(-2, 2), number(-3, 3), 0.0f});
        return t;
    }
    LightDesc desc() {
        LightDesc d;
        d.type = static_cast<LightType>(random() % 3);
        d.color = {number(0, 1), number(0, 1), number(0, 1), 1.0f};
        d.energy = number(0, 4);
        d.indirect_energy = number(0, 2);
        d.negative = random() % 8 == 0;
        d.range_m = number(1, 16);
        d.attenuation = number(0.2f, 3);
        d.spot_angle_deg = number(5, 85);
        d.spot_angle_attenuation = number(0.2f, 3);
        return d;
    }

    void edit() {
        VisualServer& server = world.server;
        const auto what = random() % 10;
        if (what == 0) {
            propagation = number(0, 1);
            REQUIRE(server.gi_probe_set_propagation(world.base, propagation));
        } else if (what == 1 && random() % 3 == 0) {
            dynamic_range = 1 + static_cast<int>(random() % 8);
            REQUIRE(server.gi_probe_set_dynamic_range(world.base, dynamic_range));
        } else if (what == 1 && random() % 2 == 0) {
            probe_place = random() % 2 ? place() : Transform{};
            REQUIRE(server.instance_set_transform(world.probe, probe_place));
        } else if (what <= 3 || lights.empty()) {
            LightState added{desc(), place(), true, {}, {}};
            added.light = server.light_create(added.desc);
            added.instance = world.place(added.light, added.place);
            lights.push_back(added);
        } else {
            edit_light(what);
        }
    }

    void edit_light(unsigned long what) {
        VisualServer& server = world.server;
        const size_t i = random() % lights.size();
        LightState& light = lights[i];
        switch (what) {
        case 4:
            REQUIRE(server.free(random() % 2 ? light.instance : light.light));
            lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(i));
            return;
        case 5:
            light.place = place();
            REQUIRE(server.instance_set_transform(light.instance, light.place));
            return;
        case 6:
            light.visible = !light.visible;
            REQUIRE(server.instance_set_visible(light.instance, light.visible));
            return;
        case 7:
            light.desc.bake_mode = static_cast<LightBakeMode>(random() % 3);
            break;
        case 8:
            light.desc.color = {number(0, 1), number(0, 1), number(0, 1), 1.0f};
            break;
        default:
            light.desc = desc();
            break;
        }
        REQUIRE(server.light_set(light.light, light.desc));
    }

    /// A world that never saw anything but the final state of these lights.
    std::vector<uint8_t> fresh_texels(const std::vector<LightState>& final_lights) const {
        ProbeFixture fresh;
        REQUIRE(fresh.server.gi_probe_set_propagation(fresh.base, propagation));
        REQUIRE(fresh.server.gi_probe_set_dynamic_range(fresh.base, dynamic_range));
        REQUIRE(fresh.server.instance_set_transform(fresh.probe, probe_place));
        for (const LightState& light : final_lights) {
            REQUIRE(
                fresh.server.instance_set_visible(fresh.place_light(light.desc, light.place), light.visible));
        }
        return fresh.texels();
    }
};

} // namespace

TEST_SUITE("servers/visual/probe_driver") {
    TEST_CASE("where frames are drawn on the CPU light is waited for, and else it never is") {
        for (const bool on_cpu : {false, true}) {
            CAPTURE(on_cpu);
            ProbeFixture f;
            f.dummy->set_draws_on_cpu(on_cpu ? 1e6 : 0.0);
            const RID light = f.place_light(lamp());
            f.server.settle();
            f.dummy->forget_calls();
            REQUIRE(f.server.instance_set_transform(light, at(0.1f, 0, 0)));
            f.draw();
            CHECK((f.dummy->count(CallKind::VolumeUpload) > 0) == on_cpu);
        }
    }

    TEST_CASE("after 200 random histories of edits the volume is, byte for byte, that of a fresh set-up") {
        int lit = 0;
        for (unsigned seed = 1; seed <= 200; ++seed) {
            CAPTURE(seed);
            History history(seed);
            const int steps = 4 + static_cast<int>(history.random() % 16);
            for (int step = 0; step < steps; ++step) {
                history.edit();
                switch (history.random() % 4) { // edits meet the machine in every stage
                case 0:
                    history.world.draw();
                    break;
                case 1:
                    history.world.server.settle();
                    break;
                default:
                    break;
                }
            }
            const std::vector<uint8_t> texels = history.world.texels();
            REQUIRE(texels.size() == 4u * (64 * 8 * 8 + 32 * 4 * 4 + 16 * 2 * 2 + 8));
            REQUIRE(texels == history.fresh_texels(history.lights));
            lit += texels != history.fresh_texels({}) ? 1 : 0;
        }
        CHECK(lit > 100); // in most histories lamps did reach the probe
    }

    TEST_CASE("drawing alone brings a change of light to the volume, and nothing is done when it is there") {
        ProbeFixture f;
        f.place_light(lamp());
        f.texels();
        f.dummy->forget_calls();
        f.draw();
        f.draw();
        CHECK(f.dummy->count(CallKind::VolumeUpload) == 0);
        f.place_light(lamp(), at(3.0f, 0.0f, 0.0f));
        CHECK(!f.server.is_settled());
        f.draw_until_settled();
        CHECK(f.dummy->count(CallKind::VolumeUpload) > 0);
        f.dummy->forget_calls();
        f.draw();
        CHECK(f.dummy->count(CallKind::VolumeUpload) == 0);
    }

    TEST_CASE("drawing while something has changed ends with all light drawn") {
        ProbeFixture f;
        for (float x : {0.0f, 3.0f}) {
            f.place_light(lamp(), at(x, 0.0f, 0.0f));
            f.dummy->forget_calls();
            while (f.server.has_changed()) {
                f.draw();
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            CHECK(f.server.is_settled());
            CHECK(f.dummy->count(CallKind::VolumeUpload) > 0);
            CHECK(f.dummy->calls().back().kind == CallKind::Draw);
        }
    }

    TEST_CASE("a volume is never seen half new: between two draws its bytes are the old or the new ones") {
        ProbeFixture f;
        const RID light = f.server.light_create(lamp());
        f.place(light);
        const std::vector<uint8_t> before = f.texels();
        LightDesc bright = lamp();
        bright.energy = 3.0f;
        REQUIRE(f.server.light_set(light, bright));
        std::vector<std::vector<uint8_t>> seen;
        f.draw_until_settled([&] { seen.push_back(f.shown()); });
        const std::vector<uint8_t> after = f.texels();
        CHECK(before != after);
        for (const std::vector<uint8_t>& texels : seen) {
            CHECK((texels == before || texels == after));
        }
    }

    TEST_CASE("every directional light and the local ones whose box touches the probe's light it; bake mode "
              "counts") {
        const auto texels_with = [](const LightDesc& desc, const Transform& place) {
            ProbeFixture f;
            f.place_light(desc, place);
            return f.texels();
        };
        const std::vector<uint8_t> unlit = ProbeFixture().texels();
        LightDesc sun;
        sun.type = LightType::Directional;
        Transform down = at(0.0f, 1000.0f, 0.0f); // a sun shines from anywhere
        down.basis = basis_from_euler_yxz({-1.5f, 0.0f, 0.0f});
        CHECK(texels_with(sun, down) != unlit);
        CHECK(texels_with(lamp(), at(0, 0, 0)) != unlit);
        CHECK(texels_with(lamp(2.0f), at(0, 20, 0)) == unlit);
        LightDesc disabled = lamp();
        disabled.bake_mode = LightBakeMode::Disabled;
        CHECK(texels_with(disabled, at(0, 0, 0)) == unlit);
        LightDesc all = lamp();
        all.bake_mode = LightBakeMode::All;
        CHECK(texels_with(all, at(0, 0, 0)) == texels_with(lamp(), at(0, 0, 0)));
    }

    TEST_CASE("a hidden probe keeps its light, so that it is right on the frame it is shown again") {
        ProbeFixture f;
        f.place_light(lamp());
        const std::vector<uint8_t> before = f.texels();
        REQUIRE(f.server.instance_set_visible(f.probe, false));
        f.server.settle();
        CHECK(f.draw().gi_probes.empty());
        REQUIRE(f.server.instance_set_visible(f.probe, true));
        CHECK(f.server.is_settled());
        CHECK(f.texels() == before);
    }

    TEST_CASE("two instances of one probe share its data and have a volume each") {
        ProbeFixture f;
        f.place(f.base, at(100, 0, 0));
        f.server.settle();
        CHECK(f.dummy->live().volumes == 2);
        REQUIRE(f.server.free(f.base));
        CHECK(f.dummy->live().volumes == 0);
    }

    TEST_CASE("a probe without data has no effect at all; an empty blob pairs as the null probe") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        const RID base = f.server.gi_probe_create();
        f.place(base);
        f.server.settle();
        CHECK(f.draw().gi_probes.empty());
        gi::ProbeData empty;
        empty.bounds = {glm::vec3(-2.0f), glm::vec3(4.0f)};
        REQUIRE(f.server.gi_probe_set_data(base, empty));
        CHECK(f.server.is_settled());
        REQUIRE(f.draw().gi_probes.size() == 1);
        CHECK(!f.draw().gi_probes[0].volume);
    }

    TEST_CASE("data that is not valid is refused with its reason and leaves the probe without effect") {
        ProbeFixture f;
        f.server.settle();
        const auto refused = [&f](const std::function<void(gi::ProbeData&)>& spoil) {
            gi::ProbeData data = tests::floor_probe_data();
            spoil(data);
            const Status status = f.server.gi_probe_set_data(f.base, data);
            REQUIRE(!status);
            CHECK(status.error().code == ErrorCode::ParseError);
            f.server.settle();
            CHECK(f.draw().gi_probes.empty());
            CHECK(f.dummy->live().volumes == 0);
            return status.error().message;
        };
        CHECK(refused([](gi::ProbeData& d) { d.cell_size_m = 0.0f; }) ==
              "GIProbeData.cell_size: expected a positive number, found 0");
        CHECK(refused([](gi::ProbeData& d) { d.dynamic_range = 0; }) ==
              "GIProbeData.dynamic_range: expected at least 1, found 0");
        CHECK(refused([](gi::ProbeData& d) { d.bounds.size.y = -1.0f; }) ==
              "GIProbeData.bounds: expected finite numbers and a size that is not negative");
        CHECK(refused([](gi::ProbeData& d) {
                  d.dynamic_data.resize(20);
              }).starts_with("dynamic_data: expected"));
        REQUIRE(f.server.gi_probe_set_data(f.base, tests::floor_probe_data()));
        f.texels();
    }

    TEST_CASE("the figures of a relight are those of the last round") {
        ProbeFixture f;
        const RID light = f.server.light_create(lamp());
        f.place(light);
        f.server.settle();
        const ServerStats first = f.server.stats();
        CHECK(first.relight_ms > 0.0);
        CHECK(first.upload_ms > 0.0);
        CHECK(first.relight_ms > first.upload_ms);
        f.draw();
        CHECK(f.server.stats().relight_ms == first.relight_ms);
        LightDesc bright = lamp();
        bright.energy = 2.0f;
        REQUIRE(f.server.light_set(light, bright));
        f.server.settle();
        CHECK(f.server.stats().relight_ms != first.relight_ms);
        CHECK(f.server.stats().lights == 1);
        CHECK(f.server.stats().instances == 1);
    }
}
