#include "core/digest.h"

#include <doctest/doctest.h>

#include <vector>

using namespace cl;

TEST_SUITE("core/digest") {
    TEST_CASE("a digest tells numbers, their order and where spans end apart, and nothing else") {
        const std::vector<uint8_t> a{1, 2, 3}, b{4, 5}, whole{1, 2, 3, 4, 5}, none;
        const auto of = [](std::span<const uint8_t> first, std::span<const uint8_t> second) {
            return Digester().add(first).add(second).digest();
        };
        CHECK(of(a, b) == of(std::vector<uint8_t>(a), std::vector<uint8_t>(b)));
        CHECK(of(a, b) != of(b, a));
        CHECK(of(a, b) != of(whole, none));
        CHECK(of(none, whole) != of(whole, none));
        CHECK(Digester().add(0.0f).digest() != Digester().add(-0.0f).digest());
        CHECK(Digester().add(uint16_t(1)).digest() != Digester().add(uint32_t(1)).digest());
    }
}
