#include "tests/servers/radiosity/still_rooms.h"

#include "servers/radiosity/air_light.h"
#include "servers/radiosity/sky_bins.h"

#include "core/threads.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace cl;
using namespace cl::radiosity;
using namespace cl::tests;

namespace {

Transform turned(float angle_rad, const glm::vec3& euler = {0.3f, 0.0f, 0.2f}) {
    return {basis_from_euler_yxz({euler.x, angle_rad, euler.z}), {0.013f, -0.021f, 0.017f}};
}

constexpr float kRoom_m = 1.6f;

/// A room with one coloured wall, a block and a ball in it, lit by a lamp.
LitRoom furnished_room(const Transform& world_from_room, float cell_m) {
    RoomBuilder builder(world_from_room);
    const float scale = glm::length(world_from_room.basis[0]);
    const uint32_t white = builder.material(glm::vec3(0.7f)), red = builder.material({0.6f, 0.1f, 0.1f});
    builder.shell(white, kRoom_m, 0.2f);
    builder.box(red, {-0.72f, 0, 0}, {0.1f, 1.2f, 1.2f});
    builder.box(white, {0.3f, -0.55f, -0.2f}, {0.4f, 0.5f, 0.4f});
    builder.ball(white, {-0.2f, -0.5f, 0.3f}, 0.25f);
    const ProbeBox probe = probe_with_cells(cell_m * scale, 2.2f * scale, world_from_room.orthonormalized());
    return LitRoom(builder.take(), {&probe, 1});
}

Lighting lamp_in(const Transform& world_from_room) {
    Lighting lighting = darkness();
    lighting.sources = {
        omni_source(world_from_room.xform({0.1f, 0.5f, 0.1f}), 3.0f * glm::length(world_from_room.basis[0]))};
    return lighting;
}

/// Mean indirect light on what lies inside the room.
float mean_inside(const LitRoom& room, const Transform& world_from_room, const Solution& solution) {
    const Patches& patches = room.transport->patches;
    const Transform room_from_world = world_from_room.inverse();
    return mean_over(patches, solution.arriving, [&](uint32_t p) {
        const glm::vec3 at = glm::abs(room_from_world.xform(patches.position[p]));
        return std::max(at.x, std::max(at.y, at.z)) < 0.5f * kRoom_m + 1e-3f;
    });
}

float light_of(const Transform& world_from_room, float cell_m) {
    const LitRoom room = furnished_room(world_from_room, cell_m);
    return mean_inside(room, world_from_room, room.solve(lamp_in(world_from_room)));
}

} // namespace

