#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"
#include "tests/drivers/gles3/gpu_volume.h"
#include "tests/shared_dir.h"

#include "drivers/gles3/draw_block.h"
#include "drivers/gles3/frame_block.h"

#include "core/io/file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <string>
#include <vector>

using namespace cl;
using namespace cl::gles3;
using tests::glsl;
using tests::GLTest;
using tests::on_each_gl;

namespace {

constexpr int kSize = 32;
constexpr gl::SamplerDecl kVolume[] = {{"volume", "sampler3D", 0, 1}};
const glm::vec3 kAmbient(0.3f, 0.1f, 0.05f);
const glm::vec3 kEnvironment(0.05f, 0.2f, 0.4f);

/// A place on a surface, in view space.
struct Place {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    glm::vec3 reflection{0.0f};
    float roughness = 0.0f;
};

/// What surfaces get for light from all around, and in the mirror direction.
struct Light {
    glm::vec3 ambient{0.0f};
    glm::vec3 environment{0.0f};
};

/// A probe's cone march by the specification, apart from the shader's own tables and formulas.
struct ConeSet {
    std::vector<glm::vec4> cones; ///< tangent, binormal, normal, weight
    float tan_half, reach, least_specular_tan;
};

ConeSet specified(Quality quality) {
    constexpr float s = 0.707107f;
    if (quality == Quality::Low) {
        return {
            {{s, 0, s, 0.25f}, {0, s, s, 0.25f}, {-s, 0, s, 0.25f}, {0, -s, s, 0.25f}}, 0.98269f, 0.5f, 0.2f};
    }
    return {{{0, 0, 1, 0.25f},
             {0.866025f, 0, 0.5f, 0.15f},
             {0.267617f, 0.823639f, 0.5f, 0.15f},
             {0.267617f, -0.823639f, 0.5f, 0.15f},
             {-0.700629f, 0.509037f, 0.5f, 0.15f},
             {-0.700629f, -0.509037f, 0.5f, 0.15f}},
            0.577f,
            1.0f,
            0.0f};
}

/// Adds what a probe gives to sums weighted by `w` (spec gi-shading section 4).
void add_specified(const gi::VolumeSampler& volume, const GIProbeShading& probe,
                   const Transform& cells_from_view, float baked, const Place& at, const ConeSet& q,
                   glm::vec4& diffuse, glm::vec4& specular) {
    const glm::vec3 unbiased = cells_from_view.xform(at.position);
    const glm::vec3 p = unbiased + cells_from_view.basis * at.normal * probe.normal_bias_m * baked;
    const glm::vec3 bounds = probe.bounds_cells;
    if (glm::any(glm::lessThan(p, glm::vec3(0.0f))) || glm::any(glm::greaterThan(p, bounds))) {
        return;
    }
    const glm::vec3 from_center = glm::abs(2.0f * p / bounds - 1.0f);
    const float blend =
        glm::clamp(1.0f - std::max(from_center.x, std::max(from_center.y, from_center.z)), 0.0f, 1.0f);
    const float reach = q.reach * glm::length(bounds);
    const auto gathered = [&](const glm::vec3& direction, float tan_half, const glm::vec3& miss) {
        const glm::vec4 got =
            gi::trace_cone(volume, {p, glm::normalize(direction), tan_half, probe.bias_cells * baked, reach});
        const float met = std::min(1.0f, got.a / 0.95f);
        const glm::vec3 rgb(got);
        return probe.multiplier * (probe.blend_ambient ? glm::mix(miss, rgb, met) : rgb);
    };
    const glm::vec3 up = std::abs(at.normal.z) < 0.999f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 t = glm::normalize(glm::cross(up, at.normal));
    const glm::vec3 b = glm::normalize(glm::cross(t, at.normal));
    glm::vec3 sum(0.0f);
    for (const glm::vec4& c : q.cones) {
        const glm::vec3 end = at.position + c.x * t + c.y * b + c.z * at.normal;
        sum += c.w * gathered(cells_from_view.xform(end) - p, q.tan_half, kAmbient);
    }
    const float rho = at.roughness * at.roughness;
    const float specular_tan = std::max(q.least_specular_tan, std::tan(rho * 0.5f * 3.14159265f * 0.99f));
    const glm::vec3 mirror = cells_from_view.xform(at.position + at.reflection) - unbiased;
    diffuse += glm::vec4(sum * blend, blend);
    specular += glm::vec4(gathered(mirror, specular_tan, kEnvironment) * blend, blend);
}

/// What the shader works on: probes in a world, seen by a camera.
struct Scene {
    Transform world_from_view{basis_from_euler_yxz({0.4f, -1.1f, 0.2f}), {1.5f, 0.7f, -2.0f}};
    std::vector<GIProbeShading> probes;
    bool baked = true;
    Quality quality = Quality::High;
    std::vector<Place> places;

