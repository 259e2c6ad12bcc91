#include "tests/drivers/gl_test.h"
#include "tests/drivers/gles3/fragment_probe.h"
#include "tests/drivers/gles3/gpu_volume.h"
#include "tests/shared_dir.h"

#include "drivers/gles3/omni_faces.h"

#include "core/io/file.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/common.hpp>

#include <random>
#include <string>
#include <vector>

using namespace cl;
using namespace cl::gles3;

namespace {

constexpr float kNear_m = 0.002f;

bool contains(const gl::Rect& outer, const gl::Rect& inner) {
    const glm::ivec2 outer_end = outer.position + outer.size, inner_end = inner.position + inner.size;
    return glm::min(outer.position, inner.position) == outer.position &&
           glm::max(outer_end, inner_end) == outer_end;
}

bool overlap(const gl::Rect& a, const gl::Rect& b) {
    const glm::ivec2 low = glm::max(a.position, b.position);
    const glm::ivec2 high = glm::min(a.position + a.size, b.position + b.size);
    return low.x < high.x && low.y < high.y;
}

/// The face that a point lies on.
int face_of(const glm::vec3& p) {
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        axis = std::abs(p[i]) > std::abs(p[axis]) ? i : axis;
    }
    return axis + (p[axis] < 0.0f ? 3 : 0);
}

/// Where a face's pass draws a point, in texels of the atlas, and its depth in 0..1.
glm::vec3 drawn_at(const OmniFaces& faces, int face, const glm::vec3& p) {
    const glm::vec4 clip =
        faces.clip_from_face(kNear_m) * glm::vec4(OmniFaces::face_from_light(face).xform(p), 1.0f);
    const glm::vec3 unit = 0.5f * glm::vec3(clip) / clip.w + 0.5f;
    const gl::Rect rect = faces.rect(face);
    return {glm::vec2(rect.position) + glm::vec2(unit) * glm::vec2(rect.size), unit.z};
}

/// Points all around, some near the edges between faces.
std::vector<glm::vec3> points_around(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> part(-1.0f, 1.0f);
    std::vector<glm::vec3> points;
    for (int i = 0; i < count; ++i) {
        glm::vec3 p(part(random), part(random), part(random));
        if (i % 3 == 0) {
            p[i % 2] = (i % 4 < 2 ? 0.999f : -0.999f) * p.z;
        }
        points.push_back(p * (i % 5 == 0 ? 30.0f : 1.0f));
    }
    return points;
}

} // namespace

TEST_SUITE("drivers/gles3/omni_faces") {
    TEST_CASE("six tiles lie in a slot of any size and do not overlap") {
        for (const int size : {8, 16, 64, 256, 2048, 8192}) {
            CAPTURE(size);
            const gl::Rect slot{{3, 5}, {size, size}};
            const OmniFaces faces(slot);
            CHECK(contains(slot, faces.rect()));
            for (int i = 0; i < 6; ++i) {
                CHECK(contains(faces.rect(), faces.rect(i)));
                for (int k = 0; k < i; ++k) {
                    CHECK_FALSE(overlap(faces.rect(i), faces.rect(k)));
                }
            }
        }
    }

    TEST_CASE("a filter that reaches two texels far stays in the tile of its point") {
        for (const int size : {32, 256, 2048}) {
            const OmniFaces faces({{0, 0}, {size, size}});
            for (const glm::vec3& p : points_around(200)) {
                const int face = face_of(p);
                const gl::Rect rect = faces.rect(face);
                const glm::vec2 at = glm::vec2(drawn_at(faces, face, p)) - glm::vec2(rect.position);
                const glm::vec2 margin = glm::min(at, glm::vec2(rect.size) - at);
                CHECK(std::min(margin.x, margin.y) > 1.999f);
            }
        }
    }

    TEST_CASE("[gl] the shader looks points up where they are drawn, at the same depth") {
        const OmniFaces faces({{2048, 1024}, {1024, 1024}});
        const std::vector<glm::vec3> points = points_around(64);
        const auto library =
            read_text_file(tests::repository_dir() / "drivers/gles3/shaders/lib/omni_faces.glsl");
        REQUIRE(library);
        std::string body = *library + "vec4 probe(int pixel) {\nvec3 p = vec3(0.0);\n";
        for (size_t i = 0; i < points.size(); ++i) {
            body += fmt::format("if (pixel == {}) p = {};\n", i, tests::glsl(points[i]));
        }
        body += fmt::format("return vec4(omni_face_at(p, {}, {}), omni_face_depth(p));\n}}\n",
                            tests::glsl(faces.uv_tiles(1)), tests::glsl(kNear_m));
        tests::on_each_gl([&](tests::GLTest&) {
            const std::vector<glm::vec4> got = tests::probe_fragments(body, static_cast<int>(points.size()));
            for (size_t i = 0; i < points.size(); ++i) {
                const glm::vec3 p = points[i];
                CAPTURE(i);
                const glm::vec3 expected = drawn_at(faces, face_of(p), p);
                CHECK(glm::distance(glm::vec2(got[i]), glm::vec2(expected)) < 0.01f); // texels
                CHECK(std::abs(got[i].z - expected.z) < 3e-7f);
                CHECK(got[i].w == std::max(std::abs(p.x), std::max(std::abs(p.y), std::abs(p.z))));
            }
        });
    }
}
