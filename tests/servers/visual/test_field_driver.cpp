#include "tests/servers/server_fixture.h"

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/visual/rest.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

using namespace cl;
using dummy::CallKind;
using tests::at;
using tests::ServerFixture;

namespace {

/// A probe around a box, in gi auto; the light's place and the box are the tests' to change.
struct FieldFixture : ServerFixture {
    RID box, lamp, lamp_desc_owner, probe_base, probe;
    LightDesc lamp_desc;

    FieldFixture() {
        set_gi(GIMode::Auto);
        box = place_box(0, 0, 0);
        REQUIRE(server.instance_set_use_in_baked_light(box, true));
        lamp_desc.type = LightType::Omni;
        lamp_desc.range_m = 8.0f;
        lamp_desc_owner = server.light_create(lamp_desc);
        lamp = place(lamp_desc_owner, at(1.5f, 1.5f, 1.5f));
        probe_base = server.gi_probe_create();
        gi::ProbeData data;
        data.bounds = {glm::vec3(-2.0f), glm::vec3(4.0f)};
        REQUIRE(server.gi_probe_set_data(probe_base, data));
        probe = place(probe_base);
    }
    /// Uploads of light that a change costs until all is at rest.
    template <typename F>
    size_t uploads_after(const F& change) {
        dummy->forget_calls();
        change();
        server.settle();
        return dummy->count(CallKind::FieldUpload);
    }
    uint64_t light_hash() {
        for (auto call = dummy->calls().rbegin(); call != dummy->calls().rend(); ++call) {
            if (call->kind == CallKind::FieldUpload) {
                return call->bytes_hash;
            }
        }
        return 0;
    }
};

} // namespace

