// Bakes of a node: all of it, and again after one box moved. Scenes that are not there are left out.
#include "tests/shared_dir.h"

#include "scene/3d/gi_probe.h"
#include "scene/3d/mesh_instance.h"
#include "scene/io/resource_loader.h"
#include "scene/register_types.h"
#include "scene/resources/primitive_meshes.h"

#include "core/diagnostics.h"
#include "core/object/class_registry.h"

#include <benchmark/benchmark.h>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace cl::bench {

namespace {

namespace fs = std::filesystem;

fs::path cornell() {
    return tests::repository_dir() / "demo/scenes/cornell.tscn";
}

fs::path sponza() {
    const std::optional<fs::path> shared = tests::shared_dir();
    return shared ? *shared / "assets/gltf/Sponza/sponza_text.tscn" : fs::path();
}

/// A scene with a probe and a box of 1 m that can be moved.
struct Loaded {
    std::unique_ptr<scene::Node> root;
    scene::GIProbe* probe = nullptr;
    scene::MeshInstance* box = nullptr;
};

Loaded load(const fs::path& file) {
    static const bool registered = [] {
        scene::register_scene_types(ClassRegistry::instance());
        return true;
    }();
    static_cast<void>(registered);
    Diagnostics diagnostics;
    scene::ResourceLoader loader(scene::ProjectPaths::containing(file), diagnostics);
    const Expected<Ref<scene::PackedScene>> packed = loader.load_scene(file);
    auto root = packed ? (*packed)->instance(diagnostics) : packed.error();
    Loaded loaded;
    if (root) {
        loaded.root = std::move(*root);
        loaded.root->for_each_in_subtree([&](scene::Node& node) {
            auto* probe = dynamic_cast<scene::GIProbe*>(&node);
            loaded.probe = probe ? probe : loaded.probe;
        });
        loaded.box = &loaded.root->add_new<scene::MeshInstance>("Box");
        auto cube = make_ref<scene::CubeMesh>();
        static_cast<void>(cube->set("size", glm::vec3(1.0f)));
        loaded.box->set_mesh(cube);
        loaded.box->set_use_in_baked_light(true);
    }
    return loaded;
}

/// Moves the box by 0.1 m, forth and back, and bakes.
void bake_moved(benchmark::State& state, const fs::path& file, scene::BakeFor purpose) {
    static std::map<fs::path, Loaded> known;
    if (!known.contains(file)) {
        known.emplace(file, load(file));
    }
    const Loaded& scene = known[file];
    if (!scene.probe) {
        state.SkipWithError("no such scene");
        return;
    }
    const int cells = int(state.range(0));
    const auto subdiv = cells == 128 ? scene::GIProbeSubdiv::Cells128 : scene::GIProbeSubdiv::Cells256;
    static_cast<void>(scene.probe->set_subdiv(subdiv));
    static_cast<void>(scene.probe->bake(scene.root.get(), {}, purpose));
    float x_m = 0.0f;
    for (auto _ : state) {
        static_cast<void>(_);
        x_m = 0.1f - x_m;
        scene.box->set_translation({x_m, 0.51f, 0.0f});
        benchmark::DoNotOptimize(scene.probe->bake(scene.root.get(), {}, purpose).has_value());
    }
}

void at_128_and_256(benchmark::internal::Benchmark* b) {
    b->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK_CAPTURE(bake_moved, all_of_cornell, cornell(), scene::BakeFor::Once)->Apply(at_128_and_256);
BENCHMARK_CAPTURE(bake_moved, cornell_again, cornell(), scene::BakeFor::Edits)->Apply(at_128_and_256);
BENCHMARK_CAPTURE(bake_moved, all_of_sponza, sponza(), scene::BakeFor::Once)->Apply(at_128_and_256);
BENCHMARK_CAPTURE(bake_moved, sponza_again, sponza(), scene::BakeFor::Edits)->Apply(at_128_and_256);

} // namespace

} // namespace cl::bench
