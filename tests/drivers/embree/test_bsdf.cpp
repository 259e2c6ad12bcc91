#include "drivers/embree/bsdf.h"
#include "drivers/embree/sampler.h"
#include "drivers/embree/warp.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

using namespace cl;
using namespace cl::embree;

namespace {

constexpr int kSamples = 1 << 14;

glm::vec2 pair(int i, uint32_t seed = 1) {
    return Sampler(seed, 0, static_cast<uint32_t>(i)).pair(0, Choice::Direction);
}
float number(int i) {
    return Sampler(1, 0, static_cast<uint32_t>(i)).pair(0, Choice::Lobe).x;
}

glm::vec3 eye_at(float cosine) {
    return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine};
}

std::vector<Bsdf> many_bsdfs() {
    std::vector<Bsdf> bsdfs;
    for (DiffuseMode mode : {DiffuseMode::Burley, DiffuseMode::Lambert, DiffuseMode::LambertWrap,
                             DiffuseMode::OrenNayar, DiffuseMode::Toon}) {
        for (float roughness : {0.0f, 0.2f, 0.5f, 1.0f}) {
            for (float metallic : {0.0f, 0.5f, 1.0f}) {
                Bsdf b;
                b.normal = {0, 0, 1};
                b.diffuse = glm::vec3(1.0f - metallic);
                b.f0 = glm::vec3(0.04f * (1.0f - metallic) + metallic);
                b.roughness = roughness;
                b.diffuse_mode = mode;
                bsdfs.push_back(b);
            }
        }
    }
    return bsdfs;
}

/// Share of light from all around that goes to the eye, by the surface's own samples.
float albedo_of(const Bsdf& bsdf, const glm::vec3& to_eye) {
    double sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        if (const auto s = sample_bsdf(bsdf, to_eye, number(i), pair(i))) {
            sum += static_cast<double>(s->scattering.sum().x / s->scattering.pdf);
        }
    }
    return static_cast<float>(sum / kSamples);
}

} // namespace

TEST_SUITE("drivers/embree/bsdf") {
    TEST_CASE("no white surface sends out more than it receives, but for the sheen of Burley's rough ones") {
        for (const Bsdf& bsdf : many_bsdfs()) {
            CAPTURE(static_cast<int>(bsdf.diffuse_mode));
            CAPTURE(bsdf.roughness);
            CAPTURE(bsdf.f0.x);
            // Burley 2012, section 5.3: his diffuse term gives back more at grazing angles where roughness is
            // high.
            const bool has_sheen = bsdf.diffuse_mode == DiffuseMode::Burley && bsdf.roughness > 0.5f;
            float mean = 0.0f; // over all eyes, by cosine
            for (float cosine : {0.05f, 0.15f, 0.25f, 0.35f, 0.45f, 0.55f, 0.65f, 0.75f, 0.85f, 0.95f}) {
                CAPTURE(cosine);
                const float albedo = albedo_of(bsdf, eye_at(cosine));
                CHECK(albedo <=
                      (has_sheen ? 1.5f : 1.03f)); // Fujii's Oren-Nayar and the fitted 1 - F: 2 % over
                mean += 0.2f * cosine * albedo;
            }
            CHECK(mean <= (has_sheen ? 1.045f : 1.002f));
        }
    }

    TEST_CASE("Lambert alone reflects exactly its albedo") {
        Bsdf bsdf;
        bsdf.normal = {0, 0, 1};
        bsdf.diffuse = glm::vec3(0.7f);
        bsdf.gloss = 0.0f;
        for (float cosine : {0.05f, 1.0f}) {
            CHECK(albedo_of(bsdf, eye_at(cosine)) == doctest::Approx(0.7f).epsilon(1e-4));
        }
    }

    TEST_CASE("samples come with the density that evaluation gives, and it counts all directions once") {
        for (const Bsdf& bsdf : many_bsdfs()) {
            CAPTURE(bsdf.roughness);
            CAPTURE(bsdf.f0.x);
            const glm::vec3 eye = eye_at(0.6f);
            double over_sphere = 0.0, by_samples = 0.0;
            for (int i = 0; i < kSamples; ++i) {
                const glm::vec3 l = cosine_hemisphere(pair(i, 2));
                if (l.z > 0.0f) {
                    const Scattering s = evaluate_bsdf(bsdf, eye, l);
                    over_sphere += static_cast<double>(s.sum().x * kPi / l.z);
                }
                if (const auto sample = sample_bsdf(bsdf, eye, number(i), pair(i))) {
                    const Scattering again = evaluate_bsdf(bsdf, eye, sample->direction);
                    REQUIRE(again.pdf == sample->scattering.pdf);
                    by_samples += static_cast<double>(again.sum().x / again.pdf);
                }
            }
            if (bsdf.roughness >= 0.5f) { // a narrower lobe is not found by cosine samples
                CHECK(over_sphere / kSamples == doctest::Approx(by_samples / kSamples).epsilon(0.03));
            }
        }
    }

    TEST_CASE("nothing is reflected from below, to below, or by black") {
        Bsdf bsdf;
        bsdf.normal = {0, 0, 1};
        bsdf.diffuse = glm::vec3(1.0f);
        bsdf.f0 = glm::vec3(0.04f);
        CHECK(evaluate_bsdf(bsdf, eye_at(0.5f), {0, 0, -1}).sum() == glm::vec3(0.0f));
        bsdf.diffuse = glm::vec3(0.0f);
        bsdf.gloss = 0.0f;
        CHECK_FALSE(sample_bsdf(bsdf, eye_at(0.5f), 0.3f, {0.3f, 0.6f}));
    }
}
