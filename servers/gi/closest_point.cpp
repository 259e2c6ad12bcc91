#include "servers/gi/closest_point.h"

namespace cl::gi {

namespace {

/// x, y, z summed in that order.
float dot(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace

TriangleEdges::TriangleEdges(const glm::vec3 (&v)[3]) noexcept
    : v0(v[0]), e0(v[1] - v[0]), e1(v[2] - v[0]), a(dot(e0, e0)), b(dot(e0, e1)), c(dot(e1, e1)),
      determinant(a * c - b * b) {}

} // namespace cl::gi
