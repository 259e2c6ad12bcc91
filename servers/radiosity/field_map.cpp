#include "servers/radiosity/field_map.h"

#include "servers/radiosity/shared_exponent.h"
#include "servers/radiosity/slot_places.h"

#include "core/threads.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr int kMostAirTexels = 2048; // along an edge: what drivers allow a 3D texture

// Facings overlap, so that a pixel whose normal differs a little from its patch's still finds it.
constexpr float kMostAway = 0.35f; ///< a sixth of a right angle past the border between two facings
constexpr float kOwnFacing = 0.1f;
constexpr float kGoesOnFacing = 0.5f; ///< cosine between surfaces that are taken for one
constexpr float kCrack_cells = 0.2f;  ///< a space as narrow as this is not looked into

glm::vec3 facing_axis(const CellGrid& grid, int facing) noexcept {
    const glm::vec3 axis = glm::normalize(grid.world_from_cells.basis[facing / 2]);
    return facing % 2 == 0 ? axis : -axis;
}

/// Cells with patches that face about one way, at most kSlots each: the largest.
struct FacingCells {
    std::vector<uint64_t> orders;
    std::vector<std::array<uint32_t, FieldMap::kSlots>> slots;
};

/// How little less a patch faces an axis of its grid than that which it faces most.
float turned_away(const CellGrid& grid, const glm::vec3& normal, const glm::vec3& axis) noexcept {
    const glm::vec3 along = glm::abs(glm::transpose(grid.world_from_cells.basis) * normal) / grid.cell_m;
    return std::max(along.x, std::max(along.y, along.z)) - glm::dot(normal, axis);
}

/// Keeps the largest patches that face an axis, of the cell's patches [begin, end); those whose own pixels
/// ask for this facing before others. Those in a crack (the inner sides of two layers of cloth) are left out:
/// they are not what a camera sees, and what is there takes its neighbours' light.
std::array<uint32_t, FieldMap::kSlots> choose_slots(const Patches& patches, const CellGrid& grid,
                                                    uint32_t begin, uint32_t end, const glm::vec3& axis) {
    std::array<uint32_t, FieldMap::kSlots> slots{kNoPatch, kNoPatch};
    std::array<std::pair<bool, float>, FieldMap::kSlots> ranks{std::pair{false, -1.0f}, {false, -1.0f}};
    for (uint32_t p = begin; p < end; ++p) {
        const float away = turned_away(grid, patches.normal[p], axis);
        if (away > kMostAway || patches.openness_m[p] < kCrack_cells * grid.cell_m) {
            continue;
        }
        const std::pair rank{away < kOwnFacing, patches.area_m2[p]};
        if (rank > ranks[0]) {
            slots = {p, slots[0]};
            ranks = {rank, ranks[0]};
        } else if (rank > ranks[1]) {
            slots[1] = p;
            ranks[1] = rank;
        }
    }
    return slots;
}

FacingCells cells_facing(const Patches& patches, size_t grid_index, int facing) {
    const CellGrid& grid = patches.grids[grid_index].cells;
    const std::vector<uint32_t>& first = patches.grids[grid_index].first;
    const glm::vec3 axis = facing_axis(grid, facing);
    FacingCells out;
    for (size_t cell = 0; cell + 1 < first.size(); ++cell) {
        const auto slots = choose_slots(patches, grid, first[cell], first[cell + 1], axis);
        if (slots[0] != kNoPatch) {
            out.orders.push_back(patches.order[slots[0]]);
            out.slots.push_back(slots);
        }
    }
    return out;
}

/// The bits of a slot's words that tell it from the other one of its cell.
std::array<uint32_t, 2> place_bits(SlotTest test, const glm::vec3& where) noexcept {
    const glm::uvec3 place(glm::clamp(where * float(kPlaceSteps), 0.0f, float(kPlaceSteps - 1)));
    const uint32_t bits = place.x | place.y << 3 | place.z << 6;
    return {(bits & 31u) << 27, (bits >> 5) << 27 | 1u << 31 | (test == SlotTest::Normal ? 1u << 13 : 0u)};
}

class Joiner {
public:
    Joiner(const Transport& t, size_t grid_index)
        : t_(t), patches_(t.patches), grid_(t.patches.grids[grid_index].cells) {}

    /// True if the surface of patch `a` goes on in patch `b`, a neighbour.
    [[nodiscard]] bool goes_on(uint32_t a, uint32_t b) const noexcept {
        const glm::vec3 na = patches_.normal[a], nb = patches_.normal[b];
        const glm::vec3 apart = patches_.position[b] - patches_.position[a];
        const float rise = std::abs(glm::dot(na + nb, apart)) * 0.5f / grid_.cell_m;
        if (glm::dot(na, nb) < kGoesOnFacing || rise > 1.0f) {
            return false;
        }
        const float lift_m = 2.0f * kLift * grid_.cell_m + 0.12f * glm::length(apart);
        return !t_.rays.is_blocked(patches_.position[a] + lift_m * na, patches_.position[b] + lift_m * nb);
    }

