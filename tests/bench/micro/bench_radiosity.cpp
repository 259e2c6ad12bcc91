// The loops of light transport and of its solution.
#include "tests/bench/micro/memory.h"
#include "tests/bench/micro/room.h"

#include "servers/radiosity/field_map.h"
#include "servers/radiosity/for_all.h"
#include "servers/radiosity/gather.h"
#include "servers/radiosity/radiance_volume.h"
#include "servers/radiosity/sky_bins.h"
#include "servers/radiosity/solver.h"

#include "core/threads.h"

#include <glm/geometric.hpp>

#include <atomic>
#include <cmath>
#include <vector>

namespace cl::bench {

namespace {

using namespace radiosity;

const std::atomic<bool> kGoOn{false};

Lighting one_lamp() {
    Lighting lighting;
    Source lamp;
    lamp.position = {0.0f, 1.2f, 0.0f};
    lamp.range_m = 7.0f;
    lighting.sources = {lamp};
    lighting.sky.assign(kSkyBins, glm::vec3(0.0f));
    return lighting;
}

/// All of it: cut, place, trace. Items are links.
void make_light_transport(benchmark::State& state) {
    const ProbeBox box{{}, {glm::vec3(-Room::kHalf_m), glm::vec3(2.0f * Room::kHalf_m)}};
    size_t links = 0;
    for (auto _ : state) {
        static_cast<void>(_);
        const auto made = make_transport(Room().still_scene(), std::span(&box, 1), kGoOn);
        links += made ? (*made)->records.links.targets.size() : 0;
    }
    state.SetItemsProcessed(int64_t(links));
}
BENCHMARK(make_light_transport)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The rays that links are made of, in fans of 64 from a patch. Items are rays.
void trace_rays(benchmark::State& state) {
    const Transport& t = transport();
    constexpr size_t kFan = 64, kPatches = 4096;
    const size_t stride = std::max<size_t>(t.patches.size() / kPatches, 1);
    for (auto _ : state) {
        static_cast<void>(_);
        parallel_for(kPatches, 16, [&](size_t begin, size_t end) {
            std::vector<Ray> rays(kFan);
            std::vector<Hit> hits(kFan);
            for (size_t i = begin; i < end; ++i) {
                const size_t p = i * stride % t.patches.size();
                const glm::vec3 n = t.patches.normal[p];
                for (size_t k = 0; k < kFan; ++k) {
                    const glm::vec3 d = sky_direction(uint32_t(k * (kSkyBins / kFan)));
                    rays[k] = {t.patches.position[p] + 1e-3f * n, glm::normalize(n + 0.99f * d), 1e30f};
                }
                t.rays.trace(rays, hits);
                benchmark::DoNotOptimize(hits.data());
            }
        });
    }
    state.SetItemsProcessed(int64_t(state.iterations()) * int64_t(kPatches * kFan));
}
BENCHMARK(trace_rays)->Unit(benchmark::kMillisecond)->UseRealTime();

/// One lamp at all patches, a shadow ray each. Items are patches.
void light_patches(benchmark::State& state) {
    const Transport& t = transport();
    const Lighting lighting = one_lamp();
    for (auto _ : state) {
        static_cast<void>(_);
        benchmark::DoNotOptimize(unit_light(t, lighting.sources[0]).data());
    }
    state.SetItemsProcessed(int64_t(state.iterations()) * int64_t(t.patches.size()));
}
BENCHMARK(light_patches)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A relight of one lamp that moves, without the encoding.
void solve_moving_lamp(benchmark::State& state) {
    const Transport& t = transport();
    Lighting lighting = one_lamp();
    lighting.sources[0].steady = false;
    LightMemory memory;
    for (auto _ : state) {
        static_cast<void>(_);
        lighting.sources[0].position.x += 1e-4f;
        benchmark::DoNotOptimize(solve(t, lighting, kGoOn, &memory).bounces);
    }
}
BENCHMARK(solve_moving_lamp)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same of one that grows brighter.
void solve_brighter_lamp(benchmark::State& state) {
    const Transport& t = transport();
    Lighting lighting = one_lamp();
    LightMemory memory;
    for (auto _ : state) {
        static_cast<void>(_);
        lighting.sources[0].radiance *= 1.001f;
        benchmark::DoNotOptimize(solve(t, lighting, kGoOn, &memory).bounces);
    }
}
BENCHMARK(solve_brighter_lamp)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Links are read one after the other, radiance of what they name from anywhere.
void gather_all_links(benchmark::State& state) {
    const Transport& t = transport();
    const std::vector<Rgb4> leaving(t.patches.size(), gi::splat(1.0f));
    const std::vector<Rgb4> first(t.records.patch.size(), Rgb4{});
    std::vector<Rgb4> arriving(first.size());
    for (auto _ : state) {
        static_cast<void>(_);
        add_bounce(t, leaving, first, arriving);
        benchmark::DoNotOptimize(arriving.data());
    }
    report_bytes(state, t.records.links.targets.size() * (sizeof(uint32_t) + sizeof(Rgb4)));
}
BENCHMARK(gather_all_links)->Unit(benchmark::kMillisecond)->UseRealTime();

void bounce_once(benchmark::State& state) {
    const Transport& t = transport();
    const std::vector<Rgb4> now(t.records.patch.size(), gi::splat(1.0f));
    std::vector<Rgb4> next(now.size());
    for (auto _ : state) {
        static_cast<void>(_);
        for_all(next.size(), [&](size_t r) { next[r] = exchanged(t, now, r); });
        benchmark::DoNotOptimize(next.data());
    }
    report_bytes(state, t.exchanges.size() * (sizeof(Transport::Exchange) + sizeof(Rgb4)));
}
BENCHMARK(bounce_once)->Unit(benchmark::kMillisecond)->UseRealTime();

void interpolate_patches(benchmark::State& state) {
    const Transport& t = transport();
    const std::vector<Rgb4> records(t.records.patch.size(), gi::splat(1.0f));
    std::vector<Rgb4> out(t.patches.size());
    for (auto _ : state) {
        static_cast<void>(_);
        for_all(out.size(), [&](size_t p) { out[p] = at_patch(t, records, {}, p); });
        benchmark::DoNotOptimize(out.data());
    }
    report_bytes(state, t.records.shares.size() * (sizeof(Records::Share) + sizeof(Rgb4)) +
                            t.patches.size() * (sizeof(Rgb4) + sizeof(uint32_t)));
}
BENCHMARK(interpolate_patches)->Unit(benchmark::kMillisecond)->UseRealTime();

void make_map(benchmark::State& state) {
    for (auto _ : state) {
        static_cast<void>(_);
        benchmark::DoNotOptimize(make_field_map(transport()).joints.data());
    }
}
BENCHMARK(make_map)->Unit(benchmark::kMillisecond)->UseRealTime();

void encode_light(benchmark::State& state) {
    const FieldMap map = make_field_map(transport());
    const Solution solution = solve(transport(), one_lamp(), kGoOn);
    for (auto _ : state) {
        static_cast<void>(_);
        benchmark::DoNotOptimize(encode_field(map, solution).data());
    }
    report_bytes(state, map.patches.size() * (2 * sizeof(uint32_t) + sizeof(glm::vec3)));
}
BENCHMARK(encode_light)->Unit(benchmark::kMillisecond)->UseRealTime();

void make_volume(benchmark::State& state) {
    const Solution solution = solve(transport(), one_lamp(), kGoOn);
    for (auto _ : state) {
        static_cast<void>(_);
        benchmark::DoNotOptimize(make_radiance_volume(transport(), 0, solution).range);
    }
}
BENCHMARK(make_volume)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

} // namespace cl::bench

BENCHMARK_MAIN();
