#include "servers/radiosity/patches.h"

#include "servers/radiosity/polygon.h"
#include "servers/radiosity/sampling.h"

#include "core/threads.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace cl::radiosity {
namespace {

// A face on the border of two cells belongs to the one behind it, whatever rounding says.
constexpr float kNudge_cells = 1e-3f;
constexpr float kLeastArea_cells = 1e-5f;
// Fragments of one patch face the same way within 37 degrees and lie in one plane within a third of a cell.
constexpr float kSameFacing = 0.8f;
constexpr float kSamePlane_cells = 0.34f;
constexpr float kOneLayer_cells = 0.02f;
constexpr size_t kMaxCandidates = 10;

/// A piece of a triangle in a cell.
struct Fragment {
    uint64_t order;
    uint32_t triangle;
    float area_cells;
    glm::vec3 centroid; ///< [m]
    uint8_t grid;
    bool back; ///< the back side of a two-sided surface
};

bool is_inside_finer(std::span<const CellGrid> finer, const glm::vec3& world) noexcept {
    return std::any_of(finer.begin(), finer.end(),
                       [&](const CellGrid& g) { return g.contains(g.cells_from_world.xform(world)); });
}

/// The triangle in cells, moved behind its face by a hair.
Polygon in_cells(const StillScene& scene, uint32_t triangle, const CellGrid& grid,
                 const glm::vec3& facing) noexcept {
    Polygon p;
    const glm::vec3 shift = -kNudge_cells * grid.cell_m * facing;
    for (int i = 0; i < 3; ++i) {
        p.add(grid.cells_from_world.xform(scene.positions[scene.triangles[triangle][i]] + shift));
    }
    return p;
}

glm::vec3 facing_of(const StillScene& scene, uint32_t triangle, bool back) noexcept {
    return back ? -scene.normal(triangle) : scene.normal(triangle);
}

/// Fragments of a range of triangles in one grid.
void cut(const StillScene& scene, std::span<const CellGrid> grids, size_t probe_count, size_t grid_index,
         size_t begin, size_t end, std::vector<Fragment>& out) {
    const CellGrid& grid = grids[grid_index];
    const std::span<const CellGrid> finer = grids.first(grid_index < probe_count ? 0 : grid_index);
    for (size_t t = begin; t < end; ++t) {
        const uint32_t triangle = uint32_t(t);
        const int sides = scene.surfaces[scene.surface_of[t]].two_sided ? 2 : 1;
        for (int side = 0; side < sides; ++side) {
            const glm::vec3 facing = facing_of(scene, triangle, side == 1);
            const Polygon whole = in_cells(scene, triangle, grid, facing);
            for_each_cell_piece(whole, grid.dims, [&](const glm::ivec3& cell, const Polygon& piece) {
                glm::vec3 centroid;
                const float area = piece.area_and_centroid(centroid);
                const glm::vec3 world =
                    grid.world_from_cells.xform(centroid) + kNudge_cells * grid.cell_m * facing;
                if (area > kLeastArea_cells && !is_inside_finer(finer, world)) {
                    out.push_back({grid.order(cell), triangle, area, world, uint8_t(grid_index), side == 1});
                }
            });
        }
    }
}

std::vector<Fragment> cut_all(const StillScene& scene, std::span<const CellGrid> grids, size_t probe_count) {
    constexpr size_t kGrain = 256;
    const size_t chunks = (scene.triangles.size() + kGrain - 1) / kGrain;
    std::vector<std::vector<Fragment>> parts(chunks * grids.size());
    parallel_for(parts.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const size_t first = i % chunks * kGrain;
            cut(scene, grids, probe_count, i / chunks, first,
                std::min(first + kGrain, scene.triangles.size()), parts[i]);
        }
    });
    std::vector<Fragment> all;
    for (std::vector<Fragment>& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
        part = {}; // a large scene has hundreds of megabytes of them
    }
    tbb::parallel_sort(all.begin(), all.end(), [](const Fragment& a, const Fragment& b) {
        return std::tie(a.grid, a.order, a.triangle, a.back) < std::tie(b.grid, b.order, b.triangle, b.back);
    });
    return all;
}

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
        const glm::vec3 facing = facing_of(scene, f.triangle, f.back);
        const auto fits = [&](const Cluster& c) {
            const float apart_m = std::abs(glm::dot(c.normal, f.centroid - c.centroid()));
            return glm::dot(c.normal, facing) > kSameFacing && apart_m < kSamePlane_cells * cell_m;
        };
        const auto home = std::find_if(clusters.begin(), clusters.end(), fits);
        (home == clusters.end() ? clusters.emplace_back() : *home).add(f, facing, uint32_t(i));
    }
    return clusters;
}

