#include "scene/io/inspect.h"

#include "demo/cli/commands.h"
#include "demo/cli/inspect_text.h"
#include "demo/cli/scene_loading.h"

#include <iostream>

namespace cl::demo {

namespace {

/// The running tree, instances resolved.
int show_tree(const Options& options) {
    Diagnostics diagnostics;
    Expected<LoadedScene> loaded = load_scene(options, diagnostics);
    if (!loaded) {
        return fail(loaded.error());
    }
    print_warnings(diagnostics, options.verbosity);
    std::cout << (options.as_json ? tree_json(*loaded->root) : tree_text(*loaded->root));
    return kDone;
}

} // namespace

int run_inspect(const Options& options) {
    if (options.tree) {
        return show_tree(options);
    }
    const Expected<scene::Inspection> inspection = scene::inspect_file(options.input);
    if (!inspection) {
        return fail(inspection.error());
    }
    std::cout << (options.as_json ? inspection_json(*inspection) : inspection_text(*inspection));
    return kDone;
}

} // namespace cl::demo
