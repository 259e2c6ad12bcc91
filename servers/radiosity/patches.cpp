#include "servers/radiosity/patches.h"

#include "servers/radiosity/fragments.h"
#include "servers/radiosity/openness.h"

#include "core/threads.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace cl::radiosity {
namespace {

// Fragments of one patch face the same way within 37 degrees and lie in one plane within a third of a cell.
constexpr float kSameFacing = 0.8f;
constexpr float kSamePlane_cells = 0.34f;
constexpr float kOneLayer_cells = 0.02f;
constexpr size_t kMaxCandidates = 10;

/// Fragments of a cell that face one way and lie in one plane.
struct Cluster {
    glm::vec3 normal_sum{0.0f}, centroid_sum{0.0f}, normal{0.0f};
    float area_cells = 0.0f;
    std::vector<uint32_t> fragments;

    void add(const Fragment& f, const glm::vec3& facing, uint32_t index) {
        normal_sum += facing * f.area_cells;
        centroid_sum += f.centroid * f.area_cells;
        area_cells += f.area_cells;
        normal = glm::normalize(normal_sum);
        fragments.push_back(index);
    }
    [[nodiscard]] glm::vec3 centroid() const noexcept { return centroid_sum / area_cells; }
};

std::vector<Cluster> cluster(const StillScene& scene, std::span<const Fragment> all, size_t begin, size_t end,
                             float cell_m) {
    std::vector<Cluster> clusters;
    for (size_t i = begin; i < end; ++i) {
        const Fragment& f = all[i];
        const glm::vec3 facing = facing_of(scene, f);
        const auto fits = [&](const Cluster& c) {
            const float apart_m = std::abs(glm::dot(c.normal, f.centroid - c.centroid()));
            return glm::dot(c.normal, facing) > kSameFacing && apart_m < kSamePlane_cells * cell_m;
        };
        const auto home = std::find_if(clusters.begin(), clusters.end(), fits);
        (home == clusters.end() ? clusters.emplace_back() : *home).add(f, facing, uint32_t(i));
    }
    return clusters;
}

/// A patch before it gets its number.
struct Draft {
    glm::vec3 position, normal, albedo{0.0f}, emission{0.0f};
    float area_m2 = 0.0f, openness_m = 0.0f;
    uint64_t order = 0;
    uint8_t grid = 0;
};

class CellCutter {
public:
    CellCutter(const StillScene& scene, const RayScene& rays, std::span<const CellGrid> grids,
               std::span<const Fragment> all)
        : scene_(scene), rays_(rays), grids_(grids), all_(all) {}

    void cut_cell(size_t begin, size_t end, std::vector<Draft>& out) const {
        const CellGrid& grid = grids_[all_[begin].grid];
        const std::vector<Cluster> clusters = cluster(scene_, all_, begin, end, grid.cell_m);
        for (const Cluster& c : clusters) {
            Draft draft = summed(c, grid);
            const glm::vec3 middle = nearest_fragment(c);
            draft.openness_m = openness(rays_, middle, draft.normal, grid.cell_m);
            if (draft.openness_m >= 0.0f && is_alone(clusters, c, grid.cell_m)) {
                draft.position = middle;
                out.push_back(draft);
            } else {
                const bool is_buried = draft.openness_m == kBuried;
                add_spaces(c, draft, grid, is_buried ? std::optional(middle) : std::nullopt, out);
            }
        }
    }

private:
    /// True if nothing can divide a cluster into several spaces: no other in the cell, no second layer of its
    /// own.
    [[nodiscard]] bool is_alone(std::span<const Cluster> clusters, const Cluster& c,
                                float cell_m) const noexcept {
        const glm::vec3 middle = c.centroid();
        return clusters.size() == 1 && std::all_of(c.fragments.begin(), c.fragments.end(), [&](uint32_t i) {
                   return std::abs(glm::dot(all_[i].centroid - middle, c.normal)) < kOneLayer_cells * cell_m;
               });
    }

    /// Colours and area of a cluster.
    Draft summed(const Cluster& c, const CellGrid& grid) const {
        Draft draft;
        draft.normal = c.normal;
        draft.order = all_[c.fragments[0]].order;
        draft.grid = all_[c.fragments[0]].grid;
        for (uint32_t i : c.fragments) {
            const Fragment& f = all_[i];
            const float share = f.area_cells / c.area_cells;
            const float footprint = scene_.uv_per_m(f.triangle) * grid.cell_m;
            const glm::vec2 at = barycentric(scene_, f);
            draft.albedo += share * glm::clamp(scene_.albedo(f.triangle, at, footprint), 0.0f, 1.0f);
            draft.emission += share * glm::max(scene_.emission(f.triangle, at, footprint), 0.0f);
        }
        draft.area_m2 = c.area_cells * grid.cell_m * grid.cell_m;
        return draft;
    }

    /// The centroid of that fragment that lies nearest to the middle of all: a point of the surface.
    glm::vec3 nearest_fragment(const Cluster& c) const noexcept {
        const glm::vec3 middle = c.centroid();
        const auto nearer = [&](uint32_t a, uint32_t b) {
            return glm::distance(all_[a].centroid, middle) < glm::distance(all_[b].centroid, middle);
        };
        return all_[*std::min_element(c.fragments.begin(), c.fragments.end(), nearer)].centroid;
    }

