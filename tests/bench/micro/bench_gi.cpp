// The loops of a bake and of a relight by cells.
#include "tests/bench/micro/memory.h"
#include "tests/bench/micro/room.h"

#include "servers/gi/rebake.h"
#include "servers/gi/relight.h"

#include <bit>
#include <memory>
#include <vector>

namespace cl::bench {

namespace {

/// A bake of the room and what its relight works on. The newest one is kept.
struct Cells {
    gi::CellLayout layout;
    std::vector<int32_t> leaf_energies;
    gi::CellEnergies energies;
};

gi::CachedLight lamp(int subdivision) {
    gi::CachedLight light;
    light.cells_from_light.origin = glm::vec3(0.5f, 0.8f, 0.5f) * float(subdivision);
    light.range_m = float(subdivision);
    return light;
}

Cells& cells_of(int subdivision) {
    static int made_for = 0;
    static Cells cells;
    if (made_for != subdivision) {
        cells.layout = gi::make_layout(Room().octree(subdivision));
        cells.leaf_energies = gi::emission_energies(cells.layout);
        gi::inject_light(cells.layout, lamp(subdivision), 1, cells.leaf_energies);
        gi::energies_from_leaves(cells.layout, cells.leaf_energies, 0.7f, cells.energies);
        made_for = subdivision;
    }
    return cells;
}

/// Items are leaves.
void voxelize(benchmark::State& state) {
    const Room room;
    const gi::Grid grid = *gi::compute_grid(glm::vec3(Room::kHalf_m), int(state.range(0)));
    size_t leaves = 0;
    for (auto _ : state) {
        static_cast<void>(_);
        const Expected<gi::BakedOctree> made = gi::voxelize(grid, room.surfaces());
        leaves += made ? made->leaf_count : 0;
    }
    state.SetItemsProcessed(int64_t(leaves));
}
BENCHMARK(voxelize)->RangeMultiplier(2)->Range(64, 256)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The box in the room is moved back and forth by a tenth of its size; all else comes out of the last result.
void revoxelize(benchmark::State& state) {
    const Room room;
    const gi::Grid grid = *gi::compute_grid(glm::vec3(Room::kHalf_m), int(state.range(0)));
    std::vector<gi::PlotSurface> surfaces = room.surfaces();
    gi::BakeMemory memory;
    std::vector<int32_t> result;
    float step_m = 0.12f;
    const auto bake = [&] {
        std::vector<Digest> digests;
        for (size_t i = 0; i < surfaces.size(); ++i) {
            digests.push_back({i, i == Room::kBox ? std::bit_cast<uint32_t>(step_m) : 0u});
        }
        const auto source = [&](std::span<const uint32_t> numbers) {
            std::vector<gi::PlotSurface> asked_for;
            for (const uint32_t number : numbers) {
                asked_for.push_back(surfaces[number]);
            }
            return asked_for;
        };
        Expected<gi::BakedOctree> made = gi::revoxelize(grid, digests, source, memory, result);
        result = made ? std::move(made->dynamic_data) : std::vector<int32_t>();
    };
    bake();
    for (auto _ : state) {
        static_cast<void>(_);
        surfaces[Room::kBox].local_from_mesh.origin.x += step_m;
        step_m = -step_m;
        bake();
    }
}
BENCHMARK(revoxelize)->RangeMultiplier(2)->Range(64, 256)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Items are leaves, a shadow march each.
void inject_light(benchmark::State& state) {
    Cells& cells = cells_of(int(state.range(0)));
    const gi::CachedLight light = lamp(int(state.range(0)));
    int sign = 1;
    for (auto _ : state) {
        static_cast<void>(_);
        gi::inject_light(cells.layout, light, sign, cells.leaf_energies);
        sign = -sign; // sums stay in range
    }
    state.SetItemsProcessed(int64_t(state.iterations()) * int64_t(cells.layout.leaves.size()));
}
BENCHMARK(inject_light)->RangeMultiplier(2)->Range(64, 256)->Unit(benchmark::kMillisecond)->UseRealTime();

/// All cells: the energies of a cell's children are read, and its own is written.
void downsample(benchmark::State& state) {
    Cells& cells = cells_of(int(state.range(0)));
    float propagation = 0.7f; // another one each time, or nothing would be summed anew
    for (auto _ : state) {
        static_cast<void>(_);
        gi::energies_from_leaves(cells.layout, cells.leaf_energies, propagation, cells.energies);
        propagation = 1.3f - propagation;
    }
    const size_t count = cells.layout.cell_count(), leaves = cells.layout.leaves.size();
    report_bytes(state, leaves * 3 * sizeof(int32_t) + (count - leaves) * sizeof(uint32_t) +
                            count * 2 * 3 * sizeof(gi::Energy));
}
BENCHMARK(downsample)->RangeMultiplier(2)->Range(64, 256)->Unit(benchmark::kMillisecond)->UseRealTime();

/// All bricks: a cell, its place and energy are read, bricks of four bytes a texel are written.
void encode_bricks(benchmark::State& state) {
    Cells& cells = cells_of(int(state.range(0)));
    gi::CellEnergies fresh;
    const gi::ChangedBricks all = gi::energies_from_leaves(cells.layout, cells.leaf_energies, 0.7f, fresh);
    gi::TexelBoxes boxes;
    for (auto _ : state) {
        static_cast<void>(_);
        gi::encode_bricks(cells.layout, fresh, 4, gi::TexelCoding::Plain, all, boxes);
    }
    report_bytes(state, cells.layout.cell_count() *
                                (sizeof(uint8_t) + sizeof(glm::u16vec3) + 3 * sizeof(gi::Energy)) +
                            boxes.rgba8.size());
}
BENCHMARK(encode_bricks)->RangeMultiplier(2)->Range(64, 256)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

} // namespace cl::bench