TEST_SUITE("servers/radiosity/laws") {
    TEST_CASE("in a closed room of albedo a and emission e the radiance is e / (1 - a) everywhere") {
        for (float albedo : {0.2f, 0.5f, 0.8f, 0.95f}) {
            const Transform world_from_room = turned(albedo);
            RoomBuilder builder(world_from_room);
            const uint32_t wall = builder.material(glm::vec3(albedo), glm::vec3(0.5f));
            builder.shell(wall, kRoom_m, 0.2f);
            builder.box(wall, {0.2f, -0.5f, 0.1f}, {0.4f, 0.6f, 0.4f});
            const ProbeBox probe = probe_with_cells(0.1f, 2.4f, turned(0.4f));
            const LitRoom room(builder.take(), {&probe, 1});
            const Solution solution = room.solve(darkness());
            const float expected = 0.5f / (1.0f - albedo);
            CAPTURE(albedo);
            CHECK(mean_inside(room, world_from_room, solution) == doctest::Approx(expected).epsilon(0.01));
            float least = 1e30f, most = 0.0f;
            int lost = 0;
            for (const PixelLight& pixel :
                 pixel_lights(room, 0, solution, points_inside(world_from_room, kRoom_m, 40))) {
                least = pixel.found ? std::min(least, pixel.light.x) : least;
                most = std::max(most, pixel.light.x);
                lost += pixel.found ? 0 : 1;
            }
            CHECK(lost < 6 * 40 * 40 / 200); // slivers of cells in the edges
            CHECK(least > 0.92f * expected); // some rays into an edge find no patch
            CHECK(most < 1.02f * expected);  // points chosen on emitters err a little where all shines
        }
    }

    TEST_CASE("a convex body under an even sky receives the sky's radiance everywhere") {
        RoomBuilder builder;
        builder.ball(builder.material(glm::vec3(0.8f)), glm::vec3(0.0f), 0.5f);
        const ProbeBox probe = probe_with_cells(0.1f, 1.4f);
        const LitRoom room(builder.take(), {&probe, 1});
        Lighting lighting = darkness();
        std::fill(lighting.sky.begin(), lighting.sky.end(), glm::vec3(2.0f));
        const Solution solution = room.solve(lighting);
        for (const glm::vec3& light : solution.arriving) {
            CHECK(light.x == doctest::Approx(2.0f).epsilon(0.01));
        }
        const std::atomic<bool> go_on{false};
        for (const AirUse use : {AirUse::Gaps, AirUse::Things}) {
            const std::vector<AirPoints> air = make_air(*room.transport, use, go_on);
            const std::vector<AirLight> lit = light_air(air, lighting, solution)[0];
            for (const AirLight& light : lit) {
                CHECK(light.mean.x <= 2.01f); // the ball sends on 0.8 of it at most
            }
        }
    }

    TEST_CASE("faces of a box alone under a graded sky receive what the integral says") {
        RoomBuilder builder;
        builder.box(builder.material(glm::vec3(0.8f)), glm::vec3(0.0f), {0.9f, 0.7f, 0.5f});
        const ProbeBox probe = probe_with_cells(0.1f, 1.4f);
        const LitRoom room(builder.take(), {&probe, 1});
        Lighting lighting = darkness();
        for (uint32_t bin = 0; bin < kSkyBins; ++bin) {
            lighting.sky[bin] = glm::vec3(1.0f + sky_direction(bin).y);
        }
        const Solution solution = room.solve(lighting);
        for (size_t p = 0; p < solution.arriving.size(); ++p) {
            // The mean of the cosine to an axis over the hemisphere about n, weighted by the cosine, is 2/3
            // of that of n.
            const float expected = 1.0f + 2.0f / 3.0f * room.transport->patches.normal[p].y;
            CHECK(solution.arriving[p].x == doctest::Approx(expected).epsilon(0.01));
        }
        // Six lists for all of them.
        const Links& links = room.transport->records.links;
        CHECK(links.targets.size() < 10 * links.points[0].ray_count);
    }

    TEST_CASE("in a closed room of coloured walls each channel bounces until all its light is there") {
        RoomBuilder builder;
        const glm::vec3 albedo(0.9f, 0.5f, 0.1f);
        builder.shell(builder.material(albedo, glm::vec3(0.5f)), kRoom_m, 0.2f);
        const ProbeBox probe = probe_with_cells(0.1f, 2.4f);
        const LitRoom room(builder.take(), {&probe, 1});
        const Solution solution = room.solve(darkness());
        const std::vector<PixelLight> pixels =
            pixel_lights(room, 0, solution, points_inside({}, kRoom_m, 30));
        glm::vec3 mean(0.0f);
        for (const PixelLight& pixel : pixels) {
            mean += pixel.light / float(pixels.size());
        }
        for (int c = 0; c < 3; ++c) {
            CAPTURE(c);
            CHECK(mean[c] == doctest::Approx(0.5f / (1.0f - albedo[c])).epsilon(0.02));
        }
    }

    TEST_CASE("down a long white corridor light bounces until no more bounces would add to it") {
        RoomBuilder builder;
        const uint32_t white = builder.material(glm::vec3(0.85f)), red = builder.material({0.8f, 0.4f, 0.2f});
        for (float side : {-1.0f, 1.0f}) {
            builder.box(white, {0, 0.3f * side, 0}, {5.0f, 0.1f, 0.7f});
            builder.box(white, {0, 0, 0.3f * side}, {5.0f, 0.5f, 0.1f});
            builder.box(side < 0 ? red : white, {2.4f * side, 0, 0}, {0.1f, 0.5f, 0.5f});
        }
        const ProbeBox probe = probe_with_cells(0.05f, 1.0f);
        const LitRoom room(builder.take(), {&probe, 1});
        Lighting lighting = darkness();
        lighting.sources = {omni_source({-2.0f, 0.0f, 0.0f}, 1.0f)};
        const Solution once = room.solve(lighting);
        // Light adds up: what the far half has must be what it gets from all that its surroundings send out.
        const Transport& t = *room.transport;
        glm::dvec3 error(0.0), sum(0.0);
        for (size_t r = 0; r < t.records.patch.size(); ++r) {
            const Links::Point& point = t.records.links.points[r];
            const uint32_t p = t.records.patch[r];
            if (t.patches.position[p].x < 0.0f || point.ray_count == 0) {
                continue;
            }
            glm::dvec3 gathered(0.0);
            for (uint32_t target : t.records.links.patches_of(point)) {
                gathered += rgb(once.leaving[target]) / float(point.ray_count);
            }
            error += gathered - glm::dvec3(once.arriving[p]);
            sum += gathered;
        }
        for (int c = 0; c < 3; ++c) {
            CAPTURE(c);
            CHECK(error[c] / sum[c] == doctest::Approx(0.0).epsilon(0.01));
        }
    }

    TEST_CASE("interior probes get nothing from the sky") {
        RoomBuilder builder;
        builder.ball(builder.material(glm::vec3(0.8f)), glm::vec3(0.0f), 0.5f);
        const ProbeBox probe = probe_with_cells(0.1f, 1.4f);
        const LitRoom room(builder.take(), {&probe, 1});
        Lighting lighting = darkness();
        std::fill(lighting.sky.begin(), lighting.sky.end(), glm::vec3(2.0f));
        lighting.interior = {true};
        for (const glm::vec3& light : room.solve(lighting).arriving) {
            CHECK(light == glm::vec3(0.0f));
        }
    }

    TEST_CASE("light stays within 5 % when cells are halved and doubled") {
        const float fine = light_of(turned(0.2f), 0.04f);
        CHECK(light_of(turned(0.2f), 0.08f) == doctest::Approx(fine).epsilon(0.05));
        CHECK(light_of(turned(0.2f), 0.16f) == doctest::Approx(fine).epsilon(0.05));
    }

    TEST_CASE("a scene that is turned, mirrored, moved or scaled with its probe keeps its light within 2 %") {
        const float expected = light_of({}, 0.07f);
        CHECK(light_of(turned(0.5f), 0.07f) == doctest::Approx(expected).epsilon(0.02));
        CHECK(light_of(turned(2.5f, {-0.6f, 0.0f, 1.1f}), 0.07f) == doctest::Approx(expected).epsilon(0.02));
        Transform mirrored;
        mirrored.basis[0] = {-1, 0, 0};
        CHECK(light_of(mirrored, 0.07f) == doctest::Approx(expected).epsilon(0.02));
        CHECK(light_of({glm::mat3(1.0f), {100.0f, -50.0f, 30.0f}}, 0.07f) ==
              doctest::Approx(expected).epsilon(0.02));
        CHECK(light_of({glm::mat3(10.0f), {}}, 0.07f) == doctest::Approx(expected).epsilon(0.02));
        CHECK(light_of({glm::mat3(0.1f), {}}, 0.07f) == doctest::Approx(expected).epsilon(0.02));
    }

    TEST_CASE("where two probes overlap their light differs by less than 2 % on average") {
        RoomBuilder builder;
        const uint32_t white = builder.material(glm::vec3(0.7f));
        builder.shell(white, kRoom_m, 0.2f);
        const ProbeBox probes[] = {probe_with_cells(0.06f, 2.0f),
                                   probe_with_cells(0.06f, 2.0f, turned(0.4f))};
        const LitRoom room(builder.take(), probes);
        Lighting lighting = darkness(2);
        lighting.sources = {omni_source({0.2f, 0.5f, 0.1f}, 3.0f)};
        const Solution solution = room.solve(lighting);
        const std::vector<SurfacePoint> points = points_inside({}, kRoom_m, 30);
        const auto first = pixel_lights(room, 0, solution, points),
                   second = pixel_lights(room, 1, solution, points);
        double difference = 0.0, sum = 0.0;
        for (size_t i = 0; i < points.size(); ++i) {
            difference += std::abs(double(first[i].light.x - second[i].light.x));
            sum += double(first[i].light.x);
        }
        CHECK(difference / sum < 0.02);
    }

    TEST_CASE("beside surfaces the coarse air has the light of the fine air") {
        const LitRoom room = furnished_room({}, 0.1f);
        const Lighting lighting = lamp_in({});
        const Solution solution = room.solve(lighting);
        const std::atomic<bool> go_on{false};
        const std::vector<AirPoints> fine = make_air(*room.transport, AirUse::Things, go_on);
        const std::vector<AirPoints> coarse = make_air(*room.transport, AirUse::Gaps, go_on);
        const std::vector<AirLight> fine_light = light_air(fine, lighting, solution)[0];
        const std::vector<AirLight> coarse_light = light_air(coarse, lighting, solution)[0];
        double difference = 0.0, sum = 0.0;
        size_t seen = 0, fine_only = 0;
        for (size_t i = 0; i < fine_light.size(); ++i) {
            const bool is_coarse = coarse[0].links.points[i].ray_count > 0;
            const bool is_fine = fine[0].links.points[i].ray_count > 0;
            fine_only += is_fine && !is_coarse ? 1 : 0;
            if (is_coarse && is_fine) {
                ++seen;
                difference += std::abs(double(coarse_light[i].mean.x - fine_light[i].mean.x));
                sum += double(fine_light[i].mean.x);
            }
        }
        CHECK(seen > 100);
        CHECK(fine_only > seen / 10); // work is saved
        CHECK(difference / sum < 0.1);
    }

    TEST_CASE("the same bytes come out of one thread and of two, and of a second time") {
        const int threads = thread_count();
        const auto encoded = [](int count) {
            set_thread_count(count);
            const LitRoom room = furnished_room(turned(0.3f), 0.1f);
            const Lighting lighting = lamp_in(turned(0.3f));
            const Solution solution = room.solve(lighting);
            const std::atomic<bool> go_on{false};
            const std::vector<AirPoints> air = make_air(*room.transport, AirUse::Things, go_on);
            return std::pair(encode_field(room.map, solution),
                             encode_air(air, room.map, light_air(air, lighting, solution)));
        };
        const auto one = encoded(1);
        CHECK(one == encoded(2));
        CHECK(one == encoded(2));
        set_thread_count(threads);
    }

    TEST_CASE("light adds up: two lamps together give the sum of what each gives") {
        const LitRoom room = furnished_room({}, 0.1f);
        Lighting a = darkness(), b = darkness(), both = darkness();
        a.sources = {omni_source({0.1f, 0.5f, 0.1f}, 3.0f)};
        b.sources = {omni_source({-0.3f, 0.2f, 0.5f}, 2.0f)};
        both.sources = {a.sources[0], b.sources[0]};
        const Solution sa = room.solve(a), sb = room.solve(b), sum = room.solve(both);
        double error = 0.0, total = 0.0;
        for (size_t p = 0; p < sum.arriving.size(); ++p) {
            error += double(glm::length(sum.arriving[p] - sa.arriving[p] - sb.arriving[p]));
            total += double(glm::length(sum.arriving[p]));
        }
        CHECK(error < 2e-3 * total);
    }
}
