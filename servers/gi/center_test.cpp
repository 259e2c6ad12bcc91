#include "servers/gi/center_test.h"

#include <algorithm>
#include <cmath>

namespace cl::gi {

CenterTest make_center_test(const glm::vec3 (&v)[3], int axis) noexcept {
    // Coordinates and their products err by less than 1e-6 of the largest; boxes that are settled have a
    // hundred times that to spare.
    constexpr double kLeastHalf = 1e-4;
    constexpr double kSliver = 0.1; // of the longest edge squared: below, the plane's normal is unsure
    CenterTest test;
    test.axis = axis;
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    test.is_flat = v[0][axis] == v[1][axis] && v[1][axis] == v[2][axis];
    const auto cross = [&](int a, int b) { // of the edges from v[0], in double: float32 products are exact
        const double a1 = double(v[1][a]) - double(v[0][a]), b2 = double(v[2][b]) - double(v[0][b]);
        const double b1 = double(v[1][b]) - double(v[0][b]), a2 = double(v[2][a]) - double(v[0][a]);
        return a1 * b2 - b1 * a2;
    };
    const double n_axis = cross(u, w), n_u = cross(w, axis), n_w = cross(axis, u);
    double longest2 = 0.0, largest = 0.0;
    const double turn = n_axis < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 &a = v[k], &b = v[(k + 1) % 3];
        const double du = double(b[u]) - double(a[u]), dw = double(b[w]) - double(a[w]);
        const double dn = double(b[axis]) - double(a[axis]);
        const double length = std::sqrt(du * du + dw * dw);
        if (!(length > 0.0)) {
            return test;
        }
        test.edge[k][0] = float(-dw / length * turn);
        test.edge[k][1] = float(du / length * turn);
        test.edge[k][2] = float((dw * double(a[u]) - du * double(a[w])) / length * turn);
        longest2 = std::max(longest2, du * du + dw * dw + dn * dn);
        for (int i = 0; i < 3; ++i) {
            largest = std::max(largest, std::abs(double(a[i])));
        }
    }
    if (!(std::abs(n_axis) > kSliver * longest2)) {
        return test;
    }
    test.plane[0] = float(-n_u / n_axis);
    test.plane[1] = float(-n_w / n_axis);
    test.plane[2] = float((n_u * double(v[0][u]) + n_w * double(v[0][w])) / n_axis + double(v[0][axis]));
    test.least_half_m = float(kLeastHalf * largest);
    return test;
}

} // namespace cl::gi
