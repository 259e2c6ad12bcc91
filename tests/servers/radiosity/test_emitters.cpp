#include "tests/servers/radiosity/still_rooms.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace cl;
using namespace cl::radiosity;
using namespace cl::tests;

namespace {

constexpr float kCell_m = 0.05f;

/// Form factor from a point of a floor to an upright rectangle that stands on it, the point before its middle
/// (Howell's catalogue of configuration factors, B-5, twice).
float upright_form_factor(float distance_m, float height_m, float half_length_m) {
    const float slant_m = std::hypot(distance_m, height_m);
    return (std::atan(half_length_m / distance_m) -
            distance_m / slant_m * std::atan(half_length_m / slant_m)) /
           std::numbers::pi_v<float>;
}

constexpr float kHalfWidth_m = 0.06f, kHalfLength_m = 1.5f;

/// A black floor with a strip of light of radiance 1 on it, along z.
LitRoom floor_with_strip(float height_m) {
    RoomBuilder builder;
    const uint32_t floor = builder.material(glm::vec3(0.0f));
    const uint32_t strip = builder.material(glm::vec3(0.0f), glm::vec3(1.0f));
    builder.box(floor, {0.0f, -0.1f, 0.0f}, {4.0f, 0.2f, 4.0f});
    builder.box(strip, {0.0f, 0.5f * height_m, 0.0f}, {2.0f * kHalfWidth_m, height_m, 2.0f * kHalfLength_m});
    const ProbeBox probe = probe_with_cells(kCell_m, 2.0f);
    return LitRoom(builder.take(), {&probe, 1});
}

/// Mean light of pixels of the floor at a distance from the strip, along its middle.
float light_beside(const LitRoom& room, const Solution& solution, float distance_m) {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 64; ++i) {
        points.push_back({{kHalfWidth_m + distance_m, 0.0f, (float(i) / 64.0f - 0.5f) * 0.8f}, {0, 1, 0}});
    }
    float sum = 0.0f;
    for (const PixelLight& pixel : pixel_lights(room, 0, solution, points)) {
        sum += pixel.light.x / float(points.size());
    }
    return sum;
}

} // namespace

TEST_SUITE("servers/radiosity/emitters") {
    TEST_CASE("beside strips of light of all heights a floor's light falls as the form factor does") {
        for (float height_cells : {0.5f, 1.2f, 4.0f}) {
            const LitRoom room = floor_with_strip(height_cells * kCell_m);
            const Solution solution = room.solve(darkness());
            // Nearer than two cells the mean of a cell and its slope are what can be shown.
            for (float cells : {2.0f, 3.0f, 4.0f, 5.5f, 8.0f, 11.0f, 14.0f, 18.0f}) {
                CAPTURE(height_cells);
                CAPTURE(cells);
                const float expected =
                    upright_form_factor(cells * kCell_m, height_cells * kCell_m, kHalfLength_m);
                CHECK(light_beside(room, solution, cells * kCell_m) ==
                      doctest::Approx(expected).epsilon(0.2));
            }
        }
    }

    TEST_CASE("the floor beside a strip of light gets all that the strip sends it") {
        for (float height_cells : {0.5f, 1.2f, 4.0f}) {
            const LitRoom room = floor_with_strip(height_cells * kCell_m);
            const Solution solution = room.solve(darkness());
            double found = 0.0, expected = 0.0;
            for (float cells = 0.125f; cells < 20.0f; cells += 0.25f) {
                found += double(light_beside(room, solution, cells * kCell_m));
                expected +=
                    double(upright_form_factor(cells * kCell_m, height_cells * kCell_m, kHalfLength_m));
            }
            CAPTURE(height_cells);
            CHECK(found == doctest::Approx(expected).epsilon(0.08));
        }
    }
}
