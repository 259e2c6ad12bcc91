// Cones of GI probes on the CPU, against what the rasteriser's own sampler could do at best.
#include "drivers/gl_context.h"
#include "drivers/gles3/gi_volume_storage.h"
#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/gl/state.h"

#include "servers/cones/gather.h"
#include "servers/gi/cone_trace.h"

#include <glm/geometric.hpp>

#include <array>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cmath>
#include <vector>

namespace cl::bench {

namespace {

constexpr int kCells = 128;
constexpr glm::ivec2 kPicture{480, 270};
constexpr std::array<glm::vec4, 6> kCones{{{0.0f, 0.0f, 1.0f, 0.25f},
                                           {0.866025f, 0.0f, 0.5f, 0.15f},
                                           {0.267617f, 0.823639f, 0.5f, 0.15f},
                                           {-0.700629f, 0.509037f, 0.5f, 0.15f},
                                           {-0.700629f, -0.509037f, 0.5f, 0.15f},
                                           {0.267617f, -0.823639f, 0.5f, 0.15f}}};
constexpr float kTanHalf = 0.577f, kBias = 1.5f;

/// A closed room whose walls are one cell thick, with a pillar; all levels, the finest first.
std::vector<std::vector<uint8_t>> room_levels() {
    std::vector<std::vector<uint8_t>> levels;
    std::vector<uint8_t>& finest = levels.emplace_back(size_t(kCells) * kCells * kCells * 4);
    for (int z = 0; z < kCells; ++z) {
        for (int y = 0; y < kCells; ++y) {
            for (int x = 0; x < kCells; ++x) {
                const auto on_wall = [](int c) { return c == 2 || c == kCells - 3; };
                const auto within = [](int c) { return c >= 2 && c <= kCells - 3; };
                const bool wall =
                    within(x) && within(y) && within(z) && (on_wall(x) || on_wall(y) || on_wall(z));
                const bool pillar = x > 50 && x < 70 && z > 50 && z < 70 && y < 60 && y > 2;
                if (wall || pillar) {
                    uint8_t* texel = &finest[size_t((z * kCells + y) * kCells + x) * 4];
                    texel[0] = uint8_t(60 + x);
                    texel[1] = uint8_t(60 + y);
                    texel[2] = uint8_t(60 + z);
                    texel[3] = 255;
                }
            }
        }
    }
    for (int n = kCells / 2; n >= 1; n /= 2) {
        const std::vector<uint8_t>& fine = levels.back();
        std::vector<uint8_t> coarse(size_t(n) * size_t(n) * size_t(n) * 4);
        for (size_t i = 0; i < coarse.size(); ++i) {
            const size_t texel = i / 4, x = texel % size_t(n), y = texel / size_t(n) % size_t(n),
                         z = texel / size_t(n) / size_t(n);
            int sum = 0;
            for (size_t corner = 0; corner < 8; ++corner) {
                const size_t at =
                    ((2 * z + (corner >> 2)) * size_t(2 * n) + 2 * y + (corner >> 1 & 1)) * size_t(2 * n) +
                    2 * x + (corner & 1);
                sum += fine[at * 4 + i % 4];
            }
            coarse[i] = uint8_t(sum / 8);
        }
        levels.push_back(std::move(coarse));
    }
    return levels;
}

/// The room seen from inside: floor, a wall on the left, one behind; view space is cells.
struct Surfaces {
    std::vector<glm::vec4> places, shapes;

