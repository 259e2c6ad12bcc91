#include "servers/gi/leaf_sampling.h"

#include "servers/gi/closest_point.h"

#include <algorithm>
#include <bit>

namespace cl::gi {

namespace {

/// Texture coordinates and normals of a triangle's vertices, or of four of its points.
struct Attributes {
    float4 u{}, v{};
    Vec3x4 normal{};
};

Attributes operator*(const Attributes& a, float4 b) {
    return {a.u * b, a.v * b, a.normal * b};
}
Attributes operator+(const Attributes& a, const Attributes& b) {
    return {a.u + b.u, a.v + b.v, a.normal + b.normal};
}
Attributes chosen(int4 mask, const Attributes& a, const Attributes& b) {
    return {select(mask, a.u, b.u), select(mask, a.v, b.v), select(mask, a.normal, b.normal)};
}

Attributes attributes_of_vertex(const PlotSurface& s, uint32_t vertex) {
    const glm::vec2 uv = s.uvs.empty() ? glm::vec2(0.0f) : s.uvs[vertex];
    return {splat(uv.x), splat(uv.y), splat(s.normals.empty() ? glm::vec3(0.0f) : s.normals[vertex])};
}

Vec3x4 normalized_or_zero(const Vec3x4& v) {
    const float4 length = square_root(dot(v, v));
    const int4 has_length = length > float4{};
    return {{select(has_length, v[0] / length, float4{}), select(has_length, v[1] / length, float4{}),
             select(has_length, v[2] / length, float4{})}};
}

/// Texels along one axis: repeat wrap, no filter (step 6). NaN and infinity, which half UVs can hold, give 0.
int4 texels_along(float4 u) {
    const int4 has_fraction = magnitude(u) < splat(8388608.0f); // 2^23: beyond, all numbers are whole
    const float4 finite = select(has_fraction, u, float4{});
    float4 fraction = finite - to_float(to_int(finite)); // exact, as fmod(u, 1) is
    fraction = select(fraction < float4{}, fraction + 1.0f, fraction);
    return to_int(lesser(fraction * float(kCaptureSize), splat(float(kCaptureSize - 1))));
}

/// What a triangle shows at up to four of its points.
struct Samples {
    int4 texel; ///< of maps of kCaptureSize^2 texels
    Vec3x4 normal;
};

/// A triangle while one leaf is sampled.
class SampledTriangle {
public:
    SampledTriangle(const PlotTriangle& t, const PlotSurface& s)
        : t_(t), s_(s),
          edges_(t.v), vertices_{attributes_of_vertex(s, t.vertex[0]), attributes_of_vertex(s, t.vertex[1]),
                                 attributes_of_vertex(s, t.vertex[2])} {}

    /// At the points nearest to p (steps 4 to 6); normals may be zero.
    [[nodiscard]] Samples near(const Vec3x4& p) const { return at(closest_points_of_triangle(edges_, p)); }

    /// At points of the triangle.
    [[nodiscard]] Samples at(const Vec3x4& q) const {
        const Attributes found = attributes_at(q);
        return {texels_along(found.v) * kCaptureSize + texels_along(found.u), found.normal};
    }

    /// A zero normal falls back to the plane's.
    [[nodiscard]] Samples with_normal(Samples samples) const {
        const Vec3x4& n = samples.normal;
        const int4 is_zero = (n[0] == float4{}) & (n[1] == float4{}) & (n[2] == float4{});
        samples.normal = select(is_zero, splat(t_.plane_normal), n);
        return samples;
    }

