#include "tests/servers/gi/volume_of.h"

#include "servers/cones/gather.h"

#include "core/threads.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace cl;
using tests::FilledVolume;

namespace {

const std::vector<glm::vec4> kSixCones{{0.0f, 0.0f, 1.0f, 0.25f},
                                       {0.866025f, 0.0f, 0.5f, 0.15f},
                                       {0.267617f, 0.823639f, 0.5f, 0.15f},
                                       {-0.700629f, 0.509037f, 0.5f, 0.15f},
                                       {-0.700629f, -0.509037f, 0.5f, 0.15f},
                                       {0.267617f, -0.823639f, 0.5f, 0.15f}};
const cones::ConeSettings kHigh{.cones = kSixCones, .tan_half_aperture = 0.577f};
const glm::vec4 kUntouched(-7.0f);

cones::Volume volume_of(const FilledVolume& filled) {
    cones::Volume volume(filled.sizes[0], int(filled.sizes.size()));
    for (size_t i = 0; i < filled.levels.size(); ++i) {
        volume.upload(int(i), glm::ivec3(0), filled.sizes[i], filled.levels[i]);
    }
    return volume;
}

/// A probe of `size` cells whose box begins at the origin; view space is cells.
cones::ConeProbe probe_of(const cones::Volume& volume) {
    const glm::vec3 size(volume.size(0));
    return {.volume = &volume,
            .bounds = size,
            .uv_from_cells = 1.0f / size,
            .multiplier = 1.0f,
            .bias = 1.5f,
            .reach = glm::length(size)};
}

/// Mostly empty, as rooms are.
FilledVolume sparse(int size) {
    std::mt19937 random(3);
    return {size, [&random](int level, int) {
                const auto some = [&random] { return uint8_t(random() % 120); };
                return level < 2 && random() % 8 != 0 ? glm::u8vec4(0)
                                                      : glm::u8vec4(some(), some(), some(), some());
            }};
}

struct Pixels {
    glm::ivec2 size;
    std::vector<glm::vec4> places, shapes, diffuse, specular;

    explicit Pixels(glm::ivec2 s)
        : size(s), places(size_t(s.x) * size_t(s.y)), shapes(places.size()),
          diffuse(places.size(), kUntouched), specular(places.size(), kUntouched) {}
    void gather(const cones::ConeSettings& settings, std::span<const cones::ConeSet> sets) {
        cones::gather_cones(settings, sets, {size, places, shapes, diffuse, specular});
    }
};

/// Points anywhere in a cube, turned anywhere; of set 1.
Pixels random_pixels(glm::ivec2 size, float cube) {
    std::mt19937 random(5);
    std::normal_distribution<float> n;
    std::uniform_real_distribution<float> in(0.02f * cube, 0.98f * cube), gloss(0.1f, 1.0f);
    Pixels pixels(size);
    for (size_t i = 0; i < pixels.places.size(); ++i) {
        pixels.places[i] = {in(random), in(random), in(random), 1.0f};
        pixels.shapes[i] =
            glm::vec4(glm::normalize(glm::vec3(n(random), n(random), n(random))), gloss(random));
    }
    return pixels;
}

/// What the twin of cone_trace.glsl gathers for one pixel (spec gi-shading section 4).
struct Twin {
    glm::vec4 diffuse{0.0f}, specular{0.0f};

    Twin(const gi::VolumeSampler& volume, const cones::ConeProbe& p, const glm::vec4& place,
         const glm::vec4& shape) {
        const glm::vec3 n(shape), offset = n * p.normal_bias, origin = glm::vec3(place) + offset;
        const glm::vec3 up = std::abs(n.z) < 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
        const glm::vec3 tangent = glm::normalize(glm::cross(up, n));
        const glm::mat3 frame(tangent, glm::normalize(glm::cross(tangent, n)), n);
        const auto add = [&](glm::vec4& sum, const glm::vec3& direction, float tan_half, float weight) {
            const glm::vec4 got =
                gi::trace_cone(volume, {origin, glm::normalize(direction), tan_half, p.bias, p.reach});
            const float met = p.blend_ambient ? std::min(1.0f, got.a / 0.95f) : 1.0f;
            sum += weight * glm::vec4(glm::vec3(got) * met, 1.0f - met);
        };
        for (const glm::vec4& cone : kSixCones) {
            add(diffuse, frame * glm::vec3(cone) - offset, 0.577f, cone.w);
        }
        const float rho = shape.w * shape.w;
        add(specular, glm::reflect(glm::normalize(glm::vec3(place)), n),
            std::tan(rho * 0.5f * 3.14159265f * 0.99f), 1.0f);
    }
};

float worst(const glm::vec4& a, const glm::vec4& b) {
    const glm::vec4 d = glm::abs(a - b);
    return std::max(std::max(d.x, d.y), std::max(d.z, d.w));
}

bool can() {
    if (!cones::can_gather()) {
        MESSAGE("skipped: this processor has no AVX2");
    }
    return cones::can_gather();
}

} // namespace