    Surfaces() {
        for (int y = 0; y < kPicture.y; ++y) {
            for (int x = 0; x < kPicture.x; ++x) {
                const float u = float(x) / float(kPicture.x), v = float(y) / float(kPicture.y),
                            far = float(kCells - 8);
                if (3 * x < kPicture.x) {
                    add({3.0f, 3.0f + far * v, 3.0f + 3.0f * far * u}, {1, 0, 0});
                } else if (5 * y < 2 * kPicture.y) {
                    add({3.0f + far * u, 3.0f + far * v, 3.0f}, {0, 0, 1});
                } else {
                    add({3.0f + far * u, 3.0f, 3.0f + far * v}, {0, 1, 0});
                }
            }
        }
    }
    void add(const glm::vec3& place, const glm::vec3& normal) {
        places.emplace_back(place, 1.0f);
        shapes.emplace_back(normal, 1.0f);
    }
};

/// Samples that a diffuse cone of these surfaces takes on average.
double samples_per_cone(const std::vector<std::vector<uint8_t>>& levels, const Surfaces& surfaces) {
    std::vector<gi::VolumeSampler::Level> spans;
    for (size_t i = 0; i < levels.size(); ++i) {
        spans.push_back({glm::ivec3(kCells >> i), levels[i]});
    }
    const gi::VolumeSampler volume(spans);
    size_t samples = 0, cones = 0;
    for (size_t i = 0; i < surfaces.places.size(); i += 997) {
        float alpha = 0.0f, distance = kBias;
        while (distance < float(kCells) * 1.732f && alpha < 0.95f) {
            const float diameter = gi::cone_diameter(distance, kTanHalf);
            const glm::vec3 at = glm::vec3(surfaces.places[i]) + distance * glm::vec3(surfaces.shapes[i]);
            alpha += volume.sample(at / float(kCells), std::log2(diameter)).a * (1.0f - alpha);
            distance += 0.5f * diameter;
            ++samples;
        }
        ++cones;
    }
    return double(samples) / double(cones);
}

/// Items are samples of two levels.
void gather_cones(benchmark::State& state) {
    if (!cones::can_gather()) {
        state.SkipWithError("this processor has no AVX2");
        return;
    }
    const std::vector<std::vector<uint8_t>> levels = room_levels();
    cones::Volume volume(glm::ivec3(kCells), int(levels.size()));
    for (size_t i = 0; i < levels.size(); ++i) {
        volume.upload(int(i), glm::ivec3(0), volume.size(int(i)), levels[i]);
    }
    const Surfaces surfaces;
    cones::ConeSet set;
    set.probes[0] = {.volume = &volume,
                     .bounds = glm::vec3(kCells),
                     .uv_from_cells = glm::vec3(1.0f / kCells),
                     .multiplier = 1.0f,
                     .bias = kBias,
                     .reach = float(kCells) * 1.732f,
                     .blend_ambient = true};
    std::vector<glm::vec4> diffuse(surfaces.places.size()), specular(surfaces.places.size());
    for (auto _ : state) {
        static_cast<void>(_);
        cones::gather_cones({.cones = kCones, .tan_half_aperture = kTanHalf}, {&set, 1},
                            {kPicture, surfaces.places, surfaces.shapes, diffuse, specular});
        benchmark::DoNotOptimize(diffuse.data());
    }
    const double samples =
        samples_per_cone(levels, surfaces) * double(kCones.size() * surfaces.places.size());
    state.SetItemsProcessed(int64_t(samples * double(state.iterations())));
}
BENCHMARK(gather_cones)->Unit(benchmark::kMillisecond)->UseRealTime();

/// What the driver's sampler does alone: items are textureLod() between two levels of the same volume, near
/// each other as a cone's are, and nothing else.
void driver_samples(benchmark::State& state) {
    constexpr int kSamples = 64;
    Expected<std::unique_ptr<drivers::GLContext>> context = drivers::create_offscreen_context();
    if (!context) {
        state.SkipWithError(context.error().message.c_str());
        return;
    }
    gles3::gl::State gl_state;
    const std::vector<std::vector<uint8_t>> levels = room_levels();
    Expected<gles3::GIVolumeStorage> volumes = gles3::GIVolumeStorage::create();
    const Expected<RID> volume = volumes->create({glm::ivec3(kCells), int(levels.size())});
    for (size_t i = 0; i < levels.size(); ++i) {
        static_cast<void>(
            volumes->upload(*volume, int(i), glm::ivec3(0), glm::ivec3(kCells >> i), levels[i]));
    }
    static constexpr std::string_view kVertex = "void main() { gl_Position = vec4(float(gl_VertexID & 1) * "
                                                "4.0 - 1.0, float(gl_VertexID & 2) * 2.0 - 1.0, 0.0, "
                                                "1.0); }\n";
    static constexpr std::string_view kFragment =
        "uniform sampler3D volume;\nlayout(location = 0) out vec4 color;\n"
        "void main() {\n    vec3 at = vec3(gl_FragCoord.xy / vec2(480.0, 270.0), 0.1);\n    vec4 sum = "
        "vec4(0.0);\n"
        "    for (int i = 0; i < 64; ++i) {\n        at.z += 0.01;\n"
        "        sum += textureLod(volume, at, 0.11 * float(i & 31) + 0.5);\n    }\n    color = sum;\n}\n";
    static constexpr std::string_view kFiles[] = {"driver_samples"};
    static constexpr gles3::gl::SamplerDecl kSamplers[] = {{"volume", "sampler3D", 0, 1}};
    const Expected<gles3::gl::Program> program = gles3::gl::Program::create({.name = "driver_samples",
                                                                             .vertex = kVertex,
                                                                             .fragment = kFragment,
                                                                             .files = kFiles,
                                                                             .samplers = kSamplers});
    const Expected<gles3::gl::Texture2D> target =
        gles3::gl::Texture2D::create({.size = kPicture, .format = gles3::gl::Format::RGBA16F});
    const Expected<gles3::gl::Framebuffer> framebuffer =
        gles3::gl::Framebuffer::create({.colors = {{{&*target}}}});
    const gles3::gl::VertexArray empty = gles3::gl::VertexArray::create_empty();
    volumes->get(*volume)->bind(0);
    const auto draw = [&] {
        gles3::gl::Pass pass(
            {.label = "samples", .target = &*framebuffer, .colors = {gles3::gl::Load::DontCare}});
        pass.draw_fullscreen(*program, empty);
        glFinish();
    };
    draw(); // compiles
    for (auto _ : state) {
        static_cast<void>(_);
        draw();
    }
    state.SetItemsProcessed(int64_t(state.iterations()) * kPicture.x * kPicture.y * kSamples);
}
BENCHMARK(driver_samples)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

} // namespace cl::bench
