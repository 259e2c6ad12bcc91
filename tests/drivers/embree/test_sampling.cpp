#include "drivers/embree/ray_scene.h"
#include "drivers/embree/sampler.h"
#include "drivers/embree/sky_panorama.h"
#include "drivers/embree/texture.h"
#include "drivers/embree/warp.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <set>

using namespace cl;
using namespace cl::embree;

TEST_SUITE("drivers/embree/sampling") {
    TEST_CASE(
        "sixteen samples of any choice of any pixel fall one into each cell of a 4x4 grid and of 16x1") {
        for (uint32_t pixel : {0u, 1u, 12345u}) {
            for (int vertex : {0, 1, 40}) {
                for (Choice choice : {Choice::Pixel, Choice::Sky, Choice::Direction}) {
                    std::set<int> squares, columns;
                    for (uint32_t i = 0; i < 16; ++i) {
                        const glm::vec2 u = Sampler(3, pixel, i).pair(vertex, choice);
                        REQUIRE(u.x >= 0.0f);
                        REQUIRE(u.y >= 0.0f);
                        REQUIRE(u.x < 1.0f);
                        REQUIRE(u.y < 1.0f);
                        squares.insert(static_cast<int>(u.x * 4) * 4 + static_cast<int>(u.y * 4));
                        columns.insert(static_cast<int>(u.x * 16));
                    }
                    CHECK(squares.size() == 16);
                    CHECK(columns.size() == 16);
                }
            }
        }
    }

    TEST_CASE("pixels, choices, vertices and seeds have numbers of their own") {
        std::set<float> firsts;
        for (uint32_t seed = 0; seed < 4; ++seed) {
            for (uint32_t pixel = 0; pixel < 16; ++pixel) {
                for (int vertex = 0; vertex < 4; ++vertex) {
                    firsts.insert(Sampler(seed, pixel, 0).pair(vertex, Choice::Sky).x);
                    firsts.insert(Sampler(seed, pixel, 0).pair(vertex, Choice::Direction).x);
                }
            }
        }
        CHECK(firsts.size() > 4 * 16 * 4 * 2 - 3); // of 2^24 values two may agree
    }

    TEST_CASE("a basis is orthonormal and right-handed for every normal, the poles too") {
        for (const glm::vec3& raw : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(0, 1, 0),
                                     glm::vec3(1e-4f, 0, -1), glm::vec3(0.3f, -0.5f, 0.2f)}) {
            const Basis b(glm::normalize(raw));
            CHECK(glm::length(b.tangent) == doctest::Approx(1.0f));
            CHECK(std::abs(glm::dot(b.tangent, b.bitangent)) < 1e-5f);
            CHECK(glm::length(glm::cross(b.tangent, b.bitangent) - b.normal) < 1e-5f);
            const glm::vec3 v(0.1f, 0.7f, -0.4f);
            CHECK(glm::length(b.to_world(b.to_local(v)) - v) < 1e-5f);
        }
    }

    TEST_CASE("the power heuristic shares out one, to the surer way more") {
        for (float p : {1e-6f, 0.3f, 5.0f, 1e30f}) {
            for (float q : {1e-6f, 0.7f, 1e30f}) {
                CHECK(power_heuristic(p, q) + power_heuristic(q, p) == doctest::Approx(1.0f));
                CHECK((power_heuristic(p, q) > 0.5f) == (p > q));
            }
        }
        CHECK(power_heuristic(2.0f, 0.0f) == 1.0f);
    }

    TEST_CASE(
        "a sky's samples carry their density, and the mean of light over density is the light of all of it") {
        SkyDesc desc;
        desc.size = {32, 16};
        for (int i = 0; i < 32 * 16; ++i) {
            const float v = i == 200 ? 500.0f : 0.1f * static_cast<float>(1 + i % 5);
            desc.radiance.insert(desc.radiance.end(), {v, v, v});
        }
        const SkyPanorama sky(desc);
        double uniform = 0.0, drawn = 0.0;
        constexpr int kEdge = 400;
        for (int y = 0; y < kEdge; ++y) {
            for (int x = 0; x < kEdge; ++x) {
                const double tilt = 3.14159265358979 * (y + 0.5) / kEdge,
                             turn = 2 * 3.14159265358979 * x / kEdge;
                const glm::vec3 d(std::sin(tilt) * std::sin(turn), std::cos(tilt),
                                  -std::sin(tilt) * std::cos(turn));
                uniform += static_cast<double>(sky.radiance(d).x) * std::sin(tilt);
            }
        }
        uniform *= 2.0 * 3.14159265358979 * 3.14159265358979 / (kEdge * kEdge);
        constexpr uint32_t kSamples = 1 << 14;
        for (uint32_t i = 0; i < kSamples; ++i) {
            const SkyPanorama::Sample s = sky.sample(Sampler(0, 0, i).pair(0, Choice::Sky));
            REQUIRE(glm::length(s.direction) == doctest::Approx(1.0f));
            REQUIRE(s.pdf > 0.0f);
            if (i < 64) {
                CHECK(sky.pdf(s.direction) == doctest::Approx(s.pdf).epsilon(0.01));
            }
            drawn += static_cast<double>(sky.radiance(s.direction).x / s.pdf);
        }
        CHECK(drawn / kSamples == doctest::Approx(uniform).epsilon(0.01));
        desc.radiance.assign(desc.radiance.size(), 0.0f);
        CHECK(SkyPanorama(desc).is_black());
    }

    TEST_CASE("textures are linearised texel by texel, mixed between centres, and wrap as they are told") {
        Image image{{2, 1}, PixelFormat::RGBA8, {0, 0, 0, 255, 255, 188, 255, 255}};
        TextureParams params;
        const Texture color(image, params, TextureColorSpace::Srgb);
        CHECK(color.sample({0.75f, 0.5f}).g == doctest::Approx(linear_from_srgb(188.0f / 255.0f)));
        CHECK(color.sample({0.5f, 0.5f}).r == doctest::Approx(0.5f));
        CHECK(color.sample({0.0f, 0.5f}).r == doctest::Approx(0.5f)); // around the edge
        CHECK(color.sample({-1.25f, 7.5f}).r == doctest::Approx(1.0f));
        params.repeat = false;
        const Texture clamped(image, params, TextureColorSpace::Linear);
        CHECK(clamped.sample({0.0f, 0.5f}).r == 0.0f);
        CHECK(clamped.sample({9.0f, 0.5f}).g == doctest::Approx(188.0f / 255.0f));
        params.mirrored_repeat = true;
        params.filter = false;
        const Texture mirrored(image, params, TextureColorSpace::Linear);
        CHECK(mirrored.sample({1.25f, 0.5f}).r == 1.0f);
        CHECK(mirrored.sample({1.75f, 0.5f}).r == 0.0f);
        CHECK(mirrored.sample({NAN, 1e30f}).a == 1.0f); // no crash: any texel will do
    }

    TEST_CASE("a point moved off a surface lies beyond it, by little, near and far from the origin") {
        for (float scale : {1e-3f, 1.0f, 1e4f}) {
            const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.9f, 0.2f));
            const glm::vec3 point = scale * glm::vec3(0.7f, 0.2f, -0.5f);
            const float moved = glm::dot(offset_point(point, normal) - point, normal);
            CHECK(moved > 0.0f);
            CHECK(moved < 1e-4f * std::max(scale, 1.0f));
        }
    }
}
