#pragma once

#include "servers/gi/leaf_columns.h"
#include "servers/gi/plot_triangle.h"

#include <glm/vec3.hpp>

#include <array>

namespace cl::gi {

/// What the triangles that touch a leaf add up to. Colours are sRGB-encoded numbers.
struct LeafSum {
    glm::vec3 albedo{0.0f};
    glm::vec3 emission{0.0f};
    glm::vec3 normal{0.0f};
    float alpha = 0.0f; ///< sum of the covered fractions: the weight of the colours
};

/// Samples triangles on the 4 x 4 columns of leaves (spec gi-bake section 5), float32 throughout, in the
/// specification's order. One a worker: it remembers what the last few uniform triangles add up to.
class LeafSampler {
public:
    /// Adds what a triangle shows in a leaf that it touches. @param surface  the triangle's own.
    void plot(const LeafBox& leaf, const PlotTriangle& triangle, const CenterTest& center_test,
              const PlotSurface& surface, LeafSum& sum) noexcept;

private:
    /// Of n equal samples, added one after the other as float32 rounds that; n = 0 to 16.
    struct UniformSums {
        const PlotTriangle* triangle = nullptr;
        std::array<LeafSum, 17> of;
    };
    template <int axis>
    LeafSum sum_of(const LeafBox& leaf, const PlotTriangle& triangle, const CenterTest& center_test,
                   const PlotSurface& surface) noexcept;
    const LeafSum& uniform_sum(const PlotTriangle& triangle, const PlotSurface& surface, int count) noexcept;

    std::array<UniformSums, 8> known_;
};

} // namespace cl::gi
