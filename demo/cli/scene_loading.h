#pragma once

#include "demo/cli/figures.h"
#include "demo/cli/options.h"

#include "scene/io/project_settings.h"
#include "scene/main/node.h"

#include "core/diagnostics.h"
#include "core/expected.h"

#include <memory>
#include <string>
#include <vector>

namespace cl::scene {
class GIProbe;
}

namespace cl::demo {

/// A scene file loaded, with the command line's overrides applied, not yet in a tree.
struct LoadedScene {
    std::unique_ptr<scene::Node> root;
    scene::ProjectSettings settings;
    double load_ms = 0.0;
};

/// Reads the scene of `options` and applies its `--set`s. Warnings go to `diagnostics`.
/// @return the first error of the scene, or of an override (placed on the command line).
[[nodiscard]] Expected<LoadedScene> load_scene(const Options& options, Diagnostics& diagnostics);

/// Path of a node from the scene's root: "Room/Probe"; "." for the root itself.
[[nodiscard]] std::string path_from_root(const scene::Node& root, const scene::Node& node);

/// The scene's probes in tree order.
[[nodiscard]] std::vector<scene::GIProbe*> find_probes(scene::Node& root);

/// Size of a probe's data as stored; 0 if it has none.
[[nodiscard]] uint64_t data_bytes(const scene::GIProbe& probe);

/// Bakes one probe, with a progress bar on a terminal.
[[nodiscard]] Expected<ProbeFigures> bake_with_progress(scene::Node& root, scene::GIProbe& probe,
                                                        const Options& options);

/// Bakes the probes that have no data, one after the other.
/// @param figures  receives one entry a probe, baked or not, and the sum of the bakes' times.
[[nodiscard]] Status bake_unbaked_probes(scene::Node& root, const Options& options, Figures& figures);

/// Prints what was collected, unless quiet: `file:line:column: warning: ...`.
void print_warnings(const Diagnostics& diagnostics, Verbosity verbosity);

} // namespace cl::demo
