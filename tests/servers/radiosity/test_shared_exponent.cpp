#include "servers/radiosity/shared_exponent.h"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace cl;
using radiosity::pack_shared_exponent;

/// OpenGL ES 3.0.6, section 3.8.3.2: decoding.
glm::vec3 unpacked(uint32_t word) {
    const float scale = std::exp2(float(word >> 27) - 15.0f - 9.0f);
    return glm::vec3(word & 511u, word >> 9 & 511u, word >> 18 & 511u) * scale;
}

} // namespace

TEST_SUITE("servers/radiosity/shared_exponent") {
    TEST_CASE("every channel comes back within half a step of the brightest one's scale") {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> exponent(-24.0f, 15.99f), share(0.0f, 1.0f);
        for (int i = 0; i < 20000; ++i) {
            const float brightest = std::exp2(exponent(random));
            const glm::vec3 color = brightest * glm::vec3(1.0f, share(random), share(random));
            const glm::vec3 back = unpacked(pack_shared_exponent(color));
            // 9 bits of mantissa above half of the scale; below 2^-15 the smallest exponent's step
            const float step =
                std::max(std::exp2(std::floor(std::log2(brightest)) - 8.0f), std::exp2(-24.0f));
            for (int c = 0; c < 3; ++c) {
                CAPTURE(color[c]);
                CHECK(std::abs(back[c] - color[c]) <=
                      step * 0.5001f + (back.x > brightest ? 0.5f * step : 0.0f));
            }
        }
    }

    TEST_CASE("a mantissa that would round up to 512 takes the next exponent") {
        CHECK(unpacked(pack_shared_exponent(glm::vec3(511.6f / 512.0f))) == glm::vec3(1.0f));
        CHECK(unpacked(pack_shared_exponent(glm::vec3(511.4f / 512.0f))) == glm::vec3(511.0f / 512.0f));
    }

    TEST_CASE("what the format cannot hold is taken to what it can") {
        CHECK(pack_shared_exponent(glm::vec3(0.0f)) == 0u);
        CHECK(pack_shared_exponent(glm::vec3(-1.0f)) == 0u);
        CHECK(unpacked(pack_shared_exponent({-3.0f, 1.0f, 0.0f})) == glm::vec3(0.0f, 1.0f, 0.0f));
        CHECK(unpacked(pack_shared_exponent(glm::vec3(1e9f))) == glm::vec3(65408.0f));
        CHECK(pack_shared_exponent(glm::vec3(std::numeric_limits<float>::denorm_min())) == 0u);
    }
}
