#include "servers/probe/probe_light.h"

#include <doctest/doctest.h>

#include <functional>
#include <string>

using namespace cl;

namespace {

constexpr RID kKey{3, 1};

ProbeLight make(const LightDesc& desc, bool visible = true, glm::vec3 position = {1.0f, 2.0f, 3.0f},
                const Transform& cells_from_world = {}) {
    Transform world_from_light;
    world_from_light.origin = position;
    return make_probe_light(kKey, desc, visible, world_from_light, cells_from_world);
}

LightDesc spot() {
    LightDesc desc;
    desc.type = LightType::Spot;
    return desc;
}

LightChanges between(const ProbeLight& before, const ProbeLight& now) {
    return compare_lights(std::span(&before, 1), std::span(&now, 1));
}

ProbeCauses just(ProbeCause cause) {
    ProbeCauses causes;
    causes.add(cause);
    return causes;
}

} // namespace

TEST_SUITE("servers/probe/probe_light") {
    TEST_CASE(
        "each change of a lit light has its own cause, takes the old light out and puts the new one in") {
        struct Change {
            ProbeCause cause;
            std::function<void(LightDesc&)> apply;
        };
        const Change changes[] = {
            {ProbeCause::LightRecoloured, [](LightDesc& d) { d.color.g = 0.5f; }},
            {ProbeCause::LightReenergised, [](LightDesc& d) { d.energy = 2.0f; }},
            {ProbeCause::LightReenergised, [](LightDesc& d) { d.indirect_energy = 2.0f; }},
            {ProbeCause::LightReshaped, [](LightDesc& d) { d.range_m = 9.0f; }},
            {ProbeCause::LightReshaped, [](LightDesc& d) { d.attenuation = 2.0f; }},
            {ProbeCause::LightReshaped, [](LightDesc& d) { d.spot_angle_deg = 20.0f; }},
            {ProbeCause::LightReshaped, [](LightDesc& d) { d.spot_angle_attenuation = 3.0f; }},
        };
        for (const Change& change : changes) {
            LightDesc desc = spot();
            const ProbeLight before = make(desc);
            change.apply(desc);
            const ProbeLight now = make(desc);
            const LightChanges found = between(before, now);
            CAPTURE(found.causes.to_string());
            CHECK(found.causes == just(change.cause));
            REQUIRE(found.edits.size() == 2);
            CHECK((found.edits[0].sign == -1 && found.edits[0].light == before.light));
            CHECK((found.edits[1].sign == +1 && found.edits[1].light == now.light));
        }
    }

    TEST_CASE("a light that moved and a probe that moved are told apart; both together are no change to the "
              "cells") {
        Transform shifted;
        shifted.origin = {-5.0f, 0.0f, 0.0f};
        const ProbeLight before = make(spot());
        CHECK(between(before, make(spot(), true, {6.0f, 2.0f, 3.0f})).causes == just(ProbeCause::LightMoved));
        CHECK(between(before, make(spot(), true, {1.0f, 2.0f, 3.0f}, shifted)).causes ==
              just(ProbeCause::ProbeMoved));
        const LightChanges both = between(before, make(spot(), true, {6.0f, 2.0f, 3.0f}, shifted));
        CHECK(!both.causes.any());
        CHECK(both.edits.empty());
    }

    TEST_CASE(
        "a light that comes, goes, hides, shows or is re-moded is put in or taken out once, and says why") {
        LightDesc disabled = spot();
        disabled.bake_mode = LightBakeMode::Disabled;
        const ProbeLight lit = make(spot()), hidden = make(spot(), false), off = make(disabled);
        const auto check = [](const LightChanges& found, ProbeCause cause, int sign) {
            CAPTURE(found.causes.to_string());
            CHECK(found.causes == just(cause));
            REQUIRE(found.edits.size() == 1);
            CHECK(found.edits[0].sign == sign);
        };
        check(compare_lights({}, std::span(&lit, 1)), ProbeCause::LightAdded, +1);
        check(compare_lights(std::span(&lit, 1), {}), ProbeCause::LightRemoved, -1);
        check(between(lit, hidden), ProbeCause::LightHidden, -1);
        check(between(hidden, lit), ProbeCause::LightShown, +1);
        check(between(lit, off), ProbeCause::LightRemoded, -1);
        check(between(off, lit), ProbeCause::LightRemoded, +1);
    }

    TEST_CASE("what a light that lights nothing does is no reason to relight") {
        LightDesc disabled = spot();
        disabled.bake_mode = LightBakeMode::Disabled;
        const ProbeLight hidden = make(spot(), false), moved = make(spot(), false, {9.0f, 9.0f, 9.0f}),
                         off = make(disabled);
        for (const LightChanges& found :
             {between(hidden, moved), between(hidden, off), between(off, hidden),
              compare_lights({}, std::span(&hidden, 1)), compare_lights(std::span(&off, 1), {})}) {
            CHECK(!found.causes.any());
            CHECK(found.edits.empty());
        }
    }

    TEST_CASE(
        "what a probe does not read of a light is no change: bake mode All, shadow, a directional's range") {
        LightDesc desc = spot();
        const ProbeLight before = make(desc);
        desc.bake_mode = LightBakeMode::All;
        desc.shadow = true;
        desc.negative = true;
        desc.cull_mask = 0;
        desc.specular = 0.0f;
        CHECK(!between(before, make(desc)).causes.any());

        LightDesc sun;
        sun.type = LightType::Directional;
        const ProbeLight sun_before = make(sun);
        sun.range_m = 77.0f;
        sun.attenuation = 3.0f;
        sun.spot_angle_deg = 10.0f;
        CHECK(!between(sun_before, make(sun)).causes.any());
    }

    TEST_CASE("another type under the same key is taken out and put in") {
        LightDesc omni;
        const LightChanges found = between(make(spot()), make(omni));
        CHECK(found.causes.has(ProbeCause::LightRetyped));
        CHECK(found.edits.size() == 2);
    }

    TEST_CASE("lists of lights are matched by key, whatever came or went between them") {
        const auto keyed = [](uint32_t slot) {
            ProbeLight light = make(spot());
            light.key = {slot, 1};
            return light;
        };
        const std::vector<ProbeLight> before{keyed(1), keyed(2), keyed(4), keyed(6)};
        const std::vector<ProbeLight> now{keyed(0), keyed(2), keyed(5), keyed(6), keyed(7)};
        int sum = 0;
        const LightChanges found = compare_lights(before, now);
        for (const LightEdit& edit : found.edits) {
            sum += edit.sign;
        }
        CHECK(found.edits.size() == 5); // out: 1, 4; in: 0, 5, 7
        CHECK(sum == 1);
    }

    TEST_CASE("causes are listed by name in a fixed order") {
        ProbeCauses causes;
        causes.add(ProbeCause::LightRecoloured);
        causes.add(ProbeCause::PropagationChanged);
        causes.add(ProbeCause::LightMoved);
        CHECK(causes.to_string() == "propagation changed, light moved, light recoloured");
        CHECK(ProbeCauses().to_string().empty());
    }
}
