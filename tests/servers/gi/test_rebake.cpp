#include "tests/servers/gi/primitive_arrays.h"

#include "servers/gi/rebake.h"

#include "core/threads.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <memory>
#include <random>

namespace {

using namespace cl;

/// A thing to bake. What it points to never changes, so the digest may take pointers for contents.
struct Thing {
    const SurfaceArrays* arrays;
    Transform place;
    const gi::MaterialCapture* material;
};

gi::MaterialCapture noisy_material(uint32_t seed) {
    std::mt19937 random(seed);
    Image picture{.size = glm::ivec2(gi::kCaptureSize), .format = PixelFormat::RGBA8, .data = {}};
    picture.data.resize(size_t(4) * gi::kCaptureSize * gi::kCaptureSize);
    std::generate(picture.data.begin(), picture.data.end(), [&] { return uint8_t(random()); });
    return {gi::CapturedMap(picture, glm::vec3(0.9f, 0.7f, 0.5f), glm::vec3(0.0f)),
            gi::CapturedMap(glm::vec3(0.3f, 0.1f, 0.7f))};
}

/// What is there to choose from.
struct Stock {
    std::vector<SurfaceArrays> arrays;
    std::vector<gi::MaterialCapture> materials;
};

const Stock& stock() {
    static const Stock all{{tests::as_stored(tests::cube_arrays(glm::vec3(0.5f))),
                            tests::as_stored(tests::sphere_arrays()),
                            tests::as_stored(tests::quad_arrays({0.6f, 0.3f})),
                            tests::as_stored(tests::quad_arrays({30.0f, 20.0f}))},
                           {gi::MaterialCapture{glm::vec3(0.8f, 0.2f, 0.1f), glm::vec3(0.0f)},
                            gi::MaterialCapture{glm::vec3(0.3f), glm::vec3(2.0f, 1.0f, 0.0f)},
                            noisy_material(1), noisy_material(2)}};
    return all;
}

class Scene {
public:
    explicit Scene(uint32_t seed) : random_(seed) {
        for (int i = 0; i < 8; ++i) {
            add();
        }
    }

    /// Moves, adds, removes, swaps, repaints or reshapes a thing.
    void edit() {
        if (things.empty()) {
            return add();
        }
        Thing& thing = things[below(things.size())];
        switch (below(7)) {
        case 0:
            thing.place.origin += glm::vec3(real(), real(), real()) * 0.3f;
            break;
        case 1:
            thing.place = somewhere();
            break;
        case 2:
            add();
            break;
        case 3:
            things.erase(things.begin() + (&thing - things.data()));
            break;
        case 4:
            std::swap(thing, things[below(things.size())]);
            break;
        case 5:
            thing.material = &stock().materials[below(stock().materials.size())];
            break;
        default:
            thing.arrays = &stock().arrays[below(stock().arrays.size())];
            break;
        }
    }

    std::vector<Thing> things;

private:
    void add() {
        const Thing thing{&stock().arrays[below(stock().arrays.size())], somewhere(),
                          &stock().materials[below(stock().materials.size())]};
        things.insert(things.begin() + int64_t(below(things.size() + 1)), thing);
    }
    Transform somewhere() {
        Transform t;
        const glm::vec3 axis = glm::normalize(glm::vec3(real(), real(), real()) + 1e-3f);
        t.basis =
            glm::mat3(glm::rotate(glm::mat4(1.0f), 3.0f * real(), axis)) * (0.1f + 0.3f * (1.0f + real()));
        t.origin = glm::vec3(real(), real(), real());
        return t;
    }
    size_t below(size_t count) { return random_() % count; }
    /// In -1..1.
    float real() { return std::uniform_real_distribution(-1.0f, 1.0f)(random_); }

