#include "demo/cli/time_left.h"

#include <doctest/doctest.h>

using cl::demo::time_left;

TEST_SUITE("demo/time_left") {
    TEST_CASE("the time left is what the rest takes at the pace so far, rounded up, and no guess") {
        CHECK(time_left(0.5f, 10.0) == "10 s left");
        CHECK(time_left(0.25f, 10.0) == "30 s left");
        CHECK(time_left(0.1f, 60.0) == "9 min left");
        CHECK(time_left(1.0f, 10.0) == "0 s left");
        CHECK(time_left(0.5f, 0.9) == "");
        CHECK(time_left(0.01f, 100.0) == "");
        CHECK(time_left(-1.0f, 100.0) == "");
    }
}
