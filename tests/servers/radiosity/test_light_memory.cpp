#include "tests/servers/radiosity/still_rooms.h"

#include "servers/radiosity/light_parts.h"
#include "servers/radiosity/solver.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <vector>

using namespace cl;
using namespace cl::radiosity;
using namespace cl::tests;

namespace {

const std::atomic<bool> kGoOn{false};

/// A room with a window and a block in it, one wall of which shines.
LitRoom room_with_window(const glm::vec3& emission) {
    RoomBuilder builder;
    const uint32_t white = builder.material(glm::vec3(0.7f));
    builder.box(white, {0, -0.7f, 0}, {1.4f, 0.1f, 1.4f});
    builder.box(white, {-0.7f, 0, 0}, {0.1f, 1.4f, 1.4f});
    builder.box(builder.material({0.6f, 0.2f, 0.1f}, emission), {0.7f, 0, 0}, {0.1f, 1.4f, 1.4f});
    builder.box(white, {0.2f, -0.4f, 0.1f}, {0.4f, 0.5f, 0.4f});
    const ProbeBox probe = probe_with_cells(0.1f, 1.8f);
    return LitRoom(builder.take(), {&probe, 1});
}

Source lamp(int number) {
    Source s = omni_source({0.05f * float(number % 9) - 0.3f, 0.5f, 0.04f * float(number % 7)}, 3.0f);
    s.radiance = {1.0f, 0.3f + 0.02f * float(number), 0.5f};
    return s;
}

Lighting lit_by(int lamps, float sky) {
    Lighting lighting = darkness();
    for (int i = 0; i < lamps; ++i) {
        lighting.sources.push_back(lamp(i));
    }
    std::fill(lighting.sky.begin(), lighting.sky.end(), glm::vec3(sky));
    return lighting;
}

bool same_bits(const Solution& a, const Solution& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    return same(a.arriving, b.arriving) && same(a.leaving, b.leaving);
}

} // namespace

TEST_SUITE("servers/radiosity/light_memory") {
    TEST_CASE("what was lit before changes no bit of what is lit now") {
        const LitRoom room = room_with_window(glm::vec3(0.2f));
        LightMemory memory;
        const auto check = [&](const Lighting& lighting) {
            CHECK(same_bits(solve(*room.transport, lighting, kGoOn, &memory), room.solve(lighting)));
        };
        Lighting lighting = lit_by(3, 0.5f);
        check(lighting);
        lighting.sources[1].radiance *= 1.7f;
        check(lighting);
        lighting.sources[2].position.x += 0.1f;
        check(lighting);
        lighting.sources[2].steady = false;
        check(lighting);
        lighting.sources[0].radiance = glm::vec3(0.0f);
        check(lighting);
        lighting.sources[0].radiance = {3.0f, 2.0f, -1.0f};
        check(lighting);
        lighting.sky.assign(lighting.sky.size(), glm::vec3(0.1f, 0.2f, 0.3f));
        check(lighting);
        lighting.sky_steady = false;
        check(lighting);
        lighting.interior = {true};
        check(lighting);
        std::swap(lighting.sources[0], lighting.sources[1]);
        check(lighting);
        lighting.sources[1] = lighting.sources[0]; // twice the same
        check(lighting);
        check(lit_by(40, 0.0f)); // more than are kept
        Lighting many = lit_by(40, 0.0f);
        many.sources[3].radiance *= 2.0f;
        check(many);
        many.sources[35].radiance *= 2.0f;
        check(many);
        check(darkness());
    }

    TEST_CASE("twice the radiance of all lamps is twice the light, to the bit") {
        const LitRoom room = room_with_window(glm::vec3(0.0f));
        for (int lamps : {1, 5, 36}) {
            CAPTURE(lamps);
            Lighting lighting = lit_by(lamps, 0.0f);
            const Solution once = room.solve(lighting);
            for (Source& source : lighting.sources) {
                source.radiance *= 2.0f;
            }
            const Solution twice = room.solve(lighting);
            size_t differing = 0, lit = 0;
            for (size_t p = 0; p < once.arriving.size(); ++p) {
                differing += twice.arriving[p] != 2.0f * once.arriving[p] ? 1 : 0;
                lit += once.arriving[p] != glm::vec3(0.0f) ? 1 : 0;
            }
            CHECK(differing == 0);
            CHECK(lit > once.arriving.size() / 4);
        }
    }

    TEST_CASE("light taken apart is the light of all together") {
        const LitRoom room = room_with_window(glm::vec3(0.2f));
        Lighting lighting = lit_by(4, 0.5f);
        const Solution apart = room.solve(lighting);
        for (Source& source : lighting.sources) {
            source.steady = false;
        }
        lighting.sky_steady = false;
        const Solution together = room.solve(lighting);
        double error = 0.0, total = 0.0;
        for (size_t p = 0; p < apart.arriving.size(); ++p) {
            error += double(glm::length(apart.arriving[p] - together.arriving[p]));
            total += double(glm::length(together.arriving[p]));
        }
        CHECK(error < 2e-4 * total);
    }
}

TEST_SUITE("servers/radiosity/light_parts") {
    TEST_CASE("each lamp is in one part, however many there are and whether they move") {
        for (int lamps : {0, 1, 16, 17, 50}) {
            CAPTURE(lamps);
            Lighting lighting = lit_by(lamps, 0.0f);
            for (size_t i = 0; i < lighting.sources.size(); i += 3) {
                lighting.sources[i].steady = false;
            }
            std::vector<int> count(size_t(lamps), 0);
            const std::vector<LightPart> parts = parts_of(lighting, Emission::None);
            for (const LightPart& part : parts) {
                REQUIRE(part.of.sources.size() == part.lamps.size());
                for (size_t i = 0; i < part.lamps.size(); ++i) {
                    ++count[part.lamps[i]];
                    CHECK(part.of.sources[i].radiance * part.weight ==
                          lighting.sources[part.lamps[i]].radiance);
                }
            }
            CHECK(std::count(count.begin(), count.end(), 1) == lamps);
            CHECK(parts.size() <= kMostLampsApart + 1);
        }
    }

    TEST_CASE("a dark sky over nothing that shines is no part, and no more than one part has the sky") {
        CHECK(parts_of(lit_by(0, 0.0f), Emission::None).empty());
        CHECK(parts_of(lit_by(0, 0.0f), Emission::Some).size() == 1);
        Lighting lighting = lit_by(2, 1.0f);
        for (const bool steady : {true, false}) {
            lighting.sky_steady = steady;
            const std::vector<LightPart> parts = parts_of(lighting, Emission::Some);
            CHECK(parts.size() == 3);
            CHECK(std::count_if(parts.begin(), parts.end(),
                                [](const LightPart& p) { return !p.of.sky.empty(); }) == 1);
        }
    }
}
