#include "core/diagnostics.h"

#include <doctest/doctest.h>

namespace cl {

TEST_SUITE("core/diagnostics") {
    TEST_CASE("a warning prints its place, the word warning and its message") {
        CHECK(Warning{{"a.tscn", 3, 1}, "odd"}.to_string() == "a.tscn:3:1: warning: odd");
    }

    TEST_CASE("of warnings with one key only the first is kept, of those without a key all") {
        Diagnostics diagnostics;
        diagnostics.warn({"a", 1, 1}, "first", "Spatial.foo");
        diagnostics.warn({"a", 2, 1}, "second", "Spatial.foo");
        diagnostics.warn({"a", 3, 1}, "third", "Spatial.bar");
        diagnostics.warn({"a", 4, 1}, "fourth");
        diagnostics.warn({"a", 4, 1}, "fourth");
        REQUIRE(diagnostics.warnings().size() == 4);
        CHECK(diagnostics.warnings()[0].message == "first");
        CHECK(diagnostics.warnings()[1].message == "third");
    }
}

} // namespace cl