    std::mt19937 random_;
};

Digest digest_of(const Thing& thing) {
    const Transform& t = thing.place;
    Digester digester;
    for (const glm::vec3& column : {t.basis[0], t.basis[1], t.basis[2], t.origin}) {
        digester.add(column.x).add(column.y).add(column.z);
    }
    return digester.add(uint64_t(thing.arrays - stock().arrays.data()))
        .add(uint64_t(thing.material - stock().materials.data()))
        .digest();
}

gi::PlotSurface surface_of(const Thing& thing) {
    const SurfaceArrays& a = *thing.arrays;
    return {thing.place, a.positions, a.normals, a.uvs, a.indices, thing.material};
}

gi::Grid grid_of(const glm::vec3& extents_m, int subdivision) {
    return *gi::compute_grid(extents_m, subdivision);
}

/// Bakes the same probe again and again.
class Probe {
public:
    Expected<gi::BakedOctree> bake(const gi::Grid& grid, const std::vector<Thing>& things,
                                   const gi::BakeProgress& progress = {}, const gi::BakeLimits& limits = {}) {
        asked_for.clear();
        std::vector<Digest> digests;
        for (const Thing& thing : things) {
            digests.push_back(digest_of(thing));
        }
        const auto source = [&](std::span<const uint32_t> numbers) {
            std::vector<gi::PlotSurface> surfaces;
            for (const uint32_t number : numbers) {
                asked_for.push_back(number);
                surfaces.push_back(surface_of(things[number]));
            }
            return surfaces;
        };
        const Expected<gi::BakedOctree> octree =
            gi::revoxelize(grid, digests, source, memory, dynamic_data, progress, limits);
        if (octree) {
            dynamic_data = octree->dynamic_data;
        }
        return octree;
    }

    gi::BakeMemory memory;
    std::vector<int32_t> dynamic_data;
    std::vector<uint32_t> asked_for; ///< by the last bake
};

std::vector<int32_t> full_bake(const gi::Grid& grid, const std::vector<Thing>& things) {
    std::vector<gi::PlotSurface> surfaces;
    for (const Thing& thing : things) {
        surfaces.push_back(surface_of(thing));
    }
    const Expected<gi::BakedOctree> octree = gi::voxelize(grid, surfaces);
    REQUIRE(octree.has_value());
    return octree->dynamic_data;
}

/// A small box in a corner and one in the opposite corner.
std::vector<Thing> two_boxes() {
    std::vector<Thing> things(2, {stock().arrays.data(), Transform(), stock().materials.data()});
    things[0].place.origin = glm::vec3(-0.7f);
    things[1].place.origin = glm::vec3(0.7f);
    return things;
}

} // namespace