    /// Points spread over a cluster, from its largest fragments.
    std::vector<glm::vec3> candidates(const Cluster& c, const CellGrid& grid) const {
        std::vector<uint32_t> largest = c.fragments;
        std::stable_sort(largest.begin(), largest.end(),
                         [this](uint32_t a, uint32_t b) { return all_[a].area_cells > all_[b].area_cells; });
        std::vector<glm::vec3> points;
        for (size_t i = 0; i < std::min(largest.size(), kMaxCandidates / 2); ++i) {
            points.push_back(all_[largest[i]].centroid);
        }
        for (uint32_t i : largest) {
            const Fragment& f = all_[i];
            if (points.size() >= kMaxCandidates) {
                break;
            }
            const glm::vec3 facing = facing_of(scene_, f);
            const Polygon piece = outline(scene_, grid, f);
            for (size_t k = 0; k < piece.count; ++k) {
                const glm::vec3 corner =
                    grid.world_from_cells.xform(piece.corners[k]) + kNudge_cells * grid.cell_m * facing;
                points.push_back(glm::mix(f.centroid, corner, 0.75f));
            }
        }
        return points;
    }

    /// A patch for each space that a cluster borders on. @param buried  a point of it that is, if known
    void add_spaces(const Cluster& c, const Draft& draft, const CellGrid& grid,
                    const std::optional<glm::vec3>& buried, std::vector<Draft>& out) const {
        const std::vector<glm::vec3> asked = candidates(c, grid);
        const std::vector<float> all_m = openness_of_all(rays_, asked, draft.normal, grid.cell_m, buried);
        std::vector<glm::vec3> points;
        std::vector<float> open_m;
        for (size_t i = 0; i < asked.size(); ++i) {
            if (all_m[i] >= 0.0f) {
                points.push_back(asked[i]);
                open_m.push_back(all_m[i]);
            }
        }
        const std::vector<size_t> space = spaces(rays_, points, draft.normal, grid.cell_m);
        for (size_t i = 0; i < points.size(); ++i) {
            if (space[i] != i) {
                continue;
            }
            Draft one = draft;
            one.openness_m = 0.0f;
            std::vector<glm::vec3> members;
            for (size_t j = i; j < points.size(); ++j) {
                if (space[j] == i) {
                    members.push_back(points[j]);
                    // As open as its most open point: the others may lie close to a wall.
                    one.openness_m = std::max(one.openness_m, open_m[j]);
                }
            }
            one.position = most_central(members);
            one.area_m2 = draft.area_m2 * float(members.size()) / float(asked.size());
            out.push_back(one);
        }
    }

    static glm::vec3 most_central(const std::vector<glm::vec3>& points) noexcept {
        glm::vec3 middle(0.0f);
        for (const glm::vec3& p : points) {
            middle += p / float(points.size());
        }
        return *std::min_element(points.begin(), points.end(), [&](const glm::vec3& a, const glm::vec3& b) {
            return glm::distance(a, middle) < glm::distance(b, middle);
        });
    }

    const StillScene& scene_;
    const RayScene& rays_;
    std::span<const CellGrid> grids_;
    std::span<const Fragment> all_;
};

void append(Patches& out, const Draft& d) {
    out.position.push_back(d.position);
    out.normal.push_back(d.normal);
    out.albedo.push_back(d.albedo);
    out.emission.push_back(d.emission);
    out.area_m2.push_back(d.area_m2);
    out.openness_m.push_back(d.openness_m);
    out.grid.push_back(d.grid);
    out.order.push_back(d.order);
}

/// Numbers the occupied cells; patches stand in their order.
void index_cells(Patches& patches, std::span<const CellGrid> grids) {
    size_t at = 0;
    for (const CellGrid& cells : grids) {
        Patches::Grid grid{cells, {}, {}, {}};
        std::vector<uint64_t> orders;
        const size_t number = patches.grids.size();
        for (; at < patches.size() && patches.grid[at] == number; ++at) {
            if (orders.empty() || orders.back() != patches.order[at]) {
                orders.push_back(patches.order[at]);
                grid.first.push_back(uint32_t(at));
                grid.sought.push_back({uint32_t(at), glm::packSnorm3x10_1x2({patches.normal[at], 1.0f})});
            } else {
                grid.sought.back().normal = 0;
            }
        }
        grid.first.push_back(uint32_t(at));
        grid.index = CellIndex(cells, orders);
        patches.grids.push_back(std::move(grid));
    }
}

} // namespace

Patches make_patches(const StillScene& scene, const RayScene& rays, std::span<const CellGrid> grids,
                     size_t probe_count) {
    const std::vector<Fragment> all = cut_fragments(scene, grids, probe_count);
    const std::vector<size_t> starts = cell_starts(all);
    constexpr size_t kGrain = 256;
    const size_t cells = starts.size() - 1;
    std::vector<std::vector<Draft>> drafts((cells + kGrain - 1) / kGrain);
    const CellCutter cutter(scene, rays, grids, all);
    parallel_for(drafts.size(), 1, [&](size_t begin, size_t end) {
        for (size_t chunk = begin; chunk < end; ++chunk) {
            for (size_t cell = chunk * kGrain; cell < std::min((chunk + 1) * kGrain, cells); ++cell) {
                cutter.cut_cell(starts[cell], starts[cell + 1], drafts[chunk]);
            }
        }
    });
    Patches patches;
    for (const std::vector<Draft>& part : drafts) {
        for (const Draft& d : part) {
            append(patches, d);
        }
    }
    index_cells(patches, grids);
    return patches;
}

} // namespace cl::radiosity
