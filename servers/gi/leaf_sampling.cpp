#include "servers/gi/leaf_sampling.h"

#include "servers/gi/closest_point.h"
#include "servers/gi/triangle_box.h"

#include <algorithm>
#include <bitset>
#include <cmath>

namespace cl::gi {

namespace {

constexpr int kColumns = 4; ///< samples along each tangent axis

/// x, y, z summed in that order, as the separating-axis test does.
float dot(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

glm::vec3 normalized_or_zero(const glm::vec3& v) {
    const float length = std::sqrt(dot(v, v));
    return length > 0.0f ? v / length : glm::vec3(0.0f);
}

struct Sample {
    glm::vec3 albedo{0.0f};
    glm::vec3 emission{0.0f};
    glm::vec3 normal{0.0f};
};

/// Texture coordinates and normal of a point of the triangle.
struct Attributes {
    glm::vec2 uv{0.0f};
    glm::vec3 normal{0.0f};
};

Attributes attributes_of_vertex(const PlotSurface& s, uint32_t vertex) {
    return {s.uvs.empty() ? glm::vec2(0.0f) : s.uvs[vertex],
            s.normals.empty() ? glm::vec3(0.0f) : s.normals[vertex]};
}

/// Step 5 of section 5. Also for a q of NaN: its triangle is degenerate, so the determinant is 0.
Attributes attributes_at(const PlotTriangle& t, const PlotSurface& s, const glm::vec3& q) {
    constexpr float kSameVertex_m2 = 1e-10f;
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 to_vertex = t.v[k] - q;
        if (dot(to_vertex, to_vertex) < kSameVertex_m2) {
            return attributes_of_vertex(s, t.vertex[k]);
        }
    }
    const glm::vec3 e0 = t.v[1] - t.v[0];
    const glm::vec3 e1 = t.v[2] - t.v[0];
    const glm::vec3 e2 = q - t.v[0];
    const float d00 = dot(e0, e0);
    const float d01 = dot(e0, e1);
    const float d11 = dot(e1, e1);
    const float d20 = dot(e2, e0);
    const float d21 = dot(e2, e1);
    const float determinant = d00 * d11 - d01 * d01;
    const Attributes a = attributes_of_vertex(s, t.vertex[0]);
    if (determinant == 0.0f) {
        return a;
    }
    const Attributes b = attributes_of_vertex(s, t.vertex[1]);
    const Attributes c = attributes_of_vertex(s, t.vertex[2]);
    const float v = (d11 * d20 - d01 * d21) / determinant;
    const float w = (d00 * d21 - d01 * d20) / determinant;
    const float u = 1.0f - v - w;
    return {a.uv * u + b.uv * v + c.uv * w, normalized_or_zero(a.normal * u + b.normal * v + c.normal * w)};
}

/// Texel along one axis: repeat wrap, no filter (step 6). NaN and infinity, which half UVs can hold, give 0.
size_t texel_along(float u) {
    float fraction = u - std::trunc(u); // exact, as fmod(u, 1) is, which takes ten times as long
    if (fraction < 0.0f) {
        fraction += 1.0f;
    }
    return fraction > 0.0f ? size_t(std::min(int(fraction * float(kCaptureSize)), kCaptureSize - 1)) : 0;
}

const glm::vec3& texel_of(const std::vector<glm::vec3>& map, const glm::vec2& uv) {
    return map.size() == 1 ? map[0] : map[texel_along(uv.y) * size_t(kCaptureSize) + texel_along(uv.x)];
}

Sample sample_at(const PlotTriangle& t, const PlotSurface& s, const glm::vec3& q) {
    const Attributes at = attributes_at(t, s, q);
    return {texel_of(s.material->albedo, at.uv), texel_of(s.material->emission, at.uv), at.normal};
}

/// Columns of a leaf along a triangle's main axis, four at a time.
class Columns {
public:
    Columns(const LeafBox& leaf, const PlotTriangle& t)
        : leaf_(leaf), t_(t), u_((t.axis + 1) % 3), w_((t.axis + 2) % 3),
          step_m_(leaf.size_m / float(kColumns)) {}

    /// Bit (4 i + j) is set where the triangle touches the column at steps i along u and j along w.
    [[nodiscard]] uint32_t touched() const {
        if (all_are_sure()) {
            return 0xFFFFu;
        }
        uint32_t columns = 0;
        for (int i = 0; i < kColumns; ++i) {
            const Boxes<float4> boxes = at(splat(float(i)), float4{0.0f, 1.0f, 2.0f, 3.0f});
            columns |= overlapping_boxes(boxes, t_.v, t_.center_test, 0.5f * step_m_) << (kColumns * i);
        }
        return columns;
    }

private:
    /// True if the cheap test settles the four columns at the corners: what it asks of their middles then
    /// holds between them.
    [[nodiscard]] bool all_are_sure() const {
        if (0.5f * step_m_ < t_.center_test.least_half_m) {
            return false;
        }
        const Boxes<float4> corners = at(float4{0.0f, 0.0f, 3.0f, 3.0f}, float4{0.0f, 3.0f, 0.0f, 3.0f});
        return lane_bits(surely_touches(t_.center_test, corners)) == 15u &&
               lane_bits(separated_by_box_axis(corners, t_.v)) == 0u;
    }

