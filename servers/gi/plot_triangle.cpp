#include "servers/gi/plot_triangle.h"

#include "servers/gi/brick_filter.h"
#include "servers/gi/small_triangles.h"
#include "servers/gi/triangle_box.h"

#include "core/threads.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gi {

namespace {

constexpr size_t kMaxTriangles = size_t(1) << 31;
constexpr float kMaxCoordinate_m = 1e12f;

size_t corner_count(const PlotSurface& s) {
    return s.indices.empty() ? s.positions.size() : s.indices.size();
}

Error invalid(size_t surface, const std::string& message) {
    return {ErrorCode::InvalidArgument, fmt::format("plot surface {}: {}", surface, message)};
}

Status check_surface(const PlotSurface& s, size_t number) {
    const size_t n = s.positions.size();
    if (!s.normals.empty() && s.normals.size() != n) {
        return invalid(number, fmt::format("expected {} normals, found {}", n, s.normals.size()));
    }
    if (!s.uvs.empty() && s.uvs.size() != n) {
        return invalid(number, fmt::format("expected {} uvs, found {}", n, s.uvs.size()));
    }
    for (const uint32_t index : s.indices) {
        if (index >= n) {
            return invalid(number, fmt::format("expected indices below {}, found {}", n, index));
        }
    }
    if (!s.material) {
        return invalid(number, "expected a material, found none");
    }
    return {};
}

bool is_usable(const glm::vec3& p) {
    return std::abs(p.x) <= kMaxCoordinate_m && std::abs(p.y) <= kMaxCoordinate_m &&
           std::abs(p.z) <= kMaxCoordinate_m; // false for NaN, too
}

uint8_t dominant_axis(const glm::vec3& n) {
    uint8_t axis = 0;
    for (uint8_t i = 1; i < 3; ++i) {
        if (std::abs(n[i]) > std::abs(n[axis])) {
            axis = i;
        }
    }
    return axis;
}

/// A unit axis or zero: values that interpolating and normalising give back exactly.
bool is_fixed_by_interpolation(const glm::vec3& n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const float largest = std::max(std::abs(n.x), std::max(std::abs(n.y), std::abs(n.z)));
    return sum == 0.0f || (sum == 1.0f && largest == 1.0f);
}

bool is_uniform(const PlotSurface& s, const uint32_t (&vertex)[3]) {
    if (s.material->albedo.size() != 1 || s.material->emission.size() != 1) {
        return false;
    }
    if (s.normals.empty()) {
        return true;
    }
    const glm::vec3& n = s.normals[vertex[0]];
    return s.normals[vertex[1]] == n && s.normals[vertex[2]] == n && is_fixed_by_interpolation(n);
}

void set_plane(PlotTriangle& t) {
    const glm::vec3 n = glm::cross(t.v[0] - t.v[2], t.v[0] - t.v[1]);
    const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    t.plane_normal = length > 0.0f ? n / length : glm::vec3(0.0f);
    t.plane_d = t.plane_normal.x * t.v[0].x + t.plane_normal.y * t.v[0].y + t.plane_normal.z * t.v[0].z;
    t.axis = dominant_axis(t.plane_normal);
}

/// Triangles of a surface that one worker looks at, and what it finds.
struct Part {
    uint32_t surface;
    size_t begin, end; ///< corners
    uint32_t first_triangle;
    std::vector<BroadTriangle> broad;
    std::vector<LeafPlot> small;
};

constexpr size_t kPartCorners = 3 * 4096;

Expected<std::vector<Part>> make_parts(std::span<const PlotSurface> surfaces) {
    std::vector<Part> parts;
    size_t corners = 0;
    for (size_t i = 0; i < surfaces.size(); ++i) {
        if (Status s = check_surface(surfaces[i], i); !s) {
            return s.error();
        }
        const size_t count = corner_count(surfaces[i]) / 3 * 3;
        if ((corners + count) / 3 > kMaxTriangles) {
            return Error{ErrorCode::OutOfMemory,
                         fmt::format("bake: expected at most {} triangles, found more", kMaxTriangles)};
        }
        for (size_t begin = 0; begin < count; begin += kPartCorners) {
            const size_t end = std::min(begin + kPartCorners, count);
            parts.push_back({uint32_t(i), begin, end, uint32_t((corners + begin) / 3), {}, {}});
        }
        corners += count;
    }
    return parts;
}

/// Turns corners into triangles and finds what these touch.
class Collector {
public:
    Collector(const Grid& grid, const BrickFilter* filter, PlotTriangle* triangles)
        : small_(grid), filter_(filter), triangles_(triangles) {
        const glm::vec3 half = grid.box.size * 0.5f;
        const glm::vec3 center = grid.box.position + half;
        box_ = {{center.x, center.y, center.z}, {half.x, half.y, half.z}};
    }

    void collect(const PlotSurface& s, Part& part) const {
        for (size_t corner = part.begin; corner < part.end; corner += 3) {
            const uint32_t number = part.first_triangle + uint32_t((corner - part.begin) / 3);
            PlotTriangle& t = triangles_[number];
            if (!set_triangle(s, corner, t)) {
                continue;
            }
            t.surface = part.surface;
            SmallTriangles::Leaves leaves;
            if (small_.find_leaves(t.v, leaves)) {
                for (const uint32_t leaf : leaves) {
                    part.small.push_back({leaf, number});
                }
            } else {
                part.broad.push_back({number, make_center_test(t.v, t.axis)});
            }
        }
    }

private:
    /// @return false for a triangle that is left out.
    bool set_triangle(const PlotSurface& s, size_t corner, PlotTriangle& t) const {
        for (size_t k = 0; k < 3; ++k) {
            t.vertex[k] = s.indices.empty() ? uint32_t(corner + k) : s.indices[corner + k];
            t.v[k] = s.local_from_mesh.xform(s.positions[t.vertex[k]]);
            if (!is_usable(t.v[k])) {
                return false;
            }
        }
        if ((!lies_within(box_, t.v) && separated(box_, t.v)) || (filter_ && !filter_->may_touch(t.v))) {
            return false;
        }
        set_plane(t);
        t.is_uniform = is_uniform(s, t.vertex);
        return true;
    }

    Boxes<float> box_;
    SmallTriangles small_;
    const BrickFilter* filter_;
    PlotTriangle* triangles_;
};

} // namespace

Expected<PlotTriangles> collect_triangles(std::span<const PlotSurface> surfaces, const Grid& grid,
                                          const BrickFilter* filter) {
    Expected<std::vector<Part>> parts = make_parts(surfaces);
    if (!parts) {
        return parts.error();
    }
    PlotTriangles all;
    const size_t count =
        parts->empty() ? 0 : parts->back().first_triangle + (parts->back().end - parts->back().begin) / 3;
    // Not set to 0: a third of the time would go into pages that the triangles below touch anyway.
    all.by_number = std::make_unique_for_overwrite<PlotTriangle[]>(count);
    const Collector collector(grid, filter, all.by_number.get());
    parallel_for_each(parts->size(), [&](size_t i) {
        Part& part = (*parts)[i];
        collector.collect(surfaces[part.surface], part);
    });
    std::vector<std::span<const LeafPlot>> plots;
    for (const Part& part : *parts) {
        all.broad.insert(all.broad.end(), part.broad.begin(), part.broad.end());
        plots.emplace_back(part.small);
    }
    all.small = LeafPlots(plots, grid.levels);
    return all;
}

} // namespace cl::gi