    /// Adds the first `count` samples, one after the other.
    void add(const Samples& samples, int count, LeafSum& sum) const {
        for (int i = 0; i < count; ++i) {
            sum.albedo += s_.material->albedo[size_t(samples.texel[i])];
            sum.emission += s_.material->emission[size_t(samples.texel[i])];
            sum.normal += lane(samples.normal, i);
            sum.alpha += 1.0f;
        }
    }

private:
    /// Step 5 of section 5. Also for a q of NaN: its triangle is degenerate, so the determinant is 0.
    [[nodiscard]] Attributes attributes_at(const Vec3x4& q) const {
        const TriangleEdges& f = edges_;
        Attributes at = vertices_[0];
        if (f.determinant != 0.0f) {
            const Vec3x4 e2 = q - splat(f.v0);
            const float4 d20 = dot(e2, splat(f.e0));
            const float4 d21 = dot(e2, splat(f.e1));
            const float4 v = (f.c * d20 - f.b * d21) / f.determinant;
            const float4 w = (f.a * d21 - f.b * d20) / f.determinant;
            const float4 u = 1.0f - v - w;
            at = vertices_[0] * u + vertices_[1] * v + vertices_[2] * w;
            at.normal = normalized_or_zero(at.normal);
        }
        constexpr float kSameVertex_m2 = 1e-10f;
        for (int k = 3; k-- > 0;) { // the first that is near has the last word
            const Vec3x4 to_vertex = splat(t_.v[k]) - q;
            const int4 is_near = dot(to_vertex, to_vertex) < splat(kSameVertex_m2);
            if (lane_bits(is_near) != 0u) {
                at = chosen(is_near, vertices_[k], at);
            }
        }
        return at;
    }

    const PlotTriangle& t_;
    const PlotSurface& s_;
    TriangleEdges edges_;
    Attributes vertices_[3];
};

/// Sums the samples of columns, four at a time.
template <int axis>
LeafSum sum_columns(const LeafColumns<axis>& leaf, const PlotTriangle& t, const PlotSurface& s,
                    uint32_t columns) {
    const SampledTriangle triangle(t, s);
    LeafSum sum;
    while (columns != 0u) {
        const ColumnGroup group(columns);
        const Samples samples = triangle.near(leaf.points_on_plane(group));
        triangle.add(triangle.with_normal(samples), group.count(), sum);
    }
    return sum;
}

} // namespace

const LeafSum& LeafSampler::uniform_sum(const PlotTriangle& t, const PlotSurface& s, int count) noexcept {
    UniformSums& sums = known_[size_t(t.vertex[0] + t.vertex[1] + t.vertex[2]) % known_.size()];
    if (sums.triangle != &t) {
        const SampledTriangle triangle(t, s);
        const Samples samples = triangle.with_normal(triangle.at(splat(t.v[0])));
        sums.triangle = &t;
        for (size_t n = 1; n < sums.of.size(); ++n) {
            sums.of[n] = sums.of[n - 1];
            triangle.add(samples, 1, sums.of[n]);
        }
    }
    return sums.of[size_t(count)];
}

template <int axis>
LeafSum LeafSampler::sum_of(const LeafBox& leaf, const PlotTriangle& t, const CenterTest& center_test,
                            const PlotSurface& s) noexcept {
    const LeafColumns<axis> columns(leaf, t);
    const uint32_t touched = columns.touched(center_test);
    if (touched == 0u) { // numerically missed by every column: one sample, whose zero normal stays zero
        const SampledTriangle triangle(t, s);
        LeafSum sum;
        triangle.add(triangle.near(splat(leaf.position + leaf.size_m * 0.5f)), 1, sum);
        return sum;
    }
    return t.is_uniform ? uniform_sum(t, s, std::popcount(touched)) : sum_columns(columns, t, s, touched);
}

void LeafSampler::plot(const LeafBox& leaf, const PlotTriangle& t, const CenterTest& center_test,
                       const PlotSurface& s, LeafSum& sum) noexcept {
    constexpr float kSampleWeight = 1.0f / float(kColumns * kColumns);
    const LeafSum own = t.axis == 0   ? sum_of<0>(leaf, t, center_test, s)
                        : t.axis == 1 ? sum_of<1>(leaf, t, center_test, s)
                                      : sum_of<2>(leaf, t, center_test, s);
    sum.albedo += own.albedo * kSampleWeight;
    sum.emission += own.emission * kSampleWeight;
    sum.normal += own.normal * kSampleWeight;
    sum.alpha += own.alpha * kSampleWeight;
}

} // namespace cl::gi
