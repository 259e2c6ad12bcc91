#include "core/node_path.h"

#include <doctest/doctest.h>

namespace cl {
namespace {

std::string normalised(std::string_view text) {
    return NodePath(text).to_string();
}

} // namespace

TEST_SUITE("core/node_path") {
    TEST_CASE("a path splits into node names, sub-names and whether it is absolute") {
        const NodePath path("/root/Main:mesh:size");
        CHECK(path.is_absolute());
        CHECK(path.names() == std::vector<StringName>{"root", "Main"});
        CHECK(path.subnames() == std::vector<StringName>{"mesh", "size"});
        CHECK_FALSE(NodePath("../C").is_absolute());
        CHECK(NodePath("../C").names() == std::vector<StringName>{"..", "C"});
    }

    TEST_CASE("slashes after the first colon belong to the sub-name") {
        const NodePath path("Ray:material/0:shader_param/color");
        CHECK(path.names() == std::vector<StringName>{"Ray"});
        CHECK(path.subnames() == std::vector<StringName>{"material/0", "shader_param/color"});
    }

    TEST_CASE("printing gives the text back without empty names, as Godot does") {
        for (const char* same :
             {"A/B:prop:sub", "../C", "/root/Main", ".", "..", ":a:b", "/", "", "A b/C.001:x"}) {
            CHECK(normalised(same) == same);
        }
        CHECK(normalised("/root//x/") == "/root/x");
        CHECK(normalised("a/b:") == "a/b");
        CHECK(normalised("a::b") == "a:b");
    }

    TEST_CASE("only the path of no name that is not absolute is empty") {
        CHECK(NodePath().is_empty());
        CHECK(NodePath("").is_empty());
        CHECK_FALSE(NodePath("/").is_empty());
        CHECK_FALSE(NodePath(":a").is_empty());
        CHECK_FALSE(NodePath(".").is_empty());
    }

    TEST_CASE("paths are equal if their names are, not their spelling") {
        CHECK(NodePath("a//b") == NodePath("a/b"));
        CHECK_FALSE(NodePath("a/b") == NodePath("/a/b"));
        CHECK_FALSE(NodePath("a:b") == NodePath("a/b"));
    }
}

} // namespace cl