/// A point of a surface, lifted off it so that rays do not meet the surface itself.
glm::vec3 lifted(const glm::vec3& point, const glm::vec3& normal, float cell_m) noexcept {
    return point + kLift * cell_m * normal;
}

/// What a few rays from a point of a surface meet.
struct Outlook {
    int backs = 0;   ///< backs of surfaces
    int unclear = 0; ///< a front and a back in one place: two solids that touch, or a wall of no thickness
    float openness_m = 1e30f; ///< harmonic mean of the distances
};

template <size_t kCount>
Outlook look(const RayScene& rays, const std::array<Ray, kCount>& asked, float cell_m) noexcept {
    std::array<Hit, kCount> fronts, backs;
    rays.trace_side(RayScene::Side::Front, asked, fronts);
    rays.trace_side(RayScene::Side::Back, asked, backs);
    Outlook outlook;
    float inverse_sum = 0.0f;
    for (size_t i = 0; i < kCount; ++i) {
        const float front_m = fronts[i].triangle == kMiss ? 1e30f : fronts[i].t;
        const float back_m = backs[i].triangle == kMiss ? 1e30f : backs[i].t;
        const float nearest_m = std::min(front_m, back_m);
        const bool one_place = nearest_m < 1e30f && std::abs(front_m - back_m) < kNudge_cells * cell_m;
        outlook.unclear += one_place ? 1 : 0;
        outlook.backs += !one_place && back_m < front_m ? 1 : 0;
        inverse_sum += nearest_m < 1e30f ? 1.0f / std::max(nearest_m, 1e-6f) : 0.0f;
    }
    outlook.openness_m = inverse_sum > 0.0f ? float(kCount) / inverse_sum : 1e30f;
    return outlook;
}

