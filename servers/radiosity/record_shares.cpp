#include "servers/radiosity/record_shares.h"

#include "core/threads.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace cl::radiosity {
namespace {

/// Finds, for patches, the records around them and what each weighs.
class Interpolator {
public:
    Interpolator(const RayScene& rays, const Patches& patches, const Records& records)
        : rays_(rays), patches_(patches), records_(records) {
        for (uint32_t r = 0; r < records.patch.size(); ++r) {
            by_block_[key(records.patch[r], {0, 0, 0})].push_back(r);
        }
    }

    /// Records in the block of a patch and the 26 around it.
    [[nodiscard]] std::vector<uint32_t> around(uint32_t patch) const {
        std::vector<uint32_t> found;
        for (int i = 0; i < 27; ++i) {
            const auto at = by_block_.find(key(patch, glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1));
            if (at != by_block_.end()) {
                found.insert(found.end(), at->second.begin(), at->second.end());
            }
        }
        return found;
    }

    /// The heaviest of `nearby` that the patch sees, weights adding up to 1.
    [[nodiscard]] std::vector<Records::Share> shares(uint32_t patch, std::span<const uint32_t> nearby) const {
        constexpr size_t kMost = 8;
        std::vector<Records::Share> all;
        for (uint32_t r : nearby) {
            const float w = weight(patch, r);
            if (w > 0.0f) {
                all.push_back({r, w});
            }
        }
        std::sort(all.begin(), all.end(), [](const Records::Share& a, const Records::Share& b) {
            return a.weight != b.weight ? a.weight > b.weight : a.record < b.record;
        });
        std::vector<Records::Share> kept;
        float sum = 0.0f;
        for (const Records::Share& s : all) {
            if (kept.size() < kMost && sees(patch, records_.patch[s.record])) {
                kept.push_back(s);
                sum += s.weight;
            }
        }
        for (Records::Share& s : kept) {
            s.weight /= sum;
        }
        return kept;
    }

private:
    [[nodiscard]] uint64_t key(uint32_t patch, const glm::ivec3& offset) const noexcept {
        const Patches::Grid& grid = patches_.grids[patches_.grid[patch]];
        const glm::ivec3 block = (grid.cells.cell_at(patches_.order[patch]) >> kTopLevel) + offset + 1;
        return uint64_t(patches_.grid[patch]) << 48 | uint64_t(block.z) << 32 | uint64_t(block.y) << 16 |
               uint64_t(block.x);
    }

    /// Falls from the record's place to nothing at twice its spacing, and with the angle between the
    /// surfaces.
    [[nodiscard]] float weight(uint32_t patch, uint32_t record) const noexcept {
        const uint32_t at = records_.patch[record];
        const float spacing_m = records_.spacing_m[record];
        const glm::vec3 apart = patches_.position[patch] - patches_.position[at];
        if (glm::dot(apart, apart) >= 4.0f * spacing_m * spacing_m) {
            return 0.0f; // most of them: without a root
        }
        const float near = 1.0f - glm::length(apart) / (2.0f * spacing_m);
        const float facing = (glm::dot(patches_.normal[patch], patches_.normal[at]) - 0.6f) / 0.4f;
        const float off_plane = std::abs(glm::dot(patches_.normal[patch], apart)) / spacing_m;
        const float plane = 1.0f - off_plane;
        if (near <= 0.0f || facing <= 0.0f || plane <= 0.0f) {
            return 0.0f;
        }
        return near * near * facing * plane / (spacing_m * spacing_m);
    }

    [[nodiscard]] bool sees(uint32_t a, uint32_t b) const noexcept {
        if (a == b) {
            return true;
        }
        const float cell_m = patches_.grids[patches_.grid[a]].cells.cell_m;
        const float lift_m =
            2.0f * kLift * cell_m + 0.12f * glm::distance(patches_.position[a], patches_.position[b]);
        return !rays_.is_blocked(patches_.position[a] + lift_m * patches_.normal[a],
                                 patches_.position[b] + lift_m * patches_.normal[b]);
    }

    const RayScene& rays_;
    const Patches& patches_;
    const Records& records_;
    std::unordered_map<uint64_t, std::vector<uint32_t>> by_block_;
};

} // namespace

std::vector<std::vector<Records::Share>> find_shares(const RayScene& rays, const Patches& patches,
                                                     const Records& records,
                                                     std::span<const std::span<const Placed>> blocks) {
    const Interpolator interpolator(rays, patches, records);
    std::vector<std::vector<Records::Share>> of_patch(patches.size());
    parallel_for(blocks.size(), 4, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const std::vector<uint32_t> nearby = interpolator.around(blocks[i][0].patch);
            for (const Placed& p : blocks[i]) {
                of_patch[p.patch] = interpolator.shares(p.patch, nearby);
            }
        }
    });
    return of_patch;
}

} // namespace cl::radiosity
