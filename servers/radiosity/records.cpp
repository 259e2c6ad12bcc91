#include "servers/radiosity/records.h"

#include "servers/radiosity/emitter_tree.h"
#include "servers/radiosity/emitters.h"
#include "servers/radiosity/open_skies.h"
#include "servers/radiosity/patch_blocks.h"
#include "servers/radiosity/record_placer.h"
#include "servers/radiosity/record_shares.h"

#include "core/threads.h"

#include <algorithm>

namespace cl::radiosity {
namespace {

/// Traces what rays are still to be traced and lists where they end.
void finish_links(const RecordPlacer& placer, const Patches& patches, std::vector<RecordDraft>& drafts,
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
    for (const RecordDraft& d : drafts) {
        targets += d.is_open ? 0 : d.fan.patches.size() + d.fan.skies.size();
    }
    records.links.targets.reserve(targets);
    OpenSkies open_skies(records.links);
    for (RecordDraft& d : drafts) {
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
    const RecordPlacer placer(rays, patches, scene.bounds());
    std::vector<RecordDraft> drafts = placer.place_all(blocks);
    Records records;
    const auto add = [&](const RecordDraft& d) {
        records.patch.push_back(d.patch);
        records.spacing_m.push_back(patches.grids[patches.grid[d.patch]].cells.cell_m * float(1 << d.level));
    };
    std::for_each(drafts.begin(), drafts.end(), add);
    std::vector<std::vector<Records::Share>> of_patch = find_shares(rays, patches, records, blocks);
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
