#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"
#include "tests/drivers/gles3/gpu_volume.h"
#include "tests/shared_dir.h"

#include "core/io/file.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <random>
#include <string>

using namespace cl;
using namespace cl::gles3;
using tests::glsl;
using tests::GLTest;
using tests::on_each_gl;

namespace {

constexpr int kSize = 32;
constexpr gl::SamplerDecl kVolume[] = {{"volume", "sampler3D", 0, 1}};

std::vector<gi::Cone> random_cones(size_t count) {
    std::mt19937 random(11);
    std::normal_distribution<float> n;
    std::uniform_real_distribution<float> inside(0.0f, kSize);
    std::vector<gi::Cone> cones;
    for (size_t i = 0; i < count; ++i) {
        cones.push_back({.origin = {inside(random), inside(random), inside(random)},
                         .direction = glm::normalize(glm::vec3(n(random), n(random), n(random))),
                         .tan_half_aperture = i % 2 ? 0.577f : 0.2f * float(i % 7),
                         .first_distance = 0.5f * float(i % 5),
                         .max_distance = 55.0f});
    }
    return cones;
}

/// A function that traces the pixel's cone by the shader library.
std::string body_of(const std::vector<gi::Cone>& cones) {
    const auto library =
        read_text_file(tests::repository_dir() / "drivers/gles3/shaders/lib/cone_trace.glsl");
    REQUIRE(library);
    std::string body = "uniform sampler3D volume;\n" + *library + "vec4 probe(int pixel) {\n";
    for (size_t i = 0; i < cones.size(); ++i) {
        const gi::Cone& c = cones[i];
        body += fmt::format("if (pixel == {}) return trace_cone(volume, vec3(1.0 / {:.1f}), {}, {}, {:.9e}, "
                            "{:.9e}, {:.9e});\n",
                            i, float(kSize), glsl(c.origin), glsl(c.direction), c.tan_half_aperture,
                            c.first_distance, c.max_distance);
    }
    return body + "return vec4(0.0);\n}\n";
}

} // namespace

TEST_SUITE("drivers/gles3/cone_trace") {
    TEST_CASE("[gl] the shader's cone gathers what its twin on the CPU gathers") {
        const tests::FilledVolume filled = tests::sparse_volume(kSize);
        const gi::VolumeSampler twin = filled.sampler();
        const std::vector<gi::Cone> cones = random_cones(16);
        const std::string body = body_of(cones);
        on_each_gl([&](GLTest&) {
            Expected<GIVolumeStorage> storage = GIVolumeStorage::create();
            REQUIRE(storage);
            tests::bind_volume(*storage, filled);
            const std::vector<glm::vec4> got = tests::probe_fragments(body, int(cones.size()), kVolume);
            for (size_t i = 0; i < cones.size(); ++i) {
                CAPTURE(i);
                // The hardware filters with 8 bits of fraction: up to 1/256 of a texel's range a sample.
                CHECK(tests::worst_difference(got[i], gi::trace_cone(twin, cones[i])) <= 0.02f);
            }
        });
    }
}