TEST_SUITE("servers/visual/field_driver") {
    TEST_CASE("a field is made and lit once, and nothing changed is nothing done") {
        FieldFixture f;
        CHECK(f.uploads_after([] {}) == 1);
        CHECK(f.dummy->live().fields == 1);
        CHECK(f.dummy->live().volumes == 0); // the cones' volumes are not kept beside it
        f.dummy->forget_calls();
        f.draw();
        f.draw();
        f.server.settle();
        CHECK(f.dummy->count(CallKind::FieldUpload) == 0);
        CHECK(f.dummy->count(CallKind::FieldCreate) == 0);
        CHECK(f.server.is_settled());
    }

    TEST_CASE("what is drawn knows where its light is: still things on surfaces, others in the air") {
        FieldFixture f;
        const RID loose = f.place_box(1.2f, 0, 0);
        f.server.settle();
        const dummy::RecordedFrame& frame = f.draw();
        REQUIRE(frame.gi_probes.size() == 1);
        const GIProbeShading& shading = frame.gi_probes[0];
        CHECK(shading.field);
        CHECK(!shading.volume);
        CHECK(shading.field_cells == glm::vec3(128.0f));
        CHECK(shading.field_bricks == glm::ivec3(32));
        CHECK(glm::length(shading.field_cells_from_world.xform({0, 0, 0}) - glm::vec3(64.0f)) < 1e-3f);
        REQUIRE(frame.opaque.size() == 2);
        CHECK(frame.opaque[0].is_still != frame.opaque[1].is_still); // `loose` is not used in baked light
        REQUIRE(f.server.instance_set_use_in_baked_light(loose, true));
        f.server.settle();
        CHECK(f.draw().opaque[0].is_still);
        CHECK(f.draw().opaque[1].is_still);
    }

    TEST_CASE("any change of a light lights the field anew, without making it anew") {
        FieldFixture f;
        f.server.settle();
        const auto relit = [&](const auto& change) {
            const size_t uploads = f.uploads_after(change);
            return uploads == 1 && f.dummy->count(CallKind::FieldCreate) == 0;
        };
        CHECK(relit([&] { REQUIRE(f.server.instance_set_transform(f.lamp, at(-1.5f, 1.5f, 1.5f))); }));
        f.lamp_desc.energy = 3.0f;
        CHECK(relit([&] { REQUIRE(f.server.light_set(f.lamp_desc_owner, f.lamp_desc)); }));
        f.lamp_desc.color = {1, 0, 0, 1};
        CHECK(relit([&] { REQUIRE(f.server.light_set(f.lamp_desc_owner, f.lamp_desc)); }));
        CHECK(relit([&] { REQUIRE(f.server.instance_set_visible(f.lamp, false)); }));
        CHECK(relit([&] { REQUIRE(f.server.instance_set_visible(f.lamp, true)); }));
        f.lamp_desc.bake_mode = LightBakeMode::Disabled;
        CHECK(relit([&] { REQUIRE(f.server.light_set(f.lamp_desc_owner, f.lamp_desc)); }));
        CHECK(relit([&] { REQUIRE(f.server.gi_probe_set_interior(f.probe_base, true)); }));
    }

    TEST_CASE("a light switched off and on again ends in the bytes it began with") {
        FieldFixture f;
        f.server.settle();
        const uint64_t lit = f.light_hash();
        REQUIRE(f.server.instance_set_visible(f.lamp, false));
        f.server.settle();
        const uint64_t dark = f.light_hash();
        REQUIRE(f.server.instance_set_visible(f.lamp, true));
        f.server.settle();
        CHECK(dark != lit);
        CHECK(f.light_hash() == lit);
    }

    TEST_CASE("drawing while something has changed ends with all light drawn and all things at rest") {
        FieldFixture f;
        const auto draw_changes = [&f] {
            f.dummy->forget_calls();
            while (f.server.has_changed()) {
                f.draw();
                std::this_thread::sleep_for(std::chrono::milliseconds(1)); // lets the worker work
            }
            CHECK(f.server.is_settled());
            CHECK(f.dummy->count(CallKind::FieldUpload) > 0);
            CHECK(f.dummy->calls().back().kind == CallKind::Draw);
        };
        draw_changes();
        REQUIRE(f.server.instance_set_visible(f.lamp, false));
        draw_changes();
        REQUIRE(f.server.instance_set_transform(f.box, at(0.1f, 0, 0)));
        draw_changes();
        CHECK(f.draw().opaque.at(0).is_still);
    }

    TEST_CASE("a lamp that moved ends in the bytes of one that was always there, and then nothing is done") {
        FieldFixture f;
        f.server.settle();
        const uint64_t lit = f.light_hash();
        for (int i = 1; i <= 5; ++i) {
            REQUIRE(f.server.instance_set_transform(f.lamp, at(1.5f - 0.1f * float(i % 5), 1.5f, 1.5f)));
            f.draw();
        }
        f.server.settle();
        CHECK(f.light_hash() == lit);
        CHECK(f.uploads_after([&] {
            for (uint64_t i = 0; i < 2 * kRestSteps; ++i) {
                f.draw();
            }
        }) == 0);
    }

    TEST_CASE("where frames are drawn on the CPU light is waited for, and else it never is") {
        for (const bool on_cpu : {false, true}) {
            CAPTURE(on_cpu);
            FieldFixture f;
            f.dummy->set_draws_on_cpu(on_cpu ? 1e6 : 0.0);
            f.server.settle();
            f.dummy->forget_calls();
            REQUIRE(f.server.instance_set_transform(f.lamp, at(1.4f, 1.5f, 1.5f)));
            f.draw();
            CHECK((f.dummy->count(CallKind::FieldUpload) > 0) == on_cpu);
        }
    }

    TEST_CASE("what moves leaves the field until it rests") {
        FieldFixture f;
        f.server.settle();
        REQUIRE(f.server.instance_set_transform(f.box, at(0.1f, 0, 0)));
        CHECK(!f.draw().opaque.at(0).is_still); // at once: its patches are elsewhere
        f.server.settle();
        CHECK(f.draw().opaque.at(0).is_still);
        CHECK(f.dummy->live().fields == 1);
    }

    TEST_CASE("the air is gathered in full when something is to be lit by it, and once") {
        FieldFixture f;
        f.server.settle();
        const uint64_t coarse = f.light_hash();
        RID loose;
        CHECK(f.uploads_after([&] { loose = f.place_box(1.2f, 0, 0); }) == 1); // not used in baked light
        CHECK(f.dummy->count(CallKind::FieldCreate) == 0);
        CHECK(f.light_hash() != coarse);
        CHECK(f.uploads_after([&] { REQUIRE(f.server.instance_set_visible(loose, false)); }) == 0);
        CHECK(f.uploads_after([&] { REQUIRE(f.server.instance_set_visible(loose, true)); }) == 0);
        CHECK(f.server.is_settled());
    }

    TEST_CASE("shaders are compiled while the first light is made, and nothing drawn then is shown") {
        FieldFixture f;
        f.dummy->forget_calls();
        f.server.settle();
        CHECK(f.dummy->count(CallKind::Draw) == 1);
        CHECK(!f.server.viewport_read(f.viewport, TargetFormat::Srgb8));
        f.draw();
        f.dummy->forget_calls();
        REQUIRE(f.server.instance_set_transform(f.box, at(0.1f, 0, 0)));
        f.server.settle();
        CHECK(f.dummy->count(CallKind::Draw) == 0); // what is drawn is drawn with what is there
    }

    TEST_CASE("energy is read live") {
        FieldFixture f;
        f.server.settle();
        REQUIRE(f.server.gi_probe_set_energy(f.probe_base, 2.5f));
        CHECK(f.uploads_after([&] { CHECK(f.draw().gi_probes.at(0).multiplier == 2.5f); }) == 0);
    }

    TEST_CASE("probes that go take their field along, even while it is being made") {
        for (const bool in_flight : {false, true}) {
            CAPTURE(in_flight);
            FieldFixture f;
            if (in_flight) {
                f.draw();
            } else {
                f.server.settle();
            }
            REQUIRE(f.server.free(f.probe));
            f.server.settle();
            CHECK(f.dummy->live().fields == 0);
            CHECK(!f.draw().opaque.at(0).is_still);
        }
    }

    TEST_CASE("numbers that are not finite light nothing and break nothing") {
        FieldFixture f;
        f.server.settle();
        f.lamp_desc.energy = std::numeric_limits<float>::infinity();
        (void)f.server.light_set(f.lamp_desc_owner, f.lamp_desc);
        f.server.settle();
        f.draw();
        CHECK(f.server.is_settled());
    }
}