    /// Places spread over the first probe's box and a little around it.
    void spread_places(int count) {
        std::mt19937 random(17);
        std::uniform_real_distribution<float> share(-0.15f, 1.15f), unit(0.0f, 1.0f);
        std::normal_distribution<float> n;
        const auto direction = [&] { return glm::normalize(glm::vec3(n(random), n(random), n(random))); };
        const Transform view_from_cells = (probes[0].cells_from_world * world_from_view).inverse();
        for (int i = 0; i < count; ++i) {
            const glm::vec3 cell =
                probes[0].bounds_cells * glm::vec3(share(random), share(random), share(random));
            places.push_back({view_from_cells.xform(cell), direction(), direction(), unit(random)});
        }
        places[0].normal = glm::vec3(0, 0, 1); // where the frame's first axis would vanish
    }

    [[nodiscard]] Light specified_light(const gi::VolumeSampler& volume, const Place& place) const {
        glm::vec4 diffuse(0.0f), specular(0.0f);
        for (const GIProbeShading& probe : probes) {
            add_specified(volume, probe, probe.cells_from_world * world_from_view, baked ? 1.0f : 0.0f, place,
                          specified(quality), diffuse, specular);
        }
        const auto resolved = [](const glm::vec4& sum) {
            return sum.a > 0.0f ? glm::vec3(sum) / sum.a : glm::vec3(0.0f);
        };
        return {resolved(diffuse), resolved(specular)};
    }

