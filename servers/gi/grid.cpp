// Grid sizes of a GI probe (spec gi-probe-data sections 3 and 4).
#include "servers/gi/probe_data.h"

#include <fmt/format.h>

#include <cmath>

namespace cl::gi {

namespace {

/// Beyond these the box arithmetic in float32 loses its cells (denormals) or overflows (products of
/// coordinates).
constexpr float kMinExtent_m = 1e-6f;
constexpr float kMaxExtent_m = 1e9f;

int levels_of(int subdivision) {
    switch (subdivision) {
    case 64:
        return 7;
    case 128:
        return 8;
    case 256:
        return 9;
    case 512:
        return 10;
    default:
        return 0;
    }
}

int longest_axis(const glm::vec3& size) {
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (size[i] > size[axis]) {
            axis = i;
        }
    }
    return axis;
}

/// Halves the longest size while it still covers `size_m`; 0 where the axis is thinner than half a cell.
int cells_along(float size_m, float longest_m, int subdivision) {
    int cells = subdivision;
    for (float covered_m = longest_m; cells > 0 && covered_m / 2.0f >= size_m; covered_m /= 2.0f) {
        cells >>= 1;
    }
    return cells;
}

/// scale(N) * inverse(translate(position) * scale(longest)) in the float32 steps that Godot takes, so that
/// the last bit is Godot's too: an inverse by cofactors over the determinant.
Transform make_cells_from_local(const glm::vec3& position, float longest_m, int subdivision) {
    const float cofactor = longest_m * longest_m;
    const float inverse_scale = cofactor * (1.0f / (longest_m * cofactor));
    const float n = float(subdivision);
    Transform xform;
    xform.basis = glm::mat3(inverse_scale * n);
    xform.origin = (inverse_scale * -position) * n;
    return xform;
}

/// Whether `saved`, which is finite, is `exact` or what six significant digits leave of it.
bool agrees(float saved, float exact) {
    constexpr float kHalfUnit = 5.1e-6f; // of the sixth digit at worst, and the rounding of what was read
    return std::abs(saved - exact) <= kHalfUnit * std::abs(saved);
}

bool agrees(const glm::vec3& saved, const glm::vec3& exact) {
    return agrees(saved.x, exact.x) && agrees(saved.y, exact.y) && agrees(saved.z, exact.z);
}

bool agrees(const Transform& saved, const Transform& exact) {
    return agrees(saved.basis[0], exact.basis[0]) && agrees(saved.basis[1], exact.basis[1]) &&
           agrees(saved.basis[2], exact.basis[2]) && agrees(saved.origin, exact.origin);
}

} // namespace

Expected<Grid> compute_grid(const glm::vec3& extents_m, int subdivision) {
    const int levels = levels_of(subdivision);
    if (levels == 0) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("subdivision: expected 64, 128, 256 or 512, found {}", subdivision)};
    }
    for (int i = 0; i < 3; ++i) {
        if (!(extents_m[i] >= kMinExtent_m && extents_m[i] <= kMaxExtent_m)) {
            return Error{
                ErrorCode::InvalidArgument,
                fmt::format("extents: expected {} in 1e-6 to 1e9, found {}", "xyz"[i], extents_m[i])};
        }
    }
    const glm::vec3 size = 2.0f * extents_m;
    const float longest_m = size[longest_axis(size)];
    Grid grid;
    grid.levels = levels;
    for (int i = 0; i < 3; ++i) {
        grid.dims[i] = cells_along(size[i], longest_m, subdivision);
        if (grid.dims[i] == 0) {
            return Error{ErrorCode::InvalidArgument,
                         fmt::format("extents: expected {} above 1/{} of the longest extent {}, found {}",
                                     "xyz"[i], 2 * subdivision, 0.5f * longest_m, extents_m[i])};
        }
    }
    grid.cell_size_m = longest_m / float(subdivision);
    grid.box = {-extents_m, size};
    grid.cubic_box = {-extents_m, glm::vec3(longest_m)};
    grid.cells_from_local = make_cells_from_local(-extents_m, longest_m, subdivision);
    return grid;
}

GridScale grid_scale(const ProbeData& data, int levels) noexcept {
    const GridScale saved{data.cell_size_m, data.cells_from_local};
    const int subdivision = 1 << (levels - 1);
    const float longest_m = data.bounds.size[longest_axis(data.bounds.size)];
    const GridScale computed{longest_m / float(subdivision),
                             make_cells_from_local(data.bounds.position, longest_m, subdivision)};
    const bool is_same_grid = agrees(saved.cell_size_m, computed.cell_size_m) &&
                              agrees(saved.cells_from_local, computed.cells_from_local);
    return is_same_grid ? computed : saved;
}

} // namespace cl::gi
