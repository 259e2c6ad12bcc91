#include "demo/cli/scene_loading.h"

#include "demo/cli/commands.h"
#include "demo/cli/progress_bar.h"

#include "scene/3d/gi_probe.h"
#include "scene/io/project_paths.h"
#include "scene/io/resource_loader.h"

#include "core/variant/variant_parser.h"

#include <fmt/format.h>

#include <cstdio>

namespace cl::demo {

namespace {

Error override_error(const PropertyOverride& o, std::string what) {
    return {ErrorCode::InvalidArgument, fmt::format("--set {}:{}: {}", o.node_path, o.property, what)};
}

Status apply_override(scene::Node& root, const PropertyOverride& o) {
    scene::Node* node = root.get_node(o.node_path);
    if (!node) {
        return override_error(o, "expected the path of a node, found no such node");
    }
    const Expected<Variant> value = parse_variant(o.value_text, "--set");
    if (!value) {
        return value.error();
    }
    const StringName property(o.property);
    if (!node->has_property(property)) {
        return override_error(
            o, fmt::format("expected a property of {}, found none of that name", node->class_name().str()));
    }
    switch (node->set(property, *value)) {
    case SetResult::Done:
        return {};
    case SetResult::UnknownProperty:
        return override_error(o, "expected a property, found none of that name");
    case SetResult::WrongType:
        return override_error(o, fmt::format("expected a value of another type, found {}", o.value_text));
    case SetResult::Refused:
        return override_error(o, fmt::format("expected a value in range, found {}", o.value_text));
    }
    return {};
}

/// What a probe's data says of itself; empty figures if it is not valid (loading warned about that).
ProbeFigures figures_of_data(scene::Node& root, const scene::GIProbe& probe) {
    ProbeFigures figures;
    figures.path = path_from_root(root, probe);
    figures.bytes = data_bytes(probe);
    const Expected<gi::Octree> octree = gi::decode_octree(probe.data()->data().dynamic_data);
    if (octree) {
        figures.size = octree->dims;
        figures.cells = static_cast<uint32_t>(octree->cells.size());
        figures.leaves = octree->leaf_count;
    }
    return figures;
}

} // namespace

Expected<LoadedScene> load_scene(const Options& options, Diagnostics& diagnostics) {
    const Stopwatch watch;
    const scene::ProjectPaths paths = scene::ProjectPaths::containing(options.input);
    LoadedScene loaded;
    Expected<scene::ProjectSettings> settings = scene::load_project_settings(paths, diagnostics);
    if (!settings) {
        return settings.error();
    }
    loaded.settings = *settings;
    scene::ResourceLoader loader(paths, diagnostics);
    const Expected<Ref<scene::PackedScene>> packed = loader.load_scene(options.input);
    if (!packed) {
        return packed.error();
    }
    Expected<std::unique_ptr<scene::Node>> root = (*packed)->instance(diagnostics);
    if (!root) {
        return root.error();
    }
    loaded.root = std::move(*root);
    for (const PropertyOverride& o : options.overrides) {
        if (Status applied = apply_override(*loaded.root, o); !applied) {
            return applied.error();
        }
    }
    loaded.load_ms = watch.elapsed_ms();
    return loaded;
}

std::string path_from_root(const scene::Node& root, const scene::Node& node) {
    return &root == &node ? "." : root.path_to(node).to_string();
}

std::vector<scene::GIProbe*> find_probes(scene::Node& root) {
    std::vector<scene::GIProbe*> probes;
    root.for_each_in_subtree([&probes](scene::Node& node) {
        if (auto* probe = dynamic_cast<scene::GIProbe*>(&node)) {
            probes.push_back(probe);
        }
    });
    return probes;
}

uint64_t data_bytes(const scene::GIProbe& probe) {
    return probe.data() ? probe.data()->data().dynamic_data.size() * sizeof(int32_t) : 0;
}

Expected<ProbeFigures> bake_with_progress(scene::Node& root, scene::GIProbe& probe, const Options& options) {
    const std::string path = path_from_root(root, probe);
    ProgressBar bar("baking " + path, options.verbosity);
    const Stopwatch watch;
    const auto show = [&bar](float share) {
        bar.show(share);
        return true;
    };
    const Expected<scene::BakeFigures> baked = probe.bake(&root, show, scene::BakeFor::Once);
    if (!baked) {
        return baked.error();
    }
    return ProbeFigures{path,          baked->size,        baked->cells,
                        baked->leaves, watch.elapsed_ms(), data_bytes(probe)};
}

Status bake_unbaked_probes(scene::Node& root, const Options& options, Figures& figures) {
    double bake_ms = 0.0;
    for (scene::GIProbe* probe : find_probes(root)) {
        if (probe->data()) {
            figures.probes.push_back(figures_of_data(root, *probe));
            continue;
        }
        Expected<ProbeFigures> baked = bake_with_progress(root, *probe, options);
        if (!baked) {
            return baked.error();
        }
        bake_ms += *baked->bake_ms;
        figures.bake_ms = bake_ms;
        figures.probes.push_back(std::move(*baked));
    }
    return {};
}

void print_warnings(const Diagnostics& diagnostics, Verbosity verbosity) {
    if (verbosity == Verbosity::Quiet) {
        return;
    }
    for (const Warning& warning : diagnostics.warnings()) {
        std::fprintf(stderr, "%s\n", warning.to_string().c_str());
    }
}

int fail(const Error& error, int status) {
    const std::string line =
        error.where.file.empty() ? "conelight: error: " + error.message : error.to_string();
    std::fprintf(stderr, "%s\n", line.c_str());
    return status;
}

} // namespace cl::demo