    /// A function of the shader library's: pixel 2 i gives place i's ambient light, pixel 2 i + 1 its
    /// environment.
    [[nodiscard]] std::string body() const;
};

std::string library(const char* name) {
    const auto text = read_text_file(tests::repository_dir() / "drivers/gles3/shaders/lib" / name);
    REQUIRE(text);
    return *text;
}

/// `GIProbe` and the parts of the blocks that lib/gi_probe.glsl reads, as constants.
std::string declarations(Quality quality, size_t probe_count) {
    Frame frame;
    frame.size = {16, 16};
    frame.quality = quality;
    const shaders::FrameBlock block = make_frame_block(frame, {});
    std::string cones;
    for (const glm::vec4 cone : block.frame_cones) {
        cones += (cones.empty() ? "" : ", ") + glsl(cone);
    }
    const std::string draw_block = library("draw_block.glsl");
    const size_t begin = draw_block.find("struct GIProbe");
    return draw_block.substr(begin, draw_block.find("};", begin) + 2 - begin) +
           fmt::format(
               "\nconst int kMaxCones = {};\nconst int frame_cone_count = {};\n"
               "const vec4 frame_cones[kMaxCones] = vec4[kMaxCones]({});\nconst float frame_cone_tan = {};\n"
               "const float frame_cone_reach = {};\nconst float frame_specular_least_tan = {};\n"
               "const int draw_gi_count = {};\n",
               std::size(block.frame_cones), int(block.frame_cone_count), cones, glsl(block.frame_cone_tan),
               glsl(block.frame_cone_reach), glsl(block.frame_specular_least_tan), probe_count);
}

std::string Scene::body() const {
    std::string text = "uniform sampler3D volume;\n" + declarations(quality, probes.size()) +
                       library("cone_trace.glsl") + library("gi_probe.glsl") +
                       "vec4 probe(int pixel) {\nGIProbe p;\nGIPoint at;\n";
    for (size_t i = 0; i < places.size(); ++i) {
        const Place& at = places[i];
        text += fmt::format("if (pixel / 2 == {}) at = GIPoint({}, {}, {}, {}, {}, {});\n", i,
                            glsl(at.position), glsl(at.normal), glsl(at.reflection), glsl(at.roughness),
                            glsl(kAmbient), glsl(kEnvironment));
    }
    text += "GISum sum = GISum(vec4(0.0), vec4(0.0));\n";
    for (const GIProbeShading& shading : probes) {
        const shaders::GIProbe p = make_gi_probe(shading, world_from_view, baked);
        text +=
            fmt::format("p.cells_from_view = {};\np.bounds = {};\np.multiplier = {};\np.uv_from_cells = {};\n"
                        "p.bias = {};\np.normal_bias = {};\np.reach = {};\np.blend_ambient = {};\n"
                        "add_gi_probe(volume, p, at, sum);\n",
                        glsl(glm::mat4(p.cells_from_view)), glsl(glm::vec3(p.bounds)), glsl(p.multiplier),
                        glsl(glm::vec3(p.uv_from_cells)), glsl(p.bias), glsl(p.normal_bias), glsl(p.reach),
                        int(p.blend_ambient));
    }
    return text + "resolve_gi(sum, at.ambient, at.environment);\n"
                  "return vec4(pixel % 2 == 0 ? at.ambient : at.environment, 1.0);\n}\n";
}

/// A box that is smaller than its texture, turned and moved.
GIProbeShading turned_probe() {
    GIProbeShading probe;
    probe.volume = {1, 1}; // any: make_gi_probe() asks only whether there is one
    probe.cells_from_world =
        Transform{8.0f * basis_from_euler_yxz({0.3f, 0.8f, -0.2f}), {14.0f, 9.0f, 11.0f}};
    probe.bounds_cells = {32.0f, 20.0f, 26.0f};
    probe.size = glm::ivec3(kSize);
    return probe;
}

void check_against_specification(const Scene& scene) {
    const tests::FilledVolume filled = tests::sparse_volume(kSize);
    const gi::VolumeSampler twin = filled.sampler();
    const std::string body = scene.body();
    float tolerance = 0.0f; // the hardware filters with 8 bits of fraction
    for (const GIProbeShading& probe : scene.probes) {
        tolerance = std::max(tolerance, 0.03f * probe.multiplier);
    }
    on_each_gl([&](GLTest&) {
        Expected<GIVolumeStorage> storage = GIVolumeStorage::create();
        REQUIRE(storage);
        tests::bind_volume(*storage, filled);
        const auto got = tests::probe_fragments(body, int(2 * scene.places.size()), kVolume);
        for (size_t i = 0; i < scene.places.size(); ++i) {
            CAPTURE(i);
            const Light expected = scene.specified_light(twin, scene.places[i]);
            // Of several cones the errors average.
            CHECK(tests::worst_difference(got[2 * i], glm::vec4(expected.ambient, 1.0f)) <= 0.4f * tolerance);
            CHECK(tests::worst_difference(got[2 * i + 1], glm::vec4(expected.environment, 1.0f)) <=
                  tolerance);
        }
    });
}

} // namespace

TEST_SUITE("drivers/gles3/gi_probe") {
    TEST_CASE("[gl] inside its box a probe replaces light from all around, outside it leaves none, in both "
              "qualities") {
        for (const Quality quality : {Quality::High, Quality::Low}) {
            CAPTURE(int(quality));
            Scene scene;
            scene.quality = quality;
            scene.probes = {turned_probe()};
            scene.spread_places(24);
            check_against_specification(scene);
        }
    }

    TEST_CASE(
        "[gl] biases move the cones' start, and bend them, of what is baked; an interior lets no light in") {
        for (const bool baked : {true, false}) {
            CAPTURE(baked);
            Scene scene;
            scene.baked = baked;
            scene.probes = {turned_probe()};
            scene.probes[0].bias_cells = 3.0f;
            scene.probes[0].normal_bias_m = 0.4f;
            scene.probes[0].blend_ambient = false;
            scene.spread_places(24);
            check_against_specification(scene);
        }
    }

    TEST_CASE(
        "[gl] two probes weigh by their distance from the faces of their boxes, each with its own range") {
        Scene scene;
        scene.probes = {turned_probe(), turned_probe()};
        scene.probes[0].multiplier = 2.0f;
        scene.probes[1].multiplier = 0.5f;
        scene.probes[1].blend_ambient = false;
        scene.probes[1].cells_from_world.origin += glm::vec3(9.0f, -4.0f, 3.0f);
        scene.spread_places(24);
        check_against_specification(scene);
    }
}