/// How open the space before a point is [m]; less than 0 if most rays meet the backs of surfaces: it lies
/// inside a solid. A few rays settle it where none does; more are asked otherwise, and those that meet faces
/// of two solids that touch do not count.
float openness(const RayScene& rays, const glm::vec3& point, const glm::vec3& normal, float cell_m) noexcept {
    const CosineFrame frame(normal);
    const glm::vec3 origin = lifted(point, normal, cell_m);
    std::array<Ray, 5> few;
    for (size_t i = 0; i < few.size(); ++i) {
        const glm::vec2 u = i == 0 ? glm::vec2(0.0f) : glm::vec2(0.64f, 0.25f * float(i) - 0.125f);
        few[i] = {origin, frame.direction(u)};
    }
    const Outlook first = look(rays, few, cell_m);
    if (first.backs + first.unclear == 0) {
        return first.openness_m;
    }
    std::array<Ray, 24> many;
    for (uint32_t i = 0; i < many.size(); ++i) {
        many[i] = {origin, frame.direction(r2_point(i, glm::vec2(0.5f)))};
    }
    const Outlook second = look(rays, many, cell_m);
    const int clear = int(many.size()) - second.unclear;
    return clear > 0 && second.backs * 2 >= clear ? -1.0f : second.openness_m;
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
                add_spaces(c, draft, grid, out);
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
            const glm::vec2 at = barycentric(f);
            draft.albedo += share * glm::clamp(scene_.albedo(f.triangle, at, footprint), 0.0f, 1.0f);
            draft.emission += share * glm::max(scene_.emission(f.triangle, at, footprint), 0.0f);
        }
        draft.area_m2 = c.area_cells * grid.cell_m * grid.cell_m;
        return draft;
    }

    glm::vec2 barycentric(const Fragment& f) const noexcept {
        const glm::uvec3 t = scene_.triangles[f.triangle];
        const glm::vec3 a = scene_.positions[t.x], e1 = scene_.positions[t.y] - a,
                        e2 = scene_.positions[t.z] - a;
        const glm::vec3 d = f.centroid - a;
        const float d11 = glm::dot(e1, e1), d12 = glm::dot(e1, e2), d22 = glm::dot(e2, e2);
        const float det = d11 * d22 - d12 * d12;
        if (!(det > 0.0f)) {
            return glm::vec2(0.0f);
        }
        const float p1 = glm::dot(d, e1), p2 = glm::dot(d, e2);
        return glm::clamp(glm::vec2((d22 * p1 - d12 * p2) / det, (d11 * p2 - d12 * p1) / det), 0.0f, 1.0f);
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
            const glm::vec3 facing = facing_of(scene_, f.triangle, f.back);
            const Polygon whole = in_cells(scene_, f.triangle, grid, facing);
            const glm::ivec3 cell = grid.cell_at(f.order);
            Polygon piece = whole;
            for (int axis = 0; axis < 3; ++axis) {
                piece = clip(clip(piece, axis, float(cell[axis]), 1.0f), axis, float(cell[axis] + 1), -1.0f);
            }
            for (size_t k = 0; k < piece.count; ++k) {
                const glm::vec3 corner =
                    grid.world_from_cells.xform(piece.corners[k]) + kNudge_cells * grid.cell_m * facing;
                points.push_back(glm::mix(f.centroid, corner, 0.75f));
            }
        }
        return points;
    }

    /// A patch for each space that a cluster borders on.
    void add_spaces(const Cluster& c, const Draft& draft, const CellGrid& grid,
                    std::vector<Draft>& out) const {
        const std::vector<glm::vec3> asked = candidates(c, grid);
        std::vector<glm::vec3> points;
        std::vector<float> open_m;
        for (const glm::vec3& p : asked) {
            const float here_m = openness(rays_, p, draft.normal, grid.cell_m);
            if (here_m >= 0.0f) {
                points.push_back(p);
                open_m.push_back(here_m);
            }
        }
        std::vector<int> space(points.size(), -1);
        for (size_t i = 0; i < points.size(); ++i) {
            if (space[i] < 0) {
                space[i] = int(i);
                std::vector<glm::vec3> members = flood(points, i, draft.normal, grid.cell_m, space);
                Draft one = draft;
                one.openness_m = 0.0f;
                one.position = most_central(members);
                // As open as its most open point: the others may lie close to a wall.
                for (size_t j = i; j < points.size(); ++j) {
                    one.openness_m =
                        space[j] == int(i) ? std::max(one.openness_m, open_m[j]) : one.openness_m;
                }
                one.area_m2 = draft.area_m2 * float(members.size()) / float(asked.size());
                out.push_back(one);
            }
        }
    }

    /// All points that can be reached from `start` in sight of each other; marks them in `space`.
    std::vector<glm::vec3> flood(const std::vector<glm::vec3>& points, size_t start, const glm::vec3& normal,
                                 float cell_m, std::vector<int>& space) const {
        std::vector<size_t> reached{start};
        std::vector<glm::vec3> members;
        for (size_t next = 0; next < reached.size(); ++next) {
            members.push_back(points[reached[next]]);
            for (size_t j = 0; j < points.size(); ++j) {
                if (space[j] < 0 && !rays_.is_blocked(lifted(points[reached[next]], normal, cell_m),
                                                      lifted(points[j], normal, cell_m))) {
                    space[j] = int(start);
                    reached.push_back(j);
                }
            }
        }
        return members;
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

/// Where each cell's run of fragments begins, and the end.
std::vector<size_t> cell_starts(std::span<const Fragment> all) {
    std::vector<size_t> starts;
    for (size_t i = 0; i < all.size(); ++i) {
        if (i == 0 || all[i].order != all[i - 1].order || all[i].grid != all[i - 1].grid) {
            starts.push_back(i);
        }
    }
    starts.push_back(all.size());
    return starts;
}

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
void index_cells(Patches& patches, std::vector<CellGrid> grids) {
    size_t at = 0;
    for (size_t g = 0; g < grids.size(); ++g) {
        std::vector<uint64_t> orders;
        std::vector<uint32_t> first;
        for (; at < patches.size() && patches.grid[at] == g; ++at) {
            if (orders.empty() || orders.back() != patches.order[at]) {
                orders.push_back(patches.order[at]);
                first.push_back(uint32_t(at));
            }
        }
        first.push_back(uint32_t(at));
        patches.grids.push_back({grids[g], CellIndex(grids[g], orders), std::move(first)});
    }
}

} // namespace

