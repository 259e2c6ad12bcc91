#include "servers/radiosity/record_placer.h"

#include "servers/radiosity/sampling.h"

#include "core/threads.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr float kSpacingPerDistance = 0.3f; // a record serves this part of the distance to what is around it
constexpr uint32_t kProbeRays = 32;
constexpr uint32_t kRays[kTopLevel + 1] = {512, 768, 1024};
// Where records are many they lie close and share their noise: a scene takes about this many rays in all.
constexpr uint64_t kRayBudget = 6'000'000;
constexpr uint32_t kLeastRays = 96;

} // namespace

std::vector<RecordDraft> RecordPlacer::place_all(std::span<const std::span<const Placed>> blocks) const {
    std::vector<std::vector<RecordDraft>> parts(blocks.size());
    parallel_for(blocks.size(), 4, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            place(blocks[i], kTopLevel, parts[i]);
        }
    });
    std::vector<RecordDraft> drafts;
    for (std::vector<RecordDraft>& part : parts) {
        std::move(part.begin(), part.end(), std::back_inserter(drafts));
    }
    return drafts;
}

/// Places the records of a run of patches that share a block of `level`.
void RecordPlacer::place(std::span<const Placed> run, int level, std::vector<RecordDraft>& out) const {
    for (const std::vector<Placed>& group : facing_groups(run)) {
        RecordDraft draft{central_patch(group), level, {}, 0, false};
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

glm::vec3 RecordPlacer::finish(RecordDraft& draft, float share, const Emitters& emitters) const {
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
    return emitters.light_at(patches_, rays_, origin, normal, draft.fan, start_of(patches_, draft.patch).x);
}

/// True if all of the scene lies behind a patch. The outer sides of buildings need no rays.
bool RecordPlacer::is_open(uint32_t patch) const noexcept {
    const glm::vec3 normal = patches_.normal[patch];
    const float foremost_m = glm::dot(normal, bounds_.center() - patches_.position[patch]) +
                             glm::dot(glm::abs(normal), 0.5f * bounds_.size);
    return foremost_m < kLift * cell_m(patch);
}

void RecordPlacer::place_parts(std::span<const Placed> group, int level,
                               std::vector<RecordDraft>& out) const {
    for (size_t begin = 0; begin < group.size();) {
        size_t end = begin;
        while (end < group.size() && block_of(group[end].code, level) == block_of(group[begin].code, level)) {
            ++end;
        }
        place(group.subspan(begin, end - begin), level, out);
        begin = end;
    }
}

/// Patches of a run that face about the same way.
std::vector<std::vector<Placed>> RecordPlacer::facing_groups(std::span<const Placed> run) const {
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

uint32_t RecordPlacer::central_patch(std::span<const Placed> group) const noexcept {
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

void RecordPlacer::trace(RecordDraft& draft, uint32_t from, uint32_t to) const {
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

float ray_share(std::span<const RecordDraft> drafts) noexcept {
    uint64_t wanted = 0;
    for (const RecordDraft& d : drafts) {
        wanted += kRays[d.level];
    }
    return wanted > kRayBudget ? float(double(kRayBudget) / double(wanted)) : 1.0f;
}

glm::vec2 start_of(const Patches& patches, uint32_t patch) noexcept {
    return hashed_start(patches.order[patch] * 8 + uint64_t(patches.grid[patch]));
}

} // namespace cl::radiosity
