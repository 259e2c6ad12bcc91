#include "core/expected.h"

#include <doctest/doctest.h>

namespace cl {

TEST_SUITE("core/expected") {
    TEST_CASE("an error prints its place and leaves out the parts that are not known") {
        CHECK(Error{ErrorCode::ParseError, "bad", {"a.tscn", 12, 9}}.to_string() ==
              "a.tscn:12:9: error: bad");
        CHECK(Error{ErrorCode::ParseError, "bad", {"a.tscn", 12, 0}}.to_string() == "a.tscn:12: error: bad");
        CHECK(Error{ErrorCode::ParseError, "bad", {"a.tscn", 0, 9}}.to_string() == "a.tscn: error: bad");
        CHECK(Error{ErrorCode::ParseError, "bad", {"", 12, 9}}.to_string() == "12:9: error: bad");
        CHECK(Error{ErrorCode::ParseError, "bad", {}}.to_string() == "error: bad");
    }

    TEST_CASE("an Expected gives its value by move and its error by reference") {
        Expected<std::string> text(std::string(100, 'x'));
        const std::string moved = *std::move(text);
        CHECK(moved.size() == 100);
        const Expected<std::string> failed(Error{ErrorCode::NotFound, "gone"});
        CHECK_FALSE(failed.has_value());
        CHECK(failed.error().code == ErrorCode::NotFound);
    }

    TEST_CASE("a Status is ok until it holds an error") {
        CHECK(Status().ok());
        CHECK_FALSE(Status(Error{ErrorCode::IoError, "disk"}).ok());
    }
}

} // namespace cl
