#include "tests/servers/gi/primitive_arrays.h"

#include "servers/gi/cell_words.h"
#include "servers/gi/voxelizer.h"

#include "core/threads.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <set>

namespace {

using namespace cl;

/// Surfaces with the arrays and materials that they point to.
class Bake {
public:
    explicit Bake(const glm::vec3& extents_m = glm::vec3(1.0f), int subdivision = 64)
        : grid_(*gi::compute_grid(extents_m, subdivision)) {}

    gi::PlotSurface& add(const SurfaceArrays& arrays, const Transform& local_from_mesh,
                         const glm::vec3& albedo = glm::vec3(1.0f),
                         const glm::vec3& emission = glm::vec3(0.0f)) {
        arrays_.push_back(std::make_unique<SurfaceArrays>(arrays));
        materials_.push_back(std::make_unique<gi::MaterialCapture>());
        materials_.back()->albedo = {albedo};
        materials_.back()->emission = {emission};
        const SurfaceArrays& a = *arrays_.back();
        surfaces_.push_back(
            {local_from_mesh, a.positions, a.normals, a.uvs, a.indices, materials_.back().get()});
        return surfaces_.back();
    }
    [[nodiscard]] gi::MaterialCapture& last_material() { return *materials_.back(); }

    [[nodiscard]] gi::Octree run() const {
        const Expected<gi::BakedOctree> baked = gi::voxelize(grid_, surfaces_);
        REQUIRE_MESSAGE(baked.has_value(), (baked ? "" : baked.error().message));
        const Expected<gi::Octree> octree = gi::decode_octree(baked->dynamic_data);
        REQUIRE(octree.has_value());
        CHECK(baked->cell_count == octree->cells.size());
        CHECK(baked->leaf_count == octree->leaf_count);
        return *octree;
    }
    [[nodiscard]] Expected<gi::BakedOctree> attempt(const gi::BakeProgress& progress,
                                                    const gi::BakeLimits& limits = {}) const {
        return gi::voxelize(grid_, surfaces_, progress, limits);
    }

private:
    gi::Grid grid_;
    std::vector<gi::PlotSurface> surfaces_;
    std::vector<std::unique_ptr<SurfaceArrays>> arrays_;
    std::vector<std::unique_ptr<gi::MaterialCapture>> materials_;
};

/// Of the size of a captured map. @param upper, lower  RGBA8
Image picture_of_halves(const std::array<uint8_t, 4>& upper, const std::array<uint8_t, 4>& lower) {
    Image picture{.size = glm::ivec2(gi::kCaptureSize), .format = PixelFormat::RGBA8, .data = {}};
    for (int y = 0; y < gi::kCaptureSize; ++y) {
        for (int x = 0; x < gi::kCaptureSize; ++x) {
            const std::array<uint8_t, 4>& texel = y < gi::kCaptureSize / 2 ? upper : lower;
            picture.data.insert(picture.data.end(), texel.begin(), texel.end());
        }
    }
    return picture;
}

Transform at(const glm::vec3& origin) {
    Transform t;
    t.origin = origin;
    return t;
}

Transform turned(float angle_rad, const glm::vec3& axis, const glm::vec3& scale, const glm::vec3& origin) {
    Transform t;
    t.basis = glm::mat3(glm::scale(glm::rotate(glm::mat4(1.0f), angle_rad, axis), scale));
    t.origin = origin;
    return t;
}

std::vector<const gi::Cell*> leaves(const gi::Octree& octree) {
    std::vector<const gi::Cell*> result;
    for (const gi::Cell& cell : octree.cells) {
        if (int(cell.level_alpha >> 16) == octree.levels - 1) {
            result.push_back(&cell);
        }
    }
    return result;
}

std::set<uint32_t> words_of(const gi::Octree& octree, uint32_t gi::Cell::*word) {
    std::set<uint32_t> words;
    for (const gi::Cell* leaf : leaves(octree)) {
        words.insert(leaf->*word);
    }
    return words;
}

/// A scene with every kind of triangle: tiny, huge, smooth, degenerate, outside of the box.
Bake mixed_scene() {
    Bake bake({1.0f, 0.5f, 0.7f}, 128);
    bake.add(tests::as_stored(tests::sphere_arrays()),
             turned(0.4f, {0, 1, 0}, glm::vec3(0.4f, 0.3f, 0.5f), {0.1f, 0, 0}), {0.8f, 0.2f, 0.1f});
    bake.add(tests::as_stored(tests::cube_arrays(glm::vec3(1.0f))),
             turned(0.7f, glm::normalize(glm::vec3(1, 2, 3)), {0.9f, 0.05f, 1.5f}, {-0.2f, -0.1f, 0.1f}),
             {0.1f, 0.9f, 0.3f}, {1.0f, 2.0f, 0.5f});
    bake.add(tests::as_stored(tests::quad_arrays({50.0f, 50.0f})),
             turned(1.1f, {1, 0, 0}, glm::vec3(1.0f), {0, 0.2f, 0}));
    return bake;
}

TEST_SUITE("servers/gi/voxelizer") {
    TEST_CASE("any number of threads bakes the same ints") {
        const Bake bake = mixed_scene();
        set_thread_count(1);
        const std::vector<int32_t> one = gi::encode_octree(bake.run());
        set_thread_count(4);
        const std::vector<int32_t> four = gi::encode_octree(bake.run());
        set_thread_count(0);
        CHECK(one == four);
        CHECK(one.size() > 100000);
    }

    TEST_CASE("leaves cover a quad: every one touches it and it leaves none out") {
        Bake bake;
        bake.add(tests::as_stored(tests::quad_arrays({0.5f, 0.25f})), at({-0.3f, 0.2f, 0.01f}));
        // x in [-0.55, -0.05] is cells 14 to 30 of 1/32, y in [0.075, 0.325] is 9 of them, z one.
        const gi::Octree octree = bake.run();
        CHECK(octree.leaf_count == leaves(octree).size());
        CHECK(octree.leaf_count == 17 * 9);
    }

    TEST_CASE("a surface on a cell boundary marks the cells on both sides") {
        Bake bake;
        bake.add(tests::as_stored(tests::quad_arrays({4.0f, 4.0f})), at({0, 0, 0.5f}));
        CHECK(bake.run().leaf_count == 2 * 64 * 64);
        Bake inside;
        inside.add(tests::as_stored(tests::quad_arrays({4.0f, 4.0f})), at({0, 0, 0.51f}));
        CHECK(inside.run().leaf_count == 64 * 64);
    }

    TEST_CASE("no leaf lies outside dims, though triangles do") {
        Bake bake({1.0f, 0.4f, 0.3f}, 64);
        bake.add(tests::as_stored(tests::quad_arrays({20.0f, 20.0f})), at({0, 0, 0.1f}));
        CHECK(bake.run().leaf_count == 64 * 32);
    }

    TEST_CASE("surfaces that share a leaf mix by the fraction each covers") {
        Bake bake;
        bake.add(tests::as_stored(tests::quad_arrays({4.0f, 4.0f})), at({0, 0, 0.01f}), {1.0f, 0.0f, 0.0f});
        bake.add(tests::as_stored(tests::quad_arrays({4.0f, 4.0f})), at({0, 0, 0.02f}), {0.0f, 0.0f, 1.0f});
        CHECK(words_of(bake.run(), &gi::Cell::albedo) == std::set<uint32_t>{0x7F007F});
    }

    TEST_CASE("opposite normals in one leaf leave none") {
        Bake bake;
        bake.add(tests::as_stored(tests::quad_arrays({4.0f, 4.0f})), at({0, 0, 0.01f}));
        CHECK(words_of(bake.run(), &gi::Cell::normal) == std::set<uint32_t>{0x7F7FFF});
        SurfaceArrays back = tests::quad_arrays({4.0f, 4.0f});
        for (glm::vec3& n : back.normals) {
            n = -n;
        }
        bake.add(tests::as_stored(back), at({0, 0, 0.02f}));
        CHECK(words_of(bake.run(), &gi::Cell::normal) == std::set<uint32_t>{0x7F7F7F});
    }

    TEST_CASE("normals stay in mesh space however the mesh is turned: what Godot bakes") {
        Bake bake;
        bake.add(tests::as_stored(tests::quad_arrays({0.5f, 0.5f})),
                 turned(1.0f, {0, 1, 0}, glm::vec3(1.0f), glm::vec3(0.0f)));
        CHECK(words_of(bake.run(), &gi::Cell::normal) == std::set<uint32_t>{0x7F7FFF});
    }

    TEST_CASE("without normals a leaf takes the plane's, on the side from which the triangle is clockwise") {
        SurfaceArrays quad = tests::quad_arrays({4.0f, 4.0f});
        quad.normals.clear();
        Bake bake;
        bake.add(quad, at({0, 0, 0.01f}));
        CHECK(words_of(bake.run(), &gi::Cell::normal) == std::set<uint32_t>{0x7F7FFF});
    }

    TEST_CASE("emission is kept up to a length of 8") {
        Bake bake;
        bake.add(tests::as_stored(tests::quad_arrays({4.0f, 4.0f})), at({0, 0, 0.01f}), glm::vec3(0.5f),
                 {3.0f, 4.0f, 0.0f});
        bake.add(tests::as_stored(tests::quad_arrays({4.0f, 4.0f})), at({0, 0, 0.51f}), glm::vec3(0.5f),
                 {0.0f, 20.0f, 0.0f});
        // Unit direction (0.6, 0.8, 0) and length 5 of 8; direction y and length at its limit.
        CHECK(words_of(bake.run(), &gi::Cell::emission) == std::set<uint32_t>{0x99CC009F, 0x00FF00FF});
    }

    TEST_CASE("a texture lands where its coordinates say, unfiltered and wrapped") {
        // One triangle over the whole front of the box; coordinates run from 0 to 1 across it, plus whole
        // turns.
        SurfaceArrays wide;
        wide.positions = {{-1, -1, 0}, {-1, 3, 0}, {3, -1, 0}};
        wide.normals.assign(3, glm::vec3(0, 0, 1));
        wide.uvs = {{-3, -2}, {-3, -4}, {-1, -2}};
        Bake bake;
        bake.add(tests::as_stored(wide), at({0, 0, 0.01f}));
        gi::MaterialCapture& material = bake.last_material();
        material.albedo = gi::CapturedMap(picture_of_halves({0, 255, 0, 255}, {255, 0, 0, 255}),
                                          glm::vec3(1.0f), glm::vec3(0.0f));
        const gi::Octree octree = bake.run();
        CHECK(words_of(octree, &gi::Cell::albedo) == std::set<uint32_t>{0xFF0000, 0x00FF00});
        // The texture's upper half, which is green, is the box's.
        uint32_t upper = 0;
        for (const gi::Cell* leaf : leaves(octree)) {
            upper += leaf->albedo == 0x00FF00;
        }
        CHECK(upper == 32 * 64);
    }

    TEST_CASE("inner alpha is the mean of eight children") {
        const gi::Octree octree = mixed_scene().run();
        for (const gi::Cell& cell : octree.cells) {
            const int level = int(cell.level_alpha >> 16);
            if (level == octree.levels - 1) {
                continue;
            }
            double sum = 0.0;
            for (const uint32_t child : cell.children) {
                sum += child == gi::kNoChild ? 0.0 : octree.cells[child].level_alpha & 0xFFFFu;
            }
            const double alpha = cell.level_alpha & 0xFFFFu;
            REQUIRE(std::abs(alpha - sum / 8.0) < 2.0); // the children's own bits were truncated
        }
    }

    TEST_CASE("triangles that are not numbers are left out and hurt nobody") {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        const float infinity = std::numeric_limits<float>::infinity();
        Bake bake;
        SurfaceArrays quad = tests::quad_arrays({4.0f, 4.0f});
        bake.add(quad, at({0, 0, 0.01f}));
        for (const float bad : {nan, infinity, -infinity, 1e30f}) {
            SurfaceArrays broken = quad;
            broken.positions[2].y = bad;
            broken.positions[5].x = bad;
            bake.add(broken, at({0, 0, 0.6f}));
        }
        CHECK(bake.run().leaf_count == 64 * 64);
    }

    TEST_CASE("coordinates and normals that are not numbers give black, not undefined behaviour") {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        SurfaceArrays quad = tests::quad_arrays({4.0f, 4.0f});
        quad.uvs.assign(6, glm::vec2(nan, std::numeric_limits<float>::infinity()));
        quad.normals.assign(6, glm::vec3(nan));
        Bake bake;
        bake.add(quad, at({0, 0, 0.01f}), glm::vec3(nan), glm::vec3(nan));
        bake.last_material().albedo =
            gi::CapturedMap(picture_of_halves({9, 9, 9, 9}, {9, 9, 9, 9}), glm::vec3(nan), glm::vec3(0.0f));
        const gi::Octree octree = bake.run();
        CHECK(octree.leaf_count == 64 * 64);
        CHECK(words_of(octree, &gi::Cell::emission) == std::set<uint32_t>{0});
    }

    TEST_CASE("degenerate triangles bake like any other") {
        SurfaceArrays sliver;
        sliver.positions = {{-0.5f, 0.01f, 0.01f}, {0.5f, 0.01f, 0.01f},  {0.5f, 0.01f, 0.01f}, //
                            {0.01f, 0.51f, 0.01f}, {0.01f, 0.51f, 0.01f}, {0.01f, 0.51f, 0.01f}};
        sliver.normals.assign(6, glm::vec3(0, 1, 0));
        Bake bake;
        bake.add(sliver, Transform{});
        // A segment from -0.5 to 0.5 touches 34 cells of 1/32: both ends lie on boundaries. A point touches
        // one.
        CHECK(bake.run().leaf_count == 34 + 1);
    }

    TEST_CASE("leftover vertices are dropped") {
        SurfaceArrays quad = tests::quad_arrays({4.0f, 4.0f});
        Bake whole;
        whole.add(quad, at({0, 0, 0.01f}));
        for (int extra = 0; extra < 2; ++extra) {
            quad.positions.push_back({0, 0, 0.5f});
            quad.normals.push_back({0, 0, 1});
            quad.uvs.push_back({0, 0});
            Bake more;
            more.add(quad, at({0, 0, 0.01f}));
            CHECK(gi::encode_octree(more.run()) == gi::encode_octree(whole.run()));
        }
    }

    TEST_CASE("surfaces whose arrays do not fit together are refused") {
        const SurfaceArrays cube = tests::cube_arrays(glm::vec3(1.0f));
        const auto message = [&](auto change) {
            Bake bake;
            bake.add(cube, Transform{});
            change(bake.add(cube, Transform{}));
            const Expected<gi::BakedOctree> octree = bake.attempt({});
            return octree ? std::string("no error") : octree.error().message;
        };
        CHECK(message([](gi::PlotSurface&) {}) == "no error");
        CHECK(message([](gi::PlotSurface& s) { s.normals = s.normals.subspan(1); }) ==
              "plot surface 1: expected 24 normals, found 23");
        CHECK(message([](gi::PlotSurface& s) { s.uvs = s.uvs.subspan(2); }) ==
              "plot surface 1: expected 24 uvs, found 22");
        CHECK(message([](gi::PlotSurface& s) {
                  s.positions = s.positions.first(23);
                  s.normals = {};
                  s.uvs = {};
              }) == "plot surface 1: expected indices below 23, found 23");
        CHECK(message([](gi::PlotSurface& s) { s.material = nullptr; }) ==
              "plot surface 1: expected a material, found none");
    }

    TEST_CASE("progress only grows, ends at 1, and stops the bake when it says so") {
        const Bake bake = mixed_scene();
        float last = -1.0f;
        bool grows = true;
        REQUIRE(bake.attempt([&](float share) {
                        grows = grows && share >= last;
                        last = share;
                        return true;
                    })
                    .has_value());
        CHECK(grows);
        CHECK(last == 1.0f);
        int calls = 0;
        const Expected<gi::BakedOctree> cancelled = bake.attempt([&](float) { return ++calls < 3; });
        REQUIRE_FALSE(cancelled.has_value());
        CHECK(cancelled.error().code == ErrorCode::Cancelled);
        CHECK(calls == 3);
    }

    TEST_CASE("a bake that needs more cells than it may have stops with an error") {
        const Bake bake = mixed_scene();
        const gi::Octree octree = bake.run();
        const uint32_t needed = uint32_t(octree.cells.size());
        CHECK(bake.attempt({}, {needed}).has_value());
        const Expected<gi::BakedOctree> refused = bake.attempt({}, {needed - 1});
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().code == ErrorCode::OutOfMemory);
        CHECK_FALSE(bake.attempt({}, {100}).has_value());
    }
}