    [[nodiscard]] Boxes<float4> at(float4 i, float4 j) const {
        Boxes<float4> boxes;
        place(boxes, t_.axis, splat(leaf_.position[t_.axis]), leaf_.size_m);
        place(boxes, u_, leaf_.position[u_] + i * step_m_, step_m_);
        place(boxes, w_, leaf_.position[w_] + j * step_m_, step_m_);
        return boxes;
    }
    static void place(Boxes<float4>& boxes, int axis, float4 from, float size) {
        const float4 to = from + size;
        boxes.half[axis] = (to - from) * 0.5f;
        boxes.center[axis] = from + boxes.half[axis];
    }

    const LeafBox& leaf_;
    const PlotTriangle& t_;
    int u_, w_;
    float step_m_;
};

/// Where the column's axis meets the triangle, or comes nearest to it (steps 2 to 4).
glm::vec3 point_in_column(const LeafBox& leaf, const PlotTriangle& t, int i, int j) {
    const int axis = t.axis;
    const int u = (axis + 1) % 3;
    const int w = (axis + 2) % 3;
    const float step = leaf.size_m / float(kColumns);
    glm::vec3 a = leaf.position; // spans one cell below the leaf to its top
    a[u] = leaf.position[u] + float(i) * step + step * 0.5f;
    a[w] = leaf.position[w] + float(j) * step + step * 0.5f;
    a[axis] = leaf.position[axis] - leaf.size_m;
    glm::vec3 b = a;
    b[axis] = a[axis] + 2.0f * leaf.size_m;
    if (dot(t.plane_normal, a - b) < 0.0f) {
        std::swap(a, b);
    }
    constexpr float kEpsilon = 1e-5f;
    const glm::vec3 along = a - b;
    const float denominator = dot(t.plane_normal, along);
    const float distance_a = dot(t.plane_normal, a) - t.plane_d;
    if (std::abs(denominator) >= kEpsilon) {
        const float s = distance_a / denominator;
        if (s >= -kEpsilon && s <= 1.0f + kEpsilon) {
            return closest_point_of_triangle(t.v, a - s * along);
        }
    }
    const float distance_b = dot(t.plane_normal, b) - t.plane_d;
    const bool a_is_nearer = std::abs(distance_a) < std::abs(distance_b);
    const glm::vec3 projected =
        a_is_nearer ? a - t.plane_normal * distance_a : b - t.plane_normal * distance_b;
    return closest_point_of_triangle(t.v, projected);
}

void add(LeafSum& sum, const Sample& sample) {
    sum.albedo += sample.albedo;
    sum.emission += sample.emission;
    sum.normal += sample.normal;
}

/// A zero normal falls back to the plane's.
Sample with_normal(Sample sample, const PlotTriangle& t) {
    sample.normal = sample.normal == glm::vec3(0.0f) ? t.plane_normal : sample.normal;
    return sample;
}

/// Sums the samples of all touched columns.
LeafSum sum_columns(const LeafBox& leaf, const PlotTriangle& t, const PlotSurface& s, uint32_t columns) {
    LeafSum sum;
    for (int bit = 0; bit < kColumns * kColumns; ++bit) {
        if ((columns >> bit) & 1u) {
            const glm::vec3 q = point_in_column(leaf, t, bit / kColumns, bit % kColumns);
            add(sum, with_normal(sample_at(t, s, q), t));
            sum.alpha += 1.0f;
        }
    }
    return sum;
}

} // namespace

const LeafSum& LeafSampler::uniform_sum(const PlotTriangle& t, const PlotSurface& s, int count) noexcept {
    UniformSums& sums = known_[size_t(t.vertex[0] + t.vertex[1] + t.vertex[2]) % known_.size()];
    if (sums.triangle != &t) {
        const Sample sample = with_normal(sample_at(t, s, t.v[0]), t);
        sums.triangle = &t;
        for (size_t n = 1; n < sums.of.size(); ++n) {
            sums.of[n] = sums.of[n - 1];
            add(sums.of[n], sample);
            sums.of[n].alpha += 1.0f;
        }
    }
    return sums.of[size_t(count)];
}

void LeafSampler::plot(const LeafBox& leaf, const PlotTriangle& triangle, const PlotSurface& surface,
                       LeafSum& sum) noexcept {
    constexpr float kSampleWeight = 1.0f / float(kColumns * kColumns);
    const uint32_t columns = Columns(leaf, triangle).touched();
    LeafSum own = triangle.is_uniform ? uniform_sum(triangle, surface, int(std::bitset<16>(columns).count()))
                                      : sum_columns(leaf, triangle, surface, columns);
    if (columns == 0) { // numerically missed by every column: one sample, whose zero normal stays zero
        const glm::vec3 center = leaf.position + leaf.size_m * 0.5f;
        add(own, sample_at(triangle, surface, closest_point_of_triangle(triangle.v, center)));
        own.alpha = 1.0f;
    }
    sum.albedo += own.albedo * kSampleWeight;
    sum.emission += own.emission * kSampleWeight;
    sum.normal += own.normal * kSampleWeight;
    sum.alpha += own.alpha * kSampleWeight;
}

} // namespace cl::gi
