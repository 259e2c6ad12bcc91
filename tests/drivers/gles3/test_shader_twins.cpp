#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"
#include "tests/drivers/gles3/gpu_volume.h"
#include "tests/shared_dir.h"

#include "servers/shading/brdf.h"
#include "servers/shading/tone_map.h"

#include "core/io/file.h"
#include "core/math/color.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

using namespace cl;
using tests::glsl;
using tests::GLTest;
using tests::on_each_gl;

namespace {

/// A call in GLSL, and what its twin in C++ returns.
struct Call {
    std::string glsl;
    glm::vec4 expected;
};

glm::vec4 padded(float v) {
    return {v, 0.0f, 0.0f, 0.0f};
}
glm::vec4 padded(const glm::vec3& v) {
    return {v, 0.0f};
}

/// Calls of one library's functions with random numbers.
class Calls {
public:
    float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    glm::vec3 color(float most) { return {between(0.0f, most), between(0.0f, most), between(0.0f, most)}; }

    template <typename... Args>
    void scalar(const char* name, float expected, const Args&... args) {
        calls_.push_back({fmt::format("vec4({}, 0.0, 0.0, 0.0)", call(name, args...)), padded(expected)});
    }
    template <typename... Args>
    void vector(const char* name, const glm::vec3& expected, const Args&... args) {
        calls_.push_back({fmt::format("vec4({}, 0.0)", call(name, args...)), padded(expected)});
    }

    /// Holds what the file's functions return against their twins, relative to what is above 1.
    void check(const char* file) const {
        const auto library = read_text_file(tests::repository_dir() / "drivers/gles3/shaders/lib" / file);
        REQUIRE(library);
        std::string body = *library + "vec4 probe(int pixel) {\n";
        for (size_t i = 0; i < calls_.size(); ++i) {
            body += fmt::format("if (pixel == {}) return {};\n", i, calls_[i].glsl);
        }
        body += "return vec4(0.0);\n}\n";
        on_each_gl([&](GLTest&) {
            const std::vector<glm::vec4> got = tests::probe_fragments(body, int(calls_.size()));
            for (size_t i = 0; i < calls_.size(); ++i) {
                const Call& c = calls_[i];
                CAPTURE(c.glsl);
                float largest = 1.0f;
                for (int k = 0; k < 4; ++k) {
                    largest = std::max(largest, std::abs(c.expected[k]));
                }
                // The software rasteriser's pow and exp2 are good to about 16 bits.
                CHECK(tests::worst_difference(got[i], c.expected) <= 1e-4f * largest);
            }
        });
    }

private:
    template <typename... Args>
    static std::string call(const char* name, const Args&... args) {
        std::string list;
        ((list += (list.empty() ? "" : ", ") + text(args)), ...);
        return fmt::format("{}({})", name, list);
    }
    static std::string text(int v) { return std::to_string(v); }
    template <typename T>
    static std::string text(const T& v) {
        return glsl(v);
    }

    std::mt19937 random_{23};
    std::vector<Call> calls_;
};

} // namespace

TEST_SUITE("drivers/gles3/shader_twins") {
    TEST_CASE("[gl] the shader reflects light as its twin on the CPU does, in every material mode") {
        Calls calls;
        for (int i = 0; i < 6; ++i) {
            const float nl = calls.between(-1.0f, 1.0f), nv = calls.between(-1.0f, 1.0f),
                        cosine = std::abs(nv);
            const float lh = calls.between(0.0f, 1.0f), nh = calls.between(0.0f, 1.0f),
                        rough = calls.between(0.15f, 1.0f);
            const float lv = calls.between(-1.0f, 1.0f);
            const glm::vec3 albedo = calls.color(1.0f);
            calls.scalar("diffuse_burley", shading::diffuse_burley(nl, cosine, lh, rough), nl, cosine, lh,
                         rough);
            calls.scalar("diffuse_lambert", shading::diffuse_lambert(nl), nl);
            calls.scalar("diffuse_lambert_wrap", shading::diffuse_lambert_wrap(nl, rough), nl, rough);
            calls.vector("diffuse_oren_nayar", shading::diffuse_oren_nayar(nl, nv, lv, rough, albedo), nl, nv,
                         lv, rough, albedo);
            calls.scalar("diffuse_toon", shading::diffuse_toon(nl, rough), nl, rough);
            calls.vector("f0_from_material", shading::f0_from_material(albedo, lh, nh), albedo, lh, nh);
            calls.vector("specular_ggx", shading::specular_ggx(nl, cosine, lh, nh, rough, albedo), nl, cosine,
                         lh, nh, rough, albedo);
            calls.scalar("specular_blinn", shading::specular_blinn(nl, nh, rough), nl, nh, rough);
            calls.scalar("specular_phong", shading::specular_phong(nl, cosine, lv, rough), nl, cosine, lv,
                         rough);
            calls.scalar("specular_toon", shading::specular_toon(lv, rough), lv, rough);
        }
        calls.check("brdf.glsl");
    }

    TEST_CASE("[gl] the shader reflects the environment as its twin on the CPU does") {
        Calls calls;
        for (int i = 0; i < 12; ++i) {
            const float nv = calls.between(0.0f, 1.0f), rough = calls.between(0.0f, 1.0f);
            const glm::vec3 color = calls.color(1.0f);
            calls.vector("fresnel_rough", shading::fresnel_rough(color, rough, nv), color, rough, nv);
            calls.vector("environment_brdf", shading::environment_brdf(color, rough, nv), color, rough, nv);
        }
        calls.check("environment_brdf.glsl");
    }

    TEST_CASE("[gl] the shader maps tones and adjusts pictures as its twin on the CPU does") {
        Calls calls;
        for (int i = 0; i < 24; ++i) {
            const glm::vec3 color = calls.color(6.0f), encoded = calls.color(1.0f), bcs = calls.color(2.0f);
            const float white = calls.between(0.5f, 8.0f);
            calls.vector("tone_map", shading::tone_map(color, static_cast<ToneMapper>(i % 4), white), color,
                         i % 4, white);
            calls.vector("adjust", shading::adjust(encoded, bcs), encoded, bcs);
        }
        calls.check("tone_map.glsl");
    }

    TEST_CASE("[gl] the shader's sRGB curve is its twin's on the CPU, both ways, dark parts too") {
        Calls calls;
        for (int i = 0; i < 12; ++i) {
            const glm::vec3 color = calls.color(i % 2 ? 1.0f : 0.06f);
            calls.vector("srgb_from_linear", srgb_from_linear(color), color);
            calls.vector("linear_from_srgb", linear_from_srgb(color), color);
        }
        calls.check("color_space.glsl");
    }
}
