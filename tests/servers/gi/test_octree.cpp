#include "tests/servers/gi/primitive_arrays.h"

#include "servers/gi/probe_data.h"
#include "servers/gi/voxelizer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

namespace {

using namespace cl;

/// The scene of the specification's worked example (gi-probe-data section 6): a small glowing quad.
gi::Octree worked_example() {
    const SurfaceArrays quad = tests::as_stored(tests::quad_arrays({0.5f, 0.25f}));
    gi::CaptureInput input;
    input.albedo_color = {0.8f, 0.4f, 0.2f};
    input.emission_color = {1.0f, 0.5f, 0.0f};
    input.emission_energy = 2.0f;
    const gi::MaterialCapture material = gi::capture_material(input);
    gi::PlotSurface surface{};
    surface.local_from_mesh.origin = {-0.3f, 0.2f, 0.01f};
    surface.positions = quad.positions;
    surface.normals = quad.normals;
    surface.uvs = quad.uvs;
    surface.material = &material;
    const Expected<gi::Grid> grid = gi::compute_grid({1.0f, 0.5f, 0.75f}, 64);
    const Expected<gi::BakedOctree> baked = gi::voxelize(*grid, std::span(&surface, 1));
    REQUIRE(baked.has_value());
    return *gi::decode_octree(baked->dynamic_data);
}

struct ExpectedCell {
    uint32_t index;
    std::vector<std::pair<int, uint32_t>> children; ///< slot, index
    uint32_t level, alpha;
};

std::string error_of(const std::vector<int32_t>& ints) {
    const Expected<gi::Octree> octree = gi::decode_octree(ints);
    return octree ? "no error" : octree.error().message;
}

/// Children that do not come after their parent, or not at all.
size_t stray_children(const gi::Octree& octree) {
    size_t strays = 0;
    for (size_t c = 0; c < octree.cells.size(); ++c) {
        for (const uint32_t child : octree.cells[c].children) {
            strays += child != gi::kNoChild && (child <= c || child >= octree.cells.size());
        }
    }
    return strays;
}

/// Int of field `field` of cell `cell`.
size_t at(size_t cell, size_t field) {
    return 16 + 12 * cell + field;
}

TEST_SUITE("servers/gi/octree") {
    TEST_CASE("the worked example bakes to the specification's cells, header and ints") {
        const gi::Octree octree = worked_example();
        const std::vector<int32_t> ints = gi::encode_octree(octree);
        REQUIRE(ints.size() == 2692);
        const std::vector<int32_t> header = {0, 7, 64, 32, 64, 223, 153, 0, 0, 0, 0, 0, 0, 0, 0, 0};
        CHECK(std::vector<int32_t>(ints.begin(), ints.begin() + 16) == header);

        const std::vector<ExpectedCell> expected = {
            {0, {{0, 1}}, 0, 38},
            {1, {{6, 2}, {7, 31}}, 1, 305},
            {2, {{5, 3}, {7, 21}}, 2, 287},
            {3, {{1, 4}, {3, 10}}, 3, 1535},
            {4, {{3, 5}}, 4, 4095},
            {5, {{0, 6}, {1, 7}, {2, 8}, {3, 9}}, 5, 32767},
            {10, {{1, 11}, {3, 16}}, 4, 8191},
            {11, {{0, 12}, {1, 13}, {2, 14}, {3, 15}}, 5, 32767},
            {16, {{0, 17}, {1, 18}, {2, 19}, {3, 20}}, 5, 32767},
            {21, {{1, 22}}, 3, 767},
        };
        for (const ExpectedCell& e : expected) {
            CAPTURE(e.index);
            const gi::Cell& cell = octree.cells[e.index];
            std::vector<std::pair<int, uint32_t>> children;
            for (int slot = 0; slot < 8; ++slot) {
                if (cell.children[slot] != gi::kNoChild) {
                    children.emplace_back(slot, cell.children[slot]);
                }
            }
            CHECK(children == e.children);
            CHECK(cell.level_alpha == ((e.level << 16) | e.alpha));
            CHECK(cell.albedo == 0);
            CHECK(cell.emission == 0);
            CHECK(cell.normal == 0x7F7F7F);
        }
        for (const size_t leaf : {6, 7, 8, 9, 12, 15, 17, 20}) {
            CAPTURE(leaf);
            const std::vector<int32_t> colours(ints.begin() + ptrdiff_t(at(leaf, 8)),
                                               ints.begin() + ptrdiff_t(at(leaf, 12)));
            CHECK(colours == std::vector<int32_t>{13395507, -462290873, 8355839, 458751});
            CHECK(ints[at(leaf, 0)] == -1);
            CHECK(ints[at(leaf, 7)] == -1);
        }
    }

    TEST_CASE("what is encoded decodes to the same cells") {
        const gi::Octree a = worked_example();
        const Expected<gi::Octree> b = gi::decode_octree(gi::encode_octree(a));
        REQUIRE(b.has_value());
        CHECK(b->levels == a.levels);
        CHECK(b->dims == a.dims);
        CHECK(b->leaf_count == a.leaf_count);
        CHECK(gi::encode_octree(*b) == gi::encode_octree(a));
    }

    TEST_CASE("padding ints are not read: Godot leaves heap memory in them") {
        std::vector<int32_t> ints = gi::encode_octree(worked_example());
        std::fill(ints.begin() + 7, ints.begin() + 16, 352391888);
        CHECK(error_of(ints) == "no error");
    }

    TEST_CASE("a bake of nothing is a root alone and valid") {
        const Expected<gi::Grid> grid = gi::compute_grid(glm::vec3(1.0f), 64);
        const Expected<gi::BakedOctree> baked = gi::voxelize(*grid, {});
        REQUIRE(baked.has_value());
        CHECK(baked->dynamic_data.size() == 28);
        CHECK(error_of(baked->dynamic_data) == "no error");
    }

    TEST_CASE("damaged ints are refused with the first that is wrong") {
        const std::vector<int32_t> good = gi::encode_octree(worked_example());
        const auto changed = [&](size_t index, int32_t value) {
            std::vector<int32_t> ints = good;
            ints[index] = value;
            return error_of(ints);
        };
        CHECK(error_of({}) == "dynamic_data: expected 16 + 12 * cells ints, at least 28, found 0");
        CHECK(error_of(std::vector<int32_t>(20, 0)) ==
              "dynamic_data: expected 16 + 12 * cells ints, at least 28, found 20");
        CHECK(error_of(std::vector<int32_t>(16, 0)) ==
              "dynamic_data: expected 16 + 12 * cells ints, at least 28, found 16");
        CHECK(changed(0, 1) == "dynamic_data: expected version 0 in int 0, found 1");
        CHECK(changed(1, 6) == "dynamic_data: expected 7 to 10 levels in int 1, found 6");
        CHECK(changed(1, -1) == "dynamic_data: expected 7 to 10 levels in int 1, found 4294967295");
        CHECK(changed(2, 48) == "dynamic_data: expected a power of two up to 64 in int 2, found 48");
        CHECK(changed(3, 0) == "dynamic_data: expected a power of two up to 64 in int 3, found 0");
        CHECK(changed(4, 128) == "dynamic_data: expected a power of two up to 64 in int 4, found 128");
        CHECK(changed(4, -64) == "dynamic_data: expected a power of two up to 64 in int 4, found 4294967232");
        CHECK(changed(5, 222) == "dynamic_data: expected 223 cells in int 5, found 222");
        CHECK(changed(5, 1000000000) == "dynamic_data: expected 223 cells in int 5, found 1000000000");
        CHECK(changed(6, 152) == "dynamic_data: expected 153 leaves in int 6, found 152");
    }

    TEST_CASE("cells that do not make a tree are refused") {
        const std::vector<int32_t> good = gi::encode_octree(worked_example());
        const auto changed = [&](size_t index, int32_t value) {
            std::vector<int32_t> ints = good;
            ints[index] = value;
            return error_of(ints);
        };
        // A cycle, a cell as its own child, a child beyond the array.
        CHECK(changed(at(5, 0), 4) == "dynamic_data: expected child 0 of cell 5 in 6 to 222, found 4");
        CHECK(changed(at(5, 0), 5) == "dynamic_data: expected child 0 of cell 5 in 6 to 222, found 5");
        CHECK(changed(at(5, 0), 223) == "dynamic_data: expected child 0 of cell 5 in 6 to 222, found 223");
        // A child shared by two parents, and then one without any.
        CHECK(changed(at(4, 0), 5) == "dynamic_data: expected one parent of cell 5, found a second, cell 4");
        CHECK(changed(at(5, 0), -1) == "dynamic_data: expected a parent of cell 6, found none");
        CHECK(changed(at(6, 2), 7) == "dynamic_data: expected no children of leaf cell 6, found 7 in slot 2");
        CHECK(changed(at(6, 11), 458751 - 65536) == "dynamic_data: expected level 6 of cell 6, found 5");
        CHECK(changed(at(0, 11), 1 << 16) == "dynamic_data: expected level 0 of cell 0, found 1");
        // Moves cell 1 from the lower to the upper half of y, which dims y = 32 does not have.
        std::vector<int32_t> ints = good;
        std::swap(ints[at(0, 0)], ints[at(0, 2)]);
        CHECK(error_of(ints) == "dynamic_data: expected cell 1 below 32 on y, found it at 32");
    }

    TEST_CASE("no single wrong int makes decoding anything but a tree or an error") {
        const std::vector<int32_t> good = gi::encode_octree(worked_example());
        std::mt19937 random(7);
        const int32_t values[] = {0, 1, -1, 2, 222, 223, 0x7FFFFFFF, int32_t(0x80000000u), 1 << 16, 7 << 16};
        size_t refused = 0;
        size_t strays = 0;
        for (int i = 0; i < 4000; ++i) {
            std::vector<int32_t> ints = good;
            ints[random() % ints.size()] = values[random() % std::size(values)];
            const Expected<gi::Octree> octree = gi::decode_octree(ints);
            refused += !octree.has_value();
            strays += octree ? stray_children(*octree) : 0;
        }
        CHECK(strays == 0);
        CHECK(refused > 1000);
    }
}

} // namespace