TEST_SUITE("servers/cones/gather") {
    TEST_CASE("points gather what the cones' twin gathers") {
        if (!can()) {
            return;
        }
        const FilledVolume filled = sparse(32);
        const cones::Volume volume = volume_of(filled);
        const gi::VolumeSampler twin = filled.sampler();
        for (const bool blend : {false, true}) {
            for (const float normal_bias : {0.0f, 0.4f}) {
                CAPTURE(blend);
                CAPTURE(normal_bias);
                cones::ConeSet set;
                set.probes[0] = probe_of(volume);
                set.probes[0].blend_ambient = blend;
                set.probes[0].normal_bias = normal_bias;
                Pixels pixels = random_pixels({23, 9}, 32.0f);
                pixels.gather(kHigh, {&set, 1});
                for (size_t i = 0; i < pixels.places.size(); ++i) {
                    CAPTURE(i);
                    const Twin expected(twin, set.probes[0], pixels.places[i], pixels.shapes[i]);
                    // The kernel filters in 8 bits: up to half of 1/255 a lerp, 7 lerps a sample; a cone has
                    // up to 20 samples here. And one that ends a sample earlier misses 0.05 of a texel.
                    CHECK(worst(pixels.diffuse[i], expected.diffuse) <= 0.02f);
                    CHECK(worst(pixels.specular[i], expected.specular) <= 0.06f);
                }
            }
        }
    }

    TEST_CASE("neighbours that share cells gather what each would alone") {
        if (!can()) {
            return;
        }
        // The eight of a block are in one cell of coarse levels, and seldom of fine ones.
        const FilledVolume filled = sparse(16);
        const cones::Volume volume = volume_of(filled);
        std::vector<cones::ConeSet> sets(2);
        sets[0].probes[0] = sets[1].probes[0] = probe_of(volume);
        Pixels together({16, 16});
        for (int i = 0; i < 256; ++i) {
            together.places[size_t(i)] = {2.0f + 0.2f * float(i % 16), 3.0f + 0.2f * float(i / 16), 5.0f,
                                          1.0f};
            together.shapes[size_t(i)] = {0.0f, 0.6f, 0.8f, 0.7f};
        }
        Pixels alone = together;
        together.gather(kHigh, sets);
        for (size_t i = 0; i < alone.places.size(); ++i) {
            Pixels one({1, 1});
            one.places[0] = alone.places[i];
            one.shapes[0] = alone.shapes[i];
            one.gather(kHigh, sets);
            CHECK(one.diffuse[0] == together.diffuse[i]);
            CHECK(one.specular[0] == together.specular[i]);
        }
        for (size_t i = 0; i < alone.places.size(); ++i) {
            alone.places[i].w = i % 2 ? 2.0f : 1.0f;
        }
        alone.gather(kHigh, sets);
        CHECK(alone.diffuse == together.diffuse);
        CHECK(alone.specular == together.specular);
    }

    TEST_CASE("where radiance is L times opacity a closed room gathers L") {
        if (!can()) {
            return;
        }
        const FilledVolume room(16, [](int, int) { return glm::u8vec4(100, 50, 0, 200); });
        const cones::Volume volume = volume_of(room);
        cones::ConeSet set;
        set.probes[0] = probe_of(volume);
        set.probes[0].blend_ambient = true;
        set.probes[0].multiplier = 4.0f;
        Pixels pixels = random_pixels({16, 16}, 16.0f);
        pixels.gather(kHigh, {&set, 1});
        for (size_t i = 0; i < pixels.places.size(); ++i) {
            // Two samples of 200/255 meet 0.953: nothing is left to what is beyond.
            CHECK(pixels.diffuse[i].r ==
                  doctest::Approx(4.0 * 0.5 * (1.0 - std::pow(55.0 / 255.0, 2.0))).epsilon(1e-4));
            CHECK(pixels.diffuse[i].g == doctest::Approx(0.5 * pixels.diffuse[i].r).epsilon(1e-4));
            CHECK(pixels.diffuse[i].a == doctest::Approx(0.0));
        }
    }

    TEST_CASE("an empty volume leaves everything to what is beyond it, as much as its multiplier says") {
        if (!can()) {
            return;
        }
        const cones::Volume volume({8, 8, 8}, 4);
        cones::ConeSet set;
        set.probes[0] = probe_of(volume);
        set.probes[0].blend_ambient = true;
        set.probes[0].multiplier = 3.0f; // known weakness 2 of the specification
        Pixels pixels = random_pixels({8, 8}, 8.0f);
        pixels.gather(kHigh, {&set, 1});
        for (size_t i = 0; i < pixels.places.size(); ++i) {
            CHECK(worst(pixels.diffuse[i], {0, 0, 0, 3}) < 1e-5f);
            CHECK(worst(pixels.specular[i], {0, 0, 0, 3}) < 1e-5f);
        }
    }

    TEST_CASE("points beyond a probe's bounds get nothing, and pixels without a set are not written") {
        if (!can()) {
            return;
        }
        const FilledVolume filled = sparse(16);
        const cones::Volume volume = volume_of(filled);
        cones::ConeSet set;
        set.probes[0] = probe_of(volume);
        Pixels pixels({3, 1});
        pixels.shapes.assign(3, {0, 1, 0, 0.5f});
        pixels.places = {{-0.1f, 8, 8, 1}, {8, 8, 8, 0}, {8, 8, 8, 2}}; // there is no second set
        pixels.gather(kHigh, {&set, 1});
        CHECK(pixels.diffuse[0] == glm::vec4(0.0f));
        CHECK(pixels.specular[0] == glm::vec4(0.0f));
        CHECK(pixels.diffuse[1] == kUntouched);
        CHECK(pixels.diffuse[2] == kUntouched);
    }

    TEST_CASE("places, normals and roughnesses that are no numbers end like any other") {
        if (!can()) {
            return;
        }
        const FilledVolume filled = sparse(16);
        const cones::Volume volume = volume_of(filled);
        cones::ConeSet set;
        set.probes[0] = probe_of(volume);
        const float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
        Pixels pixels({4, 1});
        pixels.places = {
            {nan, 8, 8, 1}, {8, 8, 8, 1}, {0, 0, 0, 1}, {8, 8, 8, 1}}; // the third: where the eye is
        pixels.shapes = {{0, 1, 0, 1}, {0, 0, 0, 1}, {0, 1, 0, 0.5f}, {0, 1, 0, inf}};
        pixels.gather(kHigh, {&set, 1});
        CHECK(pixels.diffuse[0] == glm::vec4(0.0f)); // lies in no probe
        CHECK(std::isfinite(pixels.diffuse[2].r));
        CHECK(std::isfinite(pixels.specular[3].r));
    }

    TEST_CASE("two probes are weighted by how far a point is from their faces") {
        if (!can()) {
            return;
        }
        const FilledVolume red(8, [](int, int) { return glm::u8vec4(255, 0, 0, 255); });
        const FilledVolume green(8, [](int, int) { return glm::u8vec4(0, 255, 0, 255); });
        const cones::Volume a = volume_of(red), b = volume_of(green);
        cones::ConeSet set;
        set.probes[0] = probe_of(a);
        set.probes[1] = probe_of(b);
        set.probes[1].cells_from_view =
            glm::translate(glm::mat4(1.0f), glm::vec3(-2, 0, 0)); // its box begins at x = 2
        Pixels pixels({1, 1});
        pixels.places[0] = {3, 4, 4, 1}; // 3 of 4 cells into the first, 1 of 4 into the second
        pixels.shapes[0] = {0, 1, 0, 1};
        pixels.gather(kHigh, {&set, 1});
        CHECK(pixels.diffuse[0].r == doctest::Approx(0.75));
        CHECK(pixels.diffuse[0].g == doctest::Approx(0.25));
        CHECK(pixels.specular[0].r == doctest::Approx(0.75));
    }

    TEST_CASE("volumes of any shape are filtered to their very edges") {
        if (!can()) {
            return;
        }
        // Texels are their own place, so that a filter's error is a place's.
        cones::Volume volume({16, 4, 1}, 1);
        std::vector<uint8_t> texels;
        for (int i = 0; i < 64; ++i) {
            texels.insert(texels.end(), {uint8_t(i % 16 * 16), uint8_t(i / 16 * 64), 77, 255});
        }
        volume.upload(0, glm::ivec3(0), {16, 4, 1}, texels);
        cones::ConeSet set;
        set.probes[0] = probe_of(volume);
        set.probes[0].bias = 0.0f; // one sample, of opacity 1, where the point is
        Pixels pixels = random_pixels({32, 32}, 1.0f);
        for (glm::vec4& place : pixels.places) {
            place = {place.x * 16.3f - 0.1f, place.y * 4.1f, 0.5f, 1.0f};
        }
        pixels.gather(kHigh, {&set, 1});
        for (size_t i = 0; i < pixels.places.size(); ++i) {
            const glm::vec4& place = pixels.places[i];
            const bool inside = place.x >= 0 && place.x <= 16 && place.y <= 4;
            const float x = std::clamp(place.x - 0.5f, 0.0f, 15.0f) * 16.0f / 255.0f;
            const float y = std::clamp(place.y - 0.5f, 0.0f, 3.0f) * 64.0f / 255.0f;
            const glm::vec4 expected = inside ? glm::vec4(x, y, 77.0f / 255.0f, 0.0f) : glm::vec4(0.0f);
            CHECK(worst(pixels.diffuse[i], expected) < 1.5f / 255.0f);
        }
    }

    TEST_CASE("the number of threads changes nothing") {
        if (!can()) {
            return;
        }
        const FilledVolume filled = sparse(32);
        const cones::Volume volume = volume_of(filled);
        cones::ConeSet set;
        set.probes[0] = probe_of(volume);
        Pixels one = random_pixels({70, 50}, 32.0f);
        Pixels four = one;
        const int before = thread_count();
        set_thread_count(1);
        one.gather(kHigh, {&set, 1});
        set_thread_count(4);
        four.gather(kHigh, {&set, 1});
        set_thread_count(before);
        CHECK(one.diffuse == four.diffuse);
        CHECK(one.specular == four.specular);
    }
}
