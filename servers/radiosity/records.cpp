#include "servers/radiosity/records.h"

#include "servers/radiosity/emitter_tree.h"
#include "servers/radiosity/emitters.h"
#include "servers/radiosity/open_skies.h"
#include "servers/radiosity/sampling.h"

#include "core/math/aabb.h"
#include "core/threads.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr int kTopLevel = 2;                // blocks of 4 cells an edge at most
constexpr float kSpacingPerDistance = 0.3f; // a record serves this part of the distance to what is around it
constexpr uint32_t kProbeRays = 32;
constexpr uint32_t kRays[kTopLevel + 1] = {512, 768, 1024};
// Where records are many they lie close and share their noise: a scene takes about this many rays in all.
constexpr uint64_t kRayBudget = 6'000'000;
constexpr uint32_t kLeastRays = 96;

/// Interleaves bits: neighbours in a block of 2^k cells differ in the low 3 k bits.
uint64_t morton(const glm::ivec3& cell) noexcept {
    uint64_t code = 0;
    for (int bit = 0; bit < 10; ++bit) {
        code |= uint64_t((cell.x >> bit) & 1) << (3 * bit) | uint64_t((cell.y >> bit) & 1) << (3 * bit + 1) |
                uint64_t((cell.z >> bit) & 1) << (3 * bit + 2);
    }
    return code;
}

/// A patch with the name of its cell, so that blocks of cells are runs.
struct Placed {
    uint64_t code; ///< grid, then Morton code
    uint32_t patch;
};

std::vector<Placed> in_morton_order(const Patches& patches) {
    std::vector<Placed> out(patches.size());
    for (uint32_t p = 0; p < out.size(); ++p) {
        const Patches::Grid& grid = patches.grids[patches.grid[p]];
        out[p] = {uint64_t(patches.grid[p]) << 32 | morton(grid.cells.cell_at(patches.order[p])), p};
    }
    std::sort(out.begin(), out.end(), [](const Placed& a, const Placed& b) {
        return a.code != b.code ? a.code < b.code : a.patch < b.patch;
    });
    return out;
}

uint64_t block_of(uint64_t code, int level) noexcept {
    return code >> (3 * level);
}

/// Differs between neighbours.
glm::vec2 start_of(const Patches& patches, uint32_t patch) noexcept {
    return hashed_start(patches.order[patch] * 8 + uint64_t(patches.grid[patch]));
}

/// A record that is to be, with the rays traced so far.
struct Draft {
    uint32_t patch = 0;
    int level = 0;
    RayFan fan;
    uint32_t rays = 0;    ///< it is to have in the end
    bool is_open = false; ///< nothing is before it but sky
};

class Placer {
public:
    Placer(const StillScene& scene, const RayScene& rays, const Patches& patches)
        : scene_(scene), rays_(rays), patches_(patches), bounds_(scene.bounds()) {}

    /// Places the records of a run of patches that share a block of `level`.
    void place(std::span<const Placed> run, int level, std::vector<Draft>& out) const {
        for (const std::vector<Placed>& group : facing_groups(run)) {
            Draft draft{central_patch(group), level, {}, 0, false};
            draft.is_open = is_open(draft.patch);
            if (!draft.is_open) {
                trace(draft, 0, kProbeRays);
            }
            const float spacing_m = cell_m(draft.patch) * float(1 << level);
            if (level == 0 || spacing_m <= kSpacingPerDistance * draft.fan.mean_distance_m()) {
                out.push_back(std::move(draft));
            } else {
                place_parts(group, level - 1, out);
            }
        }
    }
    /// Traces the rays a record still lacks. @param share  of the full number
    /// @return what emitters send it
    glm::vec3 finish(Draft& draft, float share, const Emitters& emitters) const {
        draft.rays = std::max(uint32_t(share * float(kRays[draft.level])), kLeastRays);
        if (draft.is_open) {
            return glm::vec3(0.0f);
        }
        trace(draft, draft.fan.ray_count, draft.rays);
        if (emitters.empty()) {
            return glm::vec3(0.0f);
        }
        const glm::vec3 normal = patches_.normal[draft.patch];
        const glm::vec3 origin = patches_.position[draft.patch] + kLift * cell_m(draft.patch) * normal;
        return emitters.light_at(patches_, rays_, origin, normal, draft.fan,
                                 start_of(patches_, draft.patch).x);
    }

private:
    [[nodiscard]] float cell_m(uint32_t patch) const noexcept {
        return patches_.grids[patches_.grid[patch]].cells.cell_m;
    }

