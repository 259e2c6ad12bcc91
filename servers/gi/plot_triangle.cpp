#include "servers/gi/plot_triangle.h"

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

bool fits_capture(size_t texels) {
    return texels == 1 || texels == size_t(kCaptureSize) * kCaptureSize;
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
    if (!s.material || !fits_capture(s.material->albedo.size()) ||
        !fits_capture(s.material->emission.size())) {
        return invalid(number, "expected a material of 1 or 16384 texels, found none or other sizes");
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

/// Triangles of a surface that one worker looks at.
struct Part {
    uint32_t surface;
    size_t begin, end; ///< corners
    std::vector<PlotTriangle> found;
};

constexpr size_t kPartCorners = 3 * 4096;

float longest_side(const PlotTriangle& t) {
    const glm::vec3 size =
        glm::max(glm::max(t.v[0], t.v[1]), t.v[2]) - glm::min(glm::min(t.v[0], t.v[1]), t.v[2]);
    return std::max(size.x, std::max(size.y, size.z));
}

void collect(const PlotSurface& s, const Boxes<float>& box, float leaf_m, Part& part) {
    for (size_t i = part.begin; i < part.end; i += 3) {
        PlotTriangle t{};
        t.surface = part.surface;
        bool usable = true;
        for (size_t k = 0; k < 3; ++k) {
            t.vertex[k] = s.indices.empty() ? uint32_t(i + k) : s.indices[i + k];
            t.v[k] = s.local_from_mesh.xform(s.positions[t.vertex[k]]);
            usable = usable && is_usable(t.v[k]);
        }
        if (!usable || separated(box, t.v)) {
            continue;
        }
        set_plane(t);
        t.is_uniform = is_uniform(s, t.vertex);
        if (longest_side(t) > leaf_m) { // smaller ones cover no middle that would pay for it
            t.center_test = make_center_test(t.v, t.axis);
        }
        part.found.push_back(t);
    }
}

} // namespace

Expected<std::vector<PlotTriangle>> collect_triangles(std::span<const PlotSurface> surfaces, const AABB& box,
                                                      float leaf_m) {
    const glm::vec3 half = box.size * 0.5f;
    const glm::vec3 center = box.position + half;
    const Boxes<float> boxes{{center.x, center.y, center.z}, {half.x, half.y, half.z}};
    std::vector<Part> parts;
    size_t corners = 0;
    for (size_t i = 0; i < surfaces.size(); ++i) {
        if (Status s = check_surface(surfaces[i], i); !s) {
            return s.error();
        }
        const size_t count = corner_count(surfaces[i]) / 3 * 3;
        corners += count;
        if (corners / 3 > kMaxTriangles) {
            return Error{ErrorCode::OutOfMemory,
                         fmt::format("bake: expected at most {} triangles, found more", kMaxTriangles)};
        }
        for (size_t begin = 0; begin < count; begin += kPartCorners) {
            parts.push_back({uint32_t(i), begin, std::min(begin + kPartCorners, count), {}});
        }
    }
    parallel_for(parts.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            collect(surfaces[parts[i].surface], boxes, leaf_m, parts[i]);
        }
    });
    std::vector<PlotTriangle> triangles;
    for (const Part& part : parts) {
        triangles.insert(triangles.end(), part.found.begin(), part.found.end());
    }
    return triangles;
}

} // namespace cl::gi
