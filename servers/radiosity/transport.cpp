#include "servers/radiosity/transport.h"

#include "servers/radiosity/sampling.h"

#include "core/threads.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr int kOuterCells = 64;
constexpr int kMaxOuterGrids = 8; // 256 times the size of the probes

CellGrid grid_of_box(const Transform& world_from_box, const AABB& box, int cells) {
    CellGrid grid;
    const float longest_m = std::max(box.size.x, std::max(box.size.y, box.size.z));
    grid.cell_m = longest_m / float(cells);
    for (int axis = 0; axis < 3; ++axis) {
        grid.dims[axis] = std::clamp(int(std::ceil(box.size[axis] / grid.cell_m - 1e-3f)), 1, cells);
    }
    grid.world_from_cells = world_from_box * Transform{glm::mat3(grid.cell_m), box.position};
    grid.cells_from_world = grid.world_from_cells.inverse();
    return grid;
}

AABB with_margin(const AABB& box, int cells) {
    const float longest_m = std::max(box.size.x, std::max(box.size.y, box.size.z));
    return box.grown(longest_m * float(kProbeMargin) / float(std::max(cells - 2 * kProbeMargin, 1)));
}

bool covers(const AABB& outer, const AABB& inner) noexcept {
    return glm::all(glm::lessThanEqual(outer.position, inner.position)) &&
           glm::all(glm::greaterThanEqual(outer.position + outer.size, inner.position + inner.size));
}

/// Cells along a grid's longest axis. Surface, and with it patches, grows with their square: many probes
/// share what kFullGrids of them would have, or 64 probes would take minutes.
int cells_of_grid(int wanted, size_t probe_count) noexcept {
    constexpr float kFullGrids = 4.0f;
    constexpr int kLeastCells = 16;
    const float share = std::sqrt(std::min(1.0f, kFullGrids / float(probe_count)));
    return std::max(int(float(wanted) * share), std::min(wanted, kLeastCells));
}

/// The probes' grids, finest first, then coarser and coarser ones around all of them until the scene is
/// covered: what stands outside still shades and bounces.
std::vector<CellGrid> make_grids(const StillScene& scene, std::span<const ProbeBox> probes) {
    std::vector<CellGrid> grids;
    AABB all = transformed(probes[0].world_from_probe, probes[0].box);
    for (const ProbeBox& p : probes) {
        const int cells = cells_of_grid(p.cells, probes.size());
        grids.push_back(grid_of_box(p.world_from_probe, with_margin(p.box, cells), cells));
        all = all.merged(transformed(p.world_from_probe, p.box));
    }
    const AABB bounds = scene.bounds();
    for (int i = 1; i <= kMaxOuterGrids && !covers(all, bounds); ++i) {
        all = {all.position - 0.5f * all.size, 2.0f * all.size};
        grids.push_back(grid_of_box({}, all, kOuterCells));
    }
    return grids;
}

/// One of the records that a patch interpolates, each with the odds of its weight: over many links that is
/// the interpolation. The heaviest instead would make light steeper, and a bright corridor brighter by a
/// fifth.
/// @param odds  0 to 1
uint32_t drawn_record(const Records& records, uint32_t patch, float odds) noexcept {
    uint32_t drawn = kNoPatch;
    for (const Records::Share& share : records.of_patch(patch)) {
        drawn = share.record;
        odds -= share.weight;
        if (odds < 0.0f) {
            break;
        }
    }
    return drawn;
}

/// Later bounces are smooth: a few hundred of a point's links, evenly chosen, stand for all.
std::vector<Transport::Exchange> exchanges_of(const Transport& t, size_t record_number) {
    const Links::Point& point = t.records.links.points[record_number];
    const glm::vec2 start = hashed_start(record_number);
    constexpr size_t kMostLinks = 96;
    const std::span<const uint32_t> links = t.records.links.patches_of(point);
    const size_t asked = std::min(links.size(), kMostLinks);
    std::vector<Transport::Exchange> out;
    for (size_t i = 0; i < asked; ++i) {
        // Anywhere in each of as many parts of the list: it is sorted, and its parts' first would all lie to
        // one side of what they stand for.
        const glm::vec2 odds = r2_point(uint32_t(i), start);
        const size_t link = size_t((float(i) + odds.x) * float(links.size()) / float(asked));
        const uint32_t patch = links[std::min(link, links.size() - 1)];
        const uint32_t record = drawn_record(t.records, patch, odds.y);
        if (record != kNoPatch) {
            const float weight = float(links.size()) / (float(asked) * float(point.ray_count));
            out.push_back({t.patches.albedo[patch] * weight, record});
        }
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.record < b.record; });
    size_t last = 0;
    for (size_t i = 1; i < out.size(); ++i) {
        if (out[i].record == out[last].record) {
            out[last].albedo += out[i].albedo;
        } else {
            out[++last] = out[i];
        }
    }
    out.resize(std::min(out.size(), last + 1));
    return out;
}

void add_exchanges(Transport& t) {
    const std::vector<Links::Point>& points = t.records.links.points;
    std::vector<std::vector<Transport::Exchange>> found(points.size());
    parallel_for(points.size(), 64, [&](size_t begin, size_t end) {
        for (size_t r = begin; r < end; ++r) {
            found[r] = exchanges_of(t, r);
        }
    });
    for (const std::vector<Transport::Exchange>& list : found) {
        t.exchange_first.push_back(uint32_t(t.exchanges.size()));
        t.exchanges.insert(t.exchanges.end(), list.begin(), list.end());
    }
    t.exchange_first.push_back(uint32_t(t.exchanges.size()));
}

} // namespace

size_t Transport::bytes() const noexcept {
    const size_t per_patch = 5 * sizeof(glm::vec3) + 2 * sizeof(uint64_t);
    return patches.size() * per_patch + records.links.targets.size() * sizeof(uint32_t) +
           records.shares.size() * sizeof(Records::Share) + exchanges.size() * sizeof(Exchange);
}

Expected<std::shared_ptr<const Transport>> make_transport(const std::shared_ptr<const StillScene>& scene,
                                                          std::span<const ProbeBox> probes,
                                                          const std::atomic<bool>& stop) {
    Expected<RayScene> rays = RayScene::create(*scene);
    if (!rays) {
        return rays.error();
    }
    const Error cancelled{ErrorCode::Cancelled, "light transport: cancelled"};
    auto t = std::make_shared<Transport>(Transport{scene, std::move(*rays), {}, {}, probes.size(), {}, {}});
    t->patches = make_patches(*scene, t->rays, make_grids(*scene, probes), probes.size());
    if (stop) {
        return cancelled;
    }
    t->records = make_records(*scene, t->rays, t->patches);
    if (stop) {
        return cancelled;
    }
    add_exchanges(*t);
    if (stop) {
        return cancelled;
    }
    return std::shared_ptr<const Transport>(std::move(t));
}

} // namespace cl::radiosity