    /// True if all of the scene lies behind a patch. The outer sides of buildings need no rays.
    [[nodiscard]] bool is_open(uint32_t patch) const noexcept {
        const glm::vec3 normal = patches_.normal[patch];
        const float foremost_m = glm::dot(normal, bounds_.center() - patches_.position[patch]) +
                                 glm::dot(glm::abs(normal), 0.5f * bounds_.size);
        return foremost_m < kLift * cell_m(patch);
    }

    void place_parts(std::span<const Placed> group, int level, std::vector<Draft>& out) const {
        for (size_t begin = 0; begin < group.size();) {
            size_t end = begin;
            while (end < group.size() &&
                   block_of(group[end].code, level) == block_of(group[begin].code, level)) {
                ++end;
            }
            place(group.subspan(begin, end - begin), level, out);
            begin = end;
        }
    }

    /// Patches of a run that face about the same way.
    [[nodiscard]] std::vector<std::vector<Placed>> facing_groups(std::span<const Placed> run) const {
        std::vector<std::vector<Placed>> groups;
        for (const Placed& p : run) {
            const auto fits = [&](const std::vector<Placed>& g) {
                return glm::dot(patches_.normal[g[0].patch], patches_.normal[p.patch]) > 0.85f;
            };
            const auto home = std::find_if(groups.begin(), groups.end(), fits);
            (home == groups.end() ? groups.emplace_back() : *home).push_back(p);
        }
        return groups;
    }

    [[nodiscard]] uint32_t central_patch(std::span<const Placed> group) const noexcept {
        glm::vec3 middle(0.0f);
        for (const Placed& p : group) {
            middle += patches_.position[p.patch] / float(group.size());
        }
        const auto nearer = [&](const Placed& a, const Placed& b) {
            return glm::distance(patches_.position[a.patch], middle) <
                   glm::distance(patches_.position[b.patch], middle);
        };
        return std::min_element(group.begin(), group.end(), nearer)->patch;
    }

    void trace(Draft& draft, uint32_t from, uint32_t to) const {
        const glm::vec3 normal = patches_.normal[draft.patch];
        const glm::vec3 origin = patches_.position[draft.patch] + kLift * cell_m(draft.patch) * normal;
        const CosineFrame frame(normal);
        const glm::vec2 start = start_of(patches_, draft.patch);
        std::vector<Ray> asked;
        for (uint32_t i = from; i < to; ++i) {
            asked.push_back({origin, frame.direction(r2_point(i, start))});
        }
        add_rays(rays_, patches_, asked, draft.fan);
    }

    const StillScene& scene_;
    const RayScene& rays_;
    const Patches& patches_;
    AABB bounds_; ///< of the scene
};

/// Runs of patches that share a block of the top level.
std::vector<std::span<const Placed>> top_blocks(std::span<const Placed> placed) {
    std::vector<std::span<const Placed>> runs;
    for (size_t begin = 0; begin < placed.size();) {
        size_t end = begin;
        while (end < placed.size() &&
               block_of(placed[end].code, kTopLevel) == block_of(placed[begin].code, kTopLevel)) {
            ++end;
        }
        runs.push_back(placed.subspan(begin, end - begin));
        begin = end;
    }
    return runs;
}

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

/// Calls make(i) for i in [0, count) on all workers; results in order.
template <typename F>
auto parallel_list(size_t count, const F& make) {
    std::vector<decltype(make(size_t{}))> out(count);
    parallel_for(count, 4, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            out[i] = make(i);
        }
    });
    return out;
}

/// Places the records of all blocks, in order.
std::vector<Draft> place_all(const Placer& placer, std::span<const std::span<const Placed>> blocks) {
    std::vector<Draft> drafts;
    for (std::vector<Draft>& part : parallel_list(blocks.size(), [&](size_t i) {
             std::vector<Draft> out;
             placer.place(blocks[i], kTopLevel, out);
             return out;
         })) {
        std::move(part.begin(), part.end(), std::back_inserter(drafts));
    }
    return drafts;
}