TEST_SUITE("servers/gi/cell_words") {
    TEST_CASE("words hold the specification's examples") {
        CHECK(gi::encode_albedo({0.8f, 0.4f, 0.2f}) == 0xCC6633);
        CHECK(gi::encode_emission({2.0f, 1.0f, 0.0f}) == 0xE4720047);
        CHECK(gi::encode_normal({0, 0, 1}) == 0x7F7FFF);
        CHECK(gi::encode_normal(glm::vec3(0.0f)) == 0x7F7F7F);
        CHECK(gi::encode_level_alpha(5, 0.5f) == ((5u << 16) | 32767u));
        CHECK(gi::encode_albedo({2.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) == 0xFF0000);
    }

    TEST_CASE("decoding a word and encoding it again loses at most one step") {
        for (uint32_t byte = 0; byte < 256; ++byte) {
            const uint32_t again = gi::encode_normal(gi::decode_normal(byte << 8)) >> 8 & 255u;
            CHECK(byte - again <= 1);
        }
        CHECK(gi::decode_normal(0x7F7F7F).x == doctest::Approx(-1.0 / 255.0));
        CHECK(gi::decode_emission(0x00FF00FF) == glm::vec3(0, 8, 0));
        CHECK(gi::albedo_bytes(0x00123456) == glm::u8vec3(0x12, 0x34, 0x56));
    }
}

} // namespace
