#include "tests/shared_dir.h"

#include "core/io/file.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

using namespace cl;
namespace fs = std::filesystem;

namespace {

/// A folder with one shader and one library, and the build step run on it.
class Shaders {
public:
    Shaders() : folder_(fs::temp_directory_path() / ("shader_table_" + std::to_string(std::rand()))) {
        fs::create_directories(folder_ / "lib");
    }
    ~Shaders() { fs::remove_all(folder_); }
    Shaders(const Shaders&) = delete;
    Shaders& operator=(const Shaders&) = delete;

    void write(const std::string& name, const std::string& text) {
        REQUIRE(write_file_atomic(folder_ / name, text));
    }
    /// What the check of `text` as x.glsl prints, with the folder's name taken out.
    std::string check(const std::string& text) {
        write("x.glsl", text);
        return run("check " + (folder_ / "ok").string() + " " + (folder_ / "x.glsl").string());
    }
    /// The header made of it.
    std::string header(const std::string& text) {
        write("x.glsl", text);
        const std::string said = run("table " + (folder_ / "x.h").string() + " " +
                                     (folder_ / "x.cpp").string() + " " + (folder_ / "x.glsl").string());
        CHECK(said.empty());
        const Expected<std::string> made = read_text_file(folder_ / "x.h");
        REQUIRE(made);
        return *made;
    }

private:
    std::string run(const std::string& arguments) {
        const fs::path script = tests::repository_dir() / "drivers/gles3/shader_table.py";
        const std::string command = "/usr/bin/python3 -B " + script.string() + " " + arguments + " 2>&1";
        std::FILE* pipe = popen(command.c_str(), "r");
        REQUIRE(pipe != nullptr);
        std::string text;
        std::array<char, 512> part{};
        while (std::fgets(part.data(), part.size(), pipe)) {
            text += part.data();
        }
        pclose(pipe);
        const std::string prefix = folder_.string() + "/";
        for (size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
            text.erase(at, prefix.size());
        }
        return text;
    }
    fs::path folder_;
};

const std::string kVertex = "#pragma stage vertex\nvoid main() { gl_Position = vec4(0.0); }\n";
const std::string kFragment =
    "#pragma stage fragment\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(1.0); }\n";
const std::string kRight = "#pragma validate\n" + kVertex + kFragment;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_SUITE("drivers/gles3/shader_table") {
    TEST_CASE("a right program passes without a word") {
        CHECK(Shaders().check(kRight).empty());
    }

    TEST_CASE("what the format forbids is refused with its place") {
        Shaders s;
        CHECK(s.check(kVertex + kFragment) ==
              "x.glsl:1: error: expected at least one `#pragma validate` line, found none\n");
        CHECK(s.check("#pragma validate\n" + kVertex) ==
              "x.glsl:1: error: expected a main() after `#pragma stage fragment`, found none\n");
        CHECK(s.check("#version 300 es\n" + kRight) ==
              "x.glsl:1: error: expected no #version (the build puts it in front), found one\n");
        CHECK(s.check("#pragma flags gray\n" + kRight) ==
              "x.glsl:1: error: expected a new flag in capitals, found \"gray\"\n");
        CHECK(s.check("#pragma validate GRAY\n" + kRight) ==
              "x.glsl:1: error: expected a flag of this program, found \"GRAY\"\n");
        CHECK(s.check("#pragma stage geometry\n" + kRight) ==
              "x.glsl:1: error: expected a stage, vertex or fragment, found \"geometry\"\n");
        CHECK(s.check("#include \"lib/none.glsl\"\n" + kRight) ==
              "x.glsl:1: error: expected a file of the shaders folder, found \"lib/none.glsl\"\n");
        CHECK(s.check("#pragma flags GRAY\n#ifdef GRAY\n#include \"lib/a.glsl\"\n#endif\n" + kRight) ==
              "x.glsl:3: error: expected #include outside every #if, found it inside one\n");
    }

    TEST_CASE("a flag that is misspelt in a condition is found, here and in a library") {
        Shaders s;
        CHECK(s.check("#pragma flags GRAY\n" + kRight + "#ifdef GREY\n#endif\n") ==
              "x.glsl:8: error: expected a flag or a #define, found \"GREY\"\n");
        s.write("lib/a.glsl", "// library\n#if defined(GREY)\n#endif\n");
        CHECK(s.check("#include \"lib/a.glsl\"\n" + kRight) ==
              "lib/a.glsl:2: error: expected a flag or a #define, found \"GREY\"\n");
    }

    TEST_CASE("samplers that no variant uses together may share a unit") {
        Shaders s;
        const std::string two = "uniform sampler2D a[2];\nuniform sampler3D b;\nuniform sampler2D c;\n";
        const std::string header = s.header("#pragma share b c\n" + two + kRight);
        CHECK(has(header, "gl::Sampler<X, gl::Texture2D> a{0, 2};"));
        CHECK(has(header, "gl::Sampler<X, gl::Texture3D> b{2, 1};"));
        CHECK(has(header, "gl::Sampler<X, gl::Texture2D> c{2, 1};"));
        CHECK(s.check("#pragma share b\n" + two + kRight) ==
              "x.glsl:1: error: expected two samplers, found \"b\"\n");
        CHECK(s.check("#pragma share b d\n" + two + kRight) ==
              "x.glsl:1: error: expected samplers of this program to share a unit, found \"b d\"\n");
    }

    TEST_CASE("an error of GLSL is told where it is on disk, with the variant that has it") {
        Shaders s;
        s.write(
            "lib/a.glsl",
            "float half_of(float x) {\n#ifdef WRONG\n    return y;\n#else\n    return 0.5 * x;\n#endif\n}\n");
        const std::string said =
            s.check("#pragma flags WRONG\n#pragma validate WRONG\n#include \"lib/a.glsl\"\n" + kRight);
        CHECK(said.starts_with("lib/a.glsl:3: error: 'y' : undeclared identifier [variant: WRONG]\n"));
        CHECK_FALSE(has(said, "[variant: none]"));
    }

    TEST_CASE("stages that do not fit together are refused") {
        const std::string said = Shaders().check("#pragma validate\n#pragma stage vertex\nout vec2 v;\nvoid "
                                                 "main() { v = vec2(0.0); gl_Position = vec4(0.0); }\n"
                                                 "#pragma stage fragment\nin vec3 v;\nlayout(location = 0) "
                                                 "out vec4 c;\nvoid main() { c = vec4(v, 1.0); }\n");
        CHECK(has(said, "x.glsl:1: error: Linking"));
    }

    TEST_CASE("uniforms that C++ could not set are refused") {
        Shaders s;
        CHECK(s.check("uniform dmat4 m;\n" + kRight) ==
              "x.glsl:1: error: expected a type of the table in shader_reflect.py, found \"dmat4\"\n");
        CHECK(s.check("uniform vec4 a, b;\n" + kRight) ==
              "x.glsl:1: error: expected one `type name` or `type name[size]`, found \"vec4 a, b\"\n");
        CHECK(s.check("uniform vec4 a[COUNT];\n" + kRight) ==
              "x.glsl:1: error: expected a number or a constant as array size, found \"COUNT\"\n");
        CHECK(s.check("uniform Lamp { vec4 a; };\n" + kRight) ==
              "x.glsl:1: error: expected layout(std140) before a uniform block, found none\n");
        CHECK(s.check("layout(std140) uniform Lamp {\n    float a[4];\n};\n" + kRight) ==
              "x.glsl:2: error: expected an array of 16-byte elements, found float (std140 would pad it)\n");
        CHECK(s.check("uniform sampler2D maps[17];\n" + kRight) ==
              "x.glsl:1: error: expected at most 16 texture units, found 17\n");
    }

    TEST_CASE("uniforms, samplers, flags and blocks become typed constants and structs") {
        Shaders s;
        const std::string header = s.header(
            "#pragma flags TWO_SIDED\n#define N 3\n"
            "// uniform float commented_out;\n"
            "layout(std140) uniform Lamp {\n    vec3 color; float range;\n    mat4 m[2]; vec2 size;\n};\n"
            "uniform mat4 clip;\nuniform highp vec4 planes[N];\n"
            "uniform sampler3D volumes[2];\nuniform sampler2DShadow shadow;\n" +
            kRight);
        CHECK(has(header, "struct X {"));
        CHECK(has(header, "static constexpr uint32_t kTwoSided = 1u << 0;"));
        CHECK(has(header, "gl::Uniform<X, glm::mat4> clip{0};"));
        CHECK(has(header, "gl::UniformArray<X, glm::vec4> planes{1, 3};"));
        CHECK(has(header, "gl::Sampler<X, gl::Texture3D> volumes{0, 2};"));
        CHECK(has(header, "gl::Sampler<X, gl::Texture2D> shadow{2, 1};"));
        CHECK(has(header, "struct alignas(16) LampBlock {"));
        CHECK(has(header, "static_assert(sizeof(LampBlock) == 160);"));
        CHECK(has(header, "static_assert(offsetof(LampBlock, range) == 12);"));
        CHECK(has(header, "static_assert(offsetof(LampBlock, m) == 16);"));
        CHECK(has(header, "static_assert(offsetof(LampBlock, size) == 144);"));
        CHECK_FALSE(has(header, "commented_out"));
    }
}