Patches make_patches(const StillScene& scene, const RayScene& rays, std::vector<CellGrid> grids,
                     size_t probe_count) {
    const std::vector<Fragment> all = cut_all(scene, grids, probe_count);
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
    index_cells(patches, std::move(grids));
    return patches;
}

uint32_t Patches::find(const glm::vec3& point, const glm::vec3& facing) const noexcept {
    for (const Grid& g : grids) {
        const glm::vec3 at =
            g.cells.cells_from_world.xform(point - 2.0f * kNudge_cells * g.cells.cell_m * facing);
        if (!g.cells.contains(at)) {
            continue;
        }
        const uint32_t cell = g.index.find(glm::ivec3(glm::floor(at)));
        if (cell == CellIndex::kNone) {
            return kNoPatch;
        }
        uint32_t best = kNoPatch;
        float best_score = 0.5f; // a patch that faces elsewhere is not this surface's
        for (uint32_t p = g.first[cell]; p < g.first[cell + 1]; ++p) {
            const float apart = glm::distance(position[p], point) / g.cells.cell_m;
            const float score = 1.0f + glm::dot(normal[p], facing) - 0.3f * apart;
            if (glm::dot(normal[p], facing) > 0.3f && score > best_score) {
                best = p;
                best_score = score;
            }
        }
        return best;
    }
    return kNoPatch;
}

namespace {

bool sees(const RayScene& rays, const Patches& patches, const glm::vec3& point, const glm::vec3& facing,
          uint32_t patch) noexcept {
    const float cell_m = patches.grids[patches.grid[patch]].cells.cell_m;
    const float lift_m = 2.0f * kLift * cell_m + 0.12f * glm::distance(point, patches.position[patch]);
    return !rays.is_blocked(point + lift_m * facing,
                            patches.position[patch] + lift_m * patches.normal[patch]);
}

/// The nearest patches about a point that face its way, at most as many as there is room for.
/// @return how many
size_t nearest_around(const Patches& patches, const Patches::Grid& grid, const glm::vec3& point,
                      const glm::vec3& facing, std::span<std::pair<float, uint32_t>> out) noexcept {
    const glm::ivec3 home(glm::floor(grid.cells.cells_from_world.xform(point)));
    size_t count = 0;
    for (int i = 0; i < 27; ++i) {
        const uint32_t cell = grid.index.find(home + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
        if (cell == CellIndex::kNone) {
            continue;
        }
        for (uint32_t p = grid.first[cell]; p < grid.first[cell + 1]; ++p) {
            if (glm::dot(patches.normal[p], facing) < kSameFacing) {
                continue;
            }
            std::pair<float, uint32_t> found{glm::distance(patches.position[p], point), p};
            for (size_t k = 0; k < out.size(); ++k) { // insertion into a short sorted list
                if (k == count) {
                    out[count++] = found;
                    break;
                }
                if (found < out[k]) {
                    std::swap(found, out[k]);
                }
            }
        }
    }
    return count;
}

} // namespace

uint32_t Patches::find_seen(const RayScene& rays, const glm::vec3& point,
                            const glm::vec3& facing) const noexcept {
    const uint32_t own = find(point, facing);
    if (own == kNoPatch) {
        return own;
    }
    const Grid& g = grids[grid[own]];
    const uint32_t cell = g.index.find(g.cells.cell_at(order[own]));
    const bool alone = g.first[cell + 1] - g.first[cell] == 1;
    if (alone || sees(rays, *this, point, facing, own)) {
        return own;
    }
    std::array<std::pair<float, uint32_t>, 6> around;
    const size_t count = nearest_around(*this, g, point, facing, around);
    for (size_t i = 0; i < count; ++i) {
        if (around[i].second != own && sees(rays, *this, point, facing, around[i].second)) {
            return around[i].second;
        }
    }
    return kNoPatch;
}

} // namespace cl::radiosity