    /// The words of a cell's slots. @param find  slots of a cell and facing, or nullptr
    template <typename Find>
    void join(const std::array<uint32_t, FieldMap::kSlots>& slots, const Find& find, uint32_t* words) const {
        const bool has_second = slots[1] != kNoPatch;
        const SlotPlaces places =
            has_second ? slot_places(t_.rays, *t_.scene, patches_, slots[0], slots[1]) : SlotPlaces{};
        for (size_t s = 0; s < (has_second ? 2 : 1); ++s) {
            const std::array<uint32_t, 2> around = joint(slots[s], find);
            const std::array<uint32_t, 2> place =
                has_second ? place_bits(places.test, places.at[s]) : std::array<uint32_t, 2>{};
            words[s * 2] = around[0] | place[0];
            words[s * 2 + 1] = around[1] | place[1];
        }
    }

private:
    /// The two words of a slot, its place not among them. @param find  slots of a cell and facing, or nullptr
    template <typename Find>
    [[nodiscard]] std::array<uint32_t, 2> joint(uint32_t patch, const Find& find) const {
        std::array<uint32_t, 2> words{1u << 13, 0u};
        const glm::ivec3 cell = grid_.cell_at(patches_.order[patch]);
        for (int i = 0; i < 27; ++i) {
            const auto* slots = i == 13 ? nullptr : find(cell + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
            if (slots && (*slots)[0] != kNoPatch && goes_on(patch, (*slots)[0])) {
                words[0] |= 1u << i;
            } else if (slots && (*slots)[1] != kNoPatch && goes_on(patch, (*slots)[1])) {
                words[0] |= 1u << i;
                words[1] |= 1u << i;
            }
        }
        return words;
    }

    const Transport& t_;
    const Patches& patches_;
    const CellGrid& grid_;
};

void append_facing(const Transport& t, size_t probe, int facing, FieldMap& map) {
    const CellGrid& grid = t.patches.grids[probe].cells;
    const FacingCells cells = cells_facing(t.patches, probe, facing);
    const CellIndex index(grid, cells.orders);
    const uint32_t first_cell = uint32_t(map.patches.size()) / FieldMap::kSlots;
    for (const CellIndex::Brick& b : index.bricks()) {
        map.brick_words.insert(map.brick_words.end(), {b.low, b.high, first_cell + b.first, b.low_count});
    }
    const auto find = [&](const glm::ivec3& cell) {
        const uint32_t number = index.find(cell);
        return number == CellIndex::kNone ? nullptr : &cells.slots[number];
    };
    const Joiner joiner(t, probe);
    const size_t joints_at = map.joints.size();
    map.joints.resize(joints_at + cells.slots.size() * FieldMap::kSlots * 2);
    parallel_for(cells.slots.size(), 256, [&](size_t begin, size_t end) {
        for (size_t c = begin; c < end; ++c) {
            joiner.join(cells.slots[c], find, &map.joints[joints_at + c * FieldMap::kSlots * 2]);
        }
    });
    for (const auto& slots : cells.slots) {
        map.patches.insert(map.patches.end(), slots.begin(), slots.end());
    }
}

} // namespace

FieldMap make_field_map(const Transport& transport) {
    FieldMap map;
    map.air = glm::ivec3(1);
    glm::ivec3 air_at(0);
    for (size_t probe = 0; probe < transport.probe_count; ++probe) {
        const glm::ivec3 bricks = transport.patches.grids[probe].cells.bricks();
        const glm::ivec3 slabs = bricks * glm::ivec3(1, 1, 4);
        if (air_at.z + slabs.z > kMostAirTexels) {
            air_at = {map.air.x, 0, 0}; // beside all before
        }
        map.probes.push_back({bricks, uint32_t(map.brick_words.size() / 4), air_at});
        map.air = glm::max(map.air, air_at + slabs);
        air_at.z += slabs.z;
        for (int facing = 0; facing < FieldMap::kFacings; ++facing) {
            append_facing(transport, probe, facing, map);
        }
    }
    return map;
}

std::vector<uint32_t> encode_field(const FieldMap& map, const Solution& solution) {
    std::vector<uint32_t> out(map.patches.size(), 0u);
    parallel_for(out.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            if (map.patches[i] != kNoPatch) {
                out[i] = pack_shared_exponent(solution.arriving[map.patches[i]]);
            }
        }
    });
    return out;
}

} // namespace cl::radiosity
