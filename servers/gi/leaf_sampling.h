#pragma once

#include "servers/gi/plot_triangle.h"

#include <glm/vec3.hpp>

namespace cl::gi {

/// What the triangles that touch a leaf add up to. Colours are sRGB-encoded numbers.
struct LeafSum {
    glm::vec3 albedo{0.0f};
    glm::vec3 emission{0.0f};
    glm::vec3 normal{0.0f};
    float alpha = 0.0f; ///< sum of the covered fractions: the weight of the colours
};

/// A leaf's box: a cube.
struct LeafBox {
    glm::vec3 position{0.0f}; ///< least corner, probe-local [m]
    float size_m = 0.0f;
};

/// Samples a triangle on the 4 x 4 columns of a leaf that it touches and adds the result (spec gi-bake
/// section 5). float32 throughout, in the specification's order. @param surface  the triangle's own.
void plot_leaf(const LeafBox& leaf, const PlotTriangle& triangle, const PlotSurface& surface,
               LeafSum& sum) noexcept;

} // namespace cl::gi
