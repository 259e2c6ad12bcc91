#include "servers/radiosity/half4.h"

#include <doctest/doctest.h>
#include <glm/gtc/packing.hpp>

#include <cmath>
#include <cstdlib>
#include <random>

using namespace cl;

TEST_SUITE("servers/radiosity/half4") {
    TEST_CASE("four numbers are packed as each by itself") {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> exponent(-27.0f, 15.9f), sign(-1.0f, 1.0f);
        for (int i = 0; i < 100000; ++i) {
            gi::float4 v;
            for (int k = 0; k < 4; ++k) {
                v[k] = std::copysign(std::exp2(exponent(random)), sign(random));
            }
            const uint64_t packed = radiosity::pack_halves(v);
            for (int k = 0; k < 4; ++k) {
                CAPTURE(v[k]);
                const int half = int(packed >> (16 * k) & 0xFFFF), expected = int(glm::packHalf1x16(v[k]));
                const bool is_tiny = std::abs(v[k]) < 0x1p-14f; // glm rounds those twice
                CHECK(std::abs(half - expected) <= (is_tiny ? 1 : 0));
            }
        }
    }

    TEST_CASE("whole numbers up to 2048, zeros and the ends of the range are exact") {
        for (float v = 0.0f; v <= 2048.0f; ++v) {
            CHECK(glm::unpackHalf1x16(uint16_t(radiosity::pack_halves(gi::splat(v)))) == v);
            CHECK(glm::unpackHalf1x16(uint16_t(radiosity::pack_halves(gi::splat(-v)))) == -v);
        }
        for (float v : {65408.0f, 65504.0f, 0x1p-14f, 0x1p-24f, 0x1.ff8p-15f}) {
            CHECK(glm::unpackHalf1x16(uint16_t(radiosity::pack_halves(gi::splat(v)))) == v);
        }
    }
}
