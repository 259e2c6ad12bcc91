#include "core/math/aabb.h"
#include "core/math/color.h"
#include "core/math/transform.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <random>

namespace cl {
namespace {

constexpr float kPi = 3.14159265f;

/// Numbers in [-1, 1] that are the same on every run.
class Numbers {
public:
    float next() {
        return static_cast<float>(engine_()) / static_cast<float>(std::mt19937::max()) * 2.0f - 1.0f;
    }
    glm::vec3 vec3() {
        const float x = next(), y = next(), z = next();
        return {x, y, z};
    }
    Transform transform() {
        return {glm::mat3(1.5f) + glm::mat3(vec3() * 0.4f, vec3() * 0.4f, vec3() * 0.4f), vec3() * 10.0f};
    }

private:
    std::mt19937 engine_{7};
};

void check_close(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    CAPTURE(a.x);
    CAPTURE(b.x);
    CHECK(glm::length(a - b) <= tolerance);
}

void check_close(const glm::mat3& a, const glm::mat3& b, float tolerance) {
    for (int i = 0; i < 3; i++) {
        check_close(a[i], b[i], tolerance);
    }
}

} // namespace

TEST_SUITE("core/math/transform") {
    TEST_CASE("a transform times its inverse is the identity, also with scale and shear") {
        Numbers numbers;
        for (int i = 0; i < 100; i++) {
            const Transform t = numbers.transform();
            const Transform product = t * t.inverse();
            check_close(product.basis, glm::mat3(1.0f), 1e-5f);
            check_close(product.origin, glm::vec3(0.0f), 1e-4f);
        }
    }

    TEST_CASE("a product moves a point as its factors do one after the other, and so does its 4x4 matrix") {
        Numbers numbers;
        for (int i = 0; i < 100; i++) {
            const Transform a = numbers.transform(), b = numbers.transform();
            const glm::vec3 p = numbers.vec3();
            check_close((a * b).xform(p), a.xform(b.xform(p)), 1e-4f);
            check_close(glm::vec3(a.to_mat4() * glm::vec4(p, 1.0f)), a.xform(p), 1e-5f);
        }
    }

    TEST_CASE("orthonormalising keeps x's direction, makes a rotation and leaves the origin alone") {
        Numbers numbers;
        for (int i = 0; i < 100; i++) {
            const Transform t = numbers.transform();
            const Transform o = t.orthonormalized();
            check_close(glm::transpose(o.basis) * o.basis, glm::mat3(1.0f), 1e-5f);
            check_close(o.basis[0], glm::normalize(t.basis[0]), 1e-6f);
            CHECK(glm::dot(o.basis[1], t.basis[1]) > 0.0f);
            CHECK(o.origin == t.origin);
        }
    }

    TEST_CASE("orthonormalising a flattened basis gives finite numbers") {
        const Transform flat{glm::mat3(glm::vec3(2, 0, 0), glm::vec3(0), glm::vec3(0, 0, 3)), {}};
        check_close(flat.orthonormalized().basis,
                    glm::mat3(glm::vec3(1, 0, 0), glm::vec3(0), glm::vec3(0, 0, 1)), 0.0f);
    }

    TEST_CASE("euler angles turn about z first, then x, then y") {
        // A quarter turn about y takes -z (forward) to -x; one about x takes it to +y.
        const glm::vec3 forward(0, 0, -1);
        check_close(basis_from_euler_yxz({0, kPi / 2, 0}) * forward, {-1, 0, 0}, 1e-6f);
        check_close(basis_from_euler_yxz({kPi / 2, 0, 0}) * forward, {0, 1, 0}, 1e-6f);
        check_close(basis_from_euler_yxz({0, 0, kPi / 2}) * glm::vec3(1, 0, 0), {0, 1, 0}, 1e-6f);
        const glm::mat3 x = basis_from_euler_yxz({0.3f, 0, 0}), y = basis_from_euler_yxz({0, 0.5f, 0}),
                        z = basis_from_euler_yxz({0, 0, -0.7f});
        check_close(basis_from_euler_yxz({0.3f, 0.5f, -0.7f}), y * x * z, 1e-6f);
    }

    TEST_CASE("euler angles of a rotation rebuild it, at the poles too") {
        Numbers numbers;
        for (int i = 0; i < 200; i++) {
            const glm::vec3 euler = numbers.vec3() * glm::vec3(kPi / 2, kPi, kPi) * 0.999f;
            check_close(euler_yxz_from_basis(basis_from_euler_yxz(euler)), euler, 3e-3f);
        }
        for (const float pole : {kPi / 2, -kPi / 2}) {
            const glm::mat3 basis = basis_from_euler_yxz({pole, 0.4f, 1.1f});
            check_close(basis_from_euler_yxz(euler_yxz_from_basis(basis)), basis, 1e-3f);
            CHECK(euler_yxz_from_basis(basis).z == 0.0f);
        }
    }
}

TEST_SUITE("core/math/aabb") {
    TEST_CASE("boxes that only touch intersect inclusively but not strictly") {
        const AABB a{{0, 0, 0}, {1, 1, 1}}, beside{{1, 0, 0}, {1, 1, 1}}, apart{{1.5f, 0, 0}, {1, 1, 1}};
        CHECK(a.intersects_inclusive(beside));
        CHECK_FALSE(a.intersects(beside));
        CHECK_FALSE(a.intersects_inclusive(apart));
        const AABB overlapping{{0.5f, 0.5f, 0.5f}, {1, 1, 1}};
        CHECK(a.intersects(overlapping));
        CHECK(overlapping.intersects(a));
    }

    TEST_CASE("merging and expanding cover what they are given and no more") {
        const AABB merged = AABB{{0, 0, 0}, {1, 1, 1}}.merged({{2, -1, 0}, {1, 1, 0.5f}});
        CHECK(merged == AABB{{0, -1, 0}, {3, 2, 1}});
        CHECK(AABB{{0, 0, 0}, {1, 1, 1}}.expanded_to({0.5f, 3, -1}) == AABB{{0, 0, -1}, {1, 3, 2}});
        CHECK(AABB{{0, 0, 0}, {1, 1, 1}}.grown(0.5f) == AABB{{-0.5f, -0.5f, -0.5f}, {2, 2, 2}});
        CHECK(AABB{{0, 0, 0}, {2, 4, 6}}.center() == glm::vec3(1, 2, 3));
    }

    TEST_CASE("a transformed box is the tight box around the eight transformed corners") {
        Numbers numbers;
        for (int i = 0; i < 100; i++) {
            const Transform t = numbers.transform();
            const AABB box{numbers.vec3(), glm::abs(numbers.vec3())};
            AABB corners{t.xform(box.position), glm::vec3(0.0f)};
            for (int c = 1; c < 8; c++) {
                const glm::vec3 pick(c & 1 ? 1 : 0, c & 2 ? 1 : 0, c & 4 ? 1 : 0);
                corners = corners.expanded_to(t.xform(box.position + box.size * pick));
            }
            const AABB got = transformed(t, box);
            check_close(got.position, corners.position, 1e-5f);
            check_close(got.end(), corners.end(), 1e-5f);
        }
    }

    TEST_CASE("a plane's distance is positive on the side its normal points to") {
        const Plane ground{{0, 1, 0}, 2};
        CHECK(ground.distance_to({5, 3, -7}) == 1.0f);
        CHECK(ground.distance_to({0, 0, 0}) == -2.0f);
    }
}

TEST_SUITE("core/math/color") {
    TEST_CASE("sRGB and linear are inverse to each other, keep 0 and 1 and grow steadily") {
        CHECK(linear_from_srgb(0.0f) == 0.0f);
        CHECK(linear_from_srgb(1.0f) == doctest::Approx(1.0f).epsilon(1e-6));
        float previous = -1.0f;
        for (int i = 0; i <= 1000; i++) {
            const float c = static_cast<float>(i) / 500.0f; // beyond 1 too: nothing is clamped
            CAPTURE(c);
            CHECK(srgb_from_linear(linear_from_srgb(c)) == doctest::Approx(c).epsilon(1e-4));
            CHECK(linear_from_srgb(c) > previous);
            previous = linear_from_srgb(c);
        }
    }

    TEST_CASE("the curve goes through the standard's known point and acts on each channel alone") {
        CHECK(linear_from_srgb(0.5f) == doctest::Approx(0.214041f).epsilon(1e-5));
        CHECK(srgb_from_linear(0.18f) == doctest::Approx(0.461356f).epsilon(1e-5));
        CHECK(linear_from_srgb(glm::vec3(0, 0.5f, 1)).g == linear_from_srgb(0.5f));
        CHECK(srgb_from_linear(glm::vec3(0, 0.18f, 1)).g == srgb_from_linear(0.18f));
    }
}

} // namespace cl