/// Shares of every patch; empty where it sees no record.
std::vector<std::vector<Records::Share>> find_shares(const Interpolator& interpolator, size_t patch_count,
                                                     std::span<const std::span<const Placed>> blocks) {
    std::vector<std::vector<Records::Share>> of_patch(patch_count);
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

/// Part of their full number of rays that records may have, so that all together keep to the budget.
float ray_share(std::span<const Draft> drafts) noexcept {
    uint64_t wanted = 0;
    for (const Draft& d : drafts) {
        wanted += kRays[d.level];
    }
    return wanted > kRayBudget ? float(double(kRayBudget) / double(wanted)) : 1.0f;
}

/// Traces what rays are still to be traced and lists where they end.
void finish_links(const Placer& placer, const Patches& patches, std::vector<Draft>& drafts,
                  Records& records) {
    const float share = ray_share(drafts);
    const Emitters emitters(patches);
    records.emitted.resize(drafts.size());
    parallel_for(drafts.size(), 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            records.emitted[i] = placer.finish(drafts[i], share, emitters);
            sort_patches(drafts[i].fan.patches, patches.size());
        }
    });
    size_t targets = 0;
    for (const Draft& d : drafts) {
        targets += d.is_open ? 0 : d.fan.patches.size() + d.fan.skies.size();
    }
    records.links.targets.reserve(targets);
    OpenSkies open_skies(records.links);
    for (Draft& d : drafts) {
        if (d.is_open) {
            open_skies.append_point(patches.normal[d.patch], d.rays);
        } else {
            append_point(records.links, d.fan);
        }
        d.fan = {}; // its memory is in the lists now
    }
}

/// Light straight from emitters is steep beside them and has edges in their shadows: what interpolation makes
/// of the records' is put right at every patch, once, as emitters do not change. Where too much shines for
/// that, patches that are records keep their own at least.
void add_emitted_detail(const StillScene& scene, const RayScene& rays, const Patches& patches,
                        Records& records) {
    const auto is_dark = [](const glm::vec3& e) { return e == glm::vec3(0.0f); };
    const EmitterTree tree(scene, patches);
    if (tree.empty() && std::all_of(records.emitted.begin(), records.emitted.end(), is_dark)) {
        return;
    }
    const auto interpolated = [&](uint32_t patch) {
        glm::vec3 sum(0.0f);
        for (const Records::Share& s : records.of_patch(patch)) {
            sum += s.weight * records.emitted[s.record];
        }
        return sum;
    };
    records.emitted_detail.resize(patches.size(), glm::vec3(0.0f));
    if (tree.empty()) {
        for (size_t r = 0; r < records.patch.size(); ++r) {
            const uint32_t p = records.patch[r];
            records.emitted_detail[p] = records.emitted[r] - interpolated(p);
        }
        return;
    }
    parallel_for(patches.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint32_t p = uint32_t(i);
            const float lift_m = kLift * patches.grids[patches.grid[p]].cells.cell_m;
            const float start = start_of(patches, p).x;
            records.emitted_detail[p] =
                tree.light_at(rays, patches.position[p], patches.normal[p], lift_m, start) - interpolated(p);
        }
    });
}

} // namespace

Records make_records(const StillScene& scene, const RayScene& rays, const Patches& patches) {
    const std::vector<Placed> placed = in_morton_order(patches);
    const std::vector<std::span<const Placed>> blocks = top_blocks(placed);
    const Placer placer(scene, rays, patches);
    std::vector<Draft> drafts = place_all(placer, blocks);
    Records records;
    const auto add = [&](const Draft& d) {
        records.patch.push_back(d.patch);
        records.spacing_m.push_back(patches.grids[patches.grid[d.patch]].cells.cell_m * float(1 << d.level));
    };
    std::for_each(drafts.begin(), drafts.end(), add);
    std::vector<std::vector<Records::Share>> of_patch =
        find_shares(Interpolator(rays, patches, records), patches.size(), blocks);
    // Patches that see no record become records themselves.
    for (uint32_t p = 0; p < of_patch.size(); ++p) {
        if (of_patch[p].empty()) {
            of_patch[p] = {{uint32_t(drafts.size()), 1.0f}};
            drafts.push_back({p, 0, {}, 0, false}); // open or not, rays tell
            add(drafts.back());
        }
    }
    finish_links(placer, patches, drafts, records);
    for (const std::vector<Records::Share>& shares : of_patch) {
        records.first.push_back(uint32_t(records.shares.size()));
        records.shares.insert(records.shares.end(), shares.begin(), shares.end());
    }
    records.first.push_back(uint32_t(records.shares.size()));
    add_emitted_detail(scene, rays, patches, records);
    return records;
}

} // namespace cl::radiosity
