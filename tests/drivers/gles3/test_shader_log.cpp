#include "drivers/gles3/gl/shader_log.h"

#include <doctest/doctest.h>

using namespace cl;
using namespace cl::gles3;

namespace {
constexpr std::string_view kFiles[] = {"shaders/scene.glsl", "shaders/lib/brdf.glsl"};
constexpr gl::ShaderSource kSource{.name = "scene", .vertex = "", .fragment = "", .files = kFiles};

std::string located(std::string_view log) {
    return gl::error_from_shader_log(log, kSource).to_string();
}
} // namespace

TEST_SUITE("drivers/gles3/gl/shader_log") {
    TEST_CASE("Mesa's and Khronos' forms lead to the file and line of the first error") {
        CHECK(located("1:12(34): error: `x' undeclared\n0:1(1): error: later\n") ==
              "shaders/lib/brdf.glsl:12: error: `x' undeclared");
        CHECK(located("ERROR: 0:7: 'x' : undeclared identifier\nERROR: 1 compilation errors.") ==
              "shaders/scene.glsl:7: error: 'x' : undeclared identifier");
    }

    TEST_CASE("warnings before an error are passed over") {
        CHECK(located("0:3(1): warning: `a' used uninitialized\n0:9(2): error: no `b'\n") ==
              "shaders/scene.glsl:9: error: no `b'");
    }

    TEST_CASE("a log of another form, of a file that there is not, or none at all, is given at the program's "
              "file") {
        CHECK(located("error: vertex shader output `v' missing\nmore") ==
              "shaders/scene.glsl: error: error: vertex shader output `v' missing");
        CHECK(located("9:1(1): error: x") == "shaders/scene.glsl: error: 9:1(1): error: x");
        CHECK(located("99999999999999999999:1: x") == "shaders/scene.glsl: error: 99999999999999999999:1: x");
        CHECK(located("") == "shaders/scene.glsl: error: the driver refused the program and gave no reason");
    }
}