TEST_SUITE("servers/gi/rebake") {
    TEST_CASE(
        "after any edits a bake that remembers makes what a full bake does, for any number of threads") {
        // Flat boxes have cells whose children lie outside the grid, and triangles that touch only these.
        const gi::Grid grids[] = {grid_of(glm::vec3(1.0f), 64), grid_of({1.0f, 0.13f, 0.4f}, 128)};
        for (uint32_t seed = 0; seed < 8; ++seed) {
            CAPTURE(seed);
            set_thread_count(seed % 2 == 0 ? 1 : 4);
            Scene scene(seed);
            Probe probe;
            for (int round = 0; round < 12; ++round) {
                CAPTURE(round);
                const gi::Grid& grid = grids[round == 8 ? 1 - seed % 2 : seed % 2];
                REQUIRE(probe.bake(grid, scene.things).has_value());
                REQUIRE(probe.dynamic_data == full_bake(grid, scene.things));
                for (uint32_t edits = seed % 3 + 1; edits > 0; --edits) {
                    scene.edit();
                }
            }
        }
        set_thread_count(0);
    }

    TEST_CASE("nothing is asked for where nothing changed, and only what is near where something did") {
        const gi::Grid grid = grid_of(glm::vec3(1.0f), 64);
        std::vector<Thing> things = two_boxes();
        Probe probe;
        REQUIRE(probe.bake(grid, things).has_value());
        CHECK(probe.asked_for == std::vector<uint32_t>{0, 1});
        const std::vector<int32_t> first = probe.dynamic_data;
        REQUIRE(probe.bake(grid, things).has_value());
        CHECK(probe.asked_for.empty());
        CHECK(probe.dynamic_data == first);
        things[1].place.origin.x -= 0.1f;
        REQUIRE(probe.bake(grid, things).has_value());
        CHECK(std::count(probe.asked_for.begin(), probe.asked_for.end(), 0u) == 0);
        things.pop_back();
        REQUIRE(probe.bake(grid, things).has_value());
        CHECK(probe.asked_for.empty());
        CHECK(probe.dynamic_data == full_bake(grid, things));
    }

    TEST_CASE("cells that a triangle touches only beyond the grid stay, though they have no bricks") {
        const gi::Grid grid = grid_of({1.0f, 0.06f, 1.0f}, 128);
        std::vector<Thing> things = two_boxes();
        things[0].place = {glm::mat3(0.2f), {-0.7f, 0.0f, 0.9f}}; // in other bricks than the slope
        things[1] = {&stock().arrays[2], Transform(), stock().materials.data()};
        Transform& slope = things[1].place; // through the grid on the left, high above it on the right
        slope.basis = glm::mat3(glm::rotate(glm::mat4(1.0f), 0.8f, {0, 0, 1})) *
                      glm::mat3(glm::rotate(glm::mat4(4.5f), 1.6f, {1, 0, 0}));
        slope.origin = {-0.5f, 0.0f, 0.0f};
        Probe probe;
        REQUIRE(probe.bake(grid, things).has_value());
        const gi::Octree octree = *gi::decode_octree(probe.dynamic_data);
        CHECK(std::any_of(octree.cells.begin(), octree.cells.end(), [](const gi::Cell& cell) {
            const auto is_none = [](uint32_t child) { return child == gi::kNoChild; };
            return cell.level_alpha >> 16 == 1 &&
                   std::all_of(std::begin(cell.children), std::end(cell.children), is_none);
        }));
        things[0].place.origin.x -= 0.1f;
        REQUIRE(probe.bake(grid, things).has_value());
        CHECK(probe.dynamic_data == full_bake(grid, things));
    }

    TEST_CASE("bricks that were not plotted again count as cells") {
        const gi::Grid grid = grid_of(glm::vec3(1.0f), 64);
        std::vector<Thing> things = two_boxes();
        Probe probe;
        const Expected<gi::BakedOctree> first = probe.bake(grid, things);
        REQUIRE(first.has_value());
        const uint32_t cells = first->cell_count;
        const Expected<gi::BakedOctree> refused = probe.bake(grid, things, {}, {.max_cells = cells - 1});
        REQUIRE(!refused.has_value());
        CHECK(refused.error().code == ErrorCode::OutOfMemory);
        CHECK(probe.bake(grid, things, {}, {.max_cells = cells}).has_value());
    }

    TEST_CASE(
        "a cancelled bake leaves what is remembered as it was; progress grows to 1 over what is plotted") {
        const gi::Grid grid = grid_of(glm::vec3(1.0f), 64);
        std::vector<Thing> things = two_boxes();
        Probe probe;
        REQUIRE(probe.bake(grid, things).has_value());
        things[0].place.origin.y += 0.2f;
        const Expected<gi::BakedOctree> cancelled =
            probe.bake(grid, things, [](float share) { return share == 0.0f; });
        REQUIRE(!cancelled.has_value());
        CHECK(cancelled.error().code == ErrorCode::Cancelled);
        float last = 0.0f;
        const auto grows = [&last](float share) {
            CHECK(share >= last);
            last = share;
            return true;
        };
        REQUIRE(probe.bake(grid, things, grows).has_value());
        CHECK(last == 1.0f);
        CHECK(probe.dynamic_data == full_bake(grid, things));
    }
}
