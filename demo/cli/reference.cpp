#include "demo/cli/commands.h"
#include "demo/cli/figures.h"
#include "demo/cli/pictures.h"
#include "demo/cli/progress_bar.h"
#include "demo/cli/scene_camera.h"
#include "demo/cli/scene_loading.h"

#include "scene/3d/world.h"

#include "drivers/embree/rasterizer_embree.h"

#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include "core/io/log.h"
#include "core/threads.h"

#include <fmt/format.h>

namespace cl::demo {

namespace {

constexpr double kFrame_s = 1.0 / 60.0; // scripts run once before the picture, as before a render's

/// A tree whose server draws by path tracing.
std::unique_ptr<scene::SceneTree> make_tree(const Options& options, const scene::ProjectSettings& settings,
                                            ProgressBar& bar) {
    const embree::PathOptions paths{options.samples, options.depth, options.seed};
    auto rasterizer =
        std::make_unique<embree::RasterizerEmbree>(paths, [&bar](float share) { bar.show(share); });
    auto server = std::make_unique<VisualServer>(std::make_unique<RasterizerChecked>(std::move(rasterizer)));
    RenderSettings render_settings;
    render_settings.gi_mode = GIMode::Off;
    render_settings.clear_color = settings.default_clear_color;
    server->set_settings(render_settings);
    const glm::ivec2 size = options.size.value_or(settings.window_size);
    return std::make_unique<scene::SceneTree>(std::move(server), scene::ViewportOptions{size, false});
}

Status draw(scene::SceneTree& tree, std::unique_ptr<scene::Node> root, const Options& options) {
    scene::Node& scene_root = *root;
    if (Status shown = tree.set_scene(std::move(root)); !shown) {
        return shown;
    }
    if (Status chosen = choose_camera(tree, scene_root, options); !chosen) {
        return chosen;
    }
    tree.step(kFrame_s);
    return tree.draw();
}

Figures describe(scene::SceneTree& tree, const Options& options, double total_ms) {
    const ServerStats stats = tree.server()->stats();
    const RasterizerInfo info = tree.server()->rasterizer_info();
    Figures figures;
    figures.scene = options.input.filename().string();
    figures.driver = info.driver;
    figures.renderer = info.api_version;
    figures.gi = "reference";
    figures.size = tree.world().viewport_size();
    figures.threads = thread_count();
    figures.frame_ms = stats.frame.gpu_ms;
    figures.total_ms = total_ms;
    figures.peak_rss_mib = peak_rss_mib();
    figures.draw_calls = stats.frame.draw_calls;
    figures.triangles = stats.frame.triangles;
    figures.lights = stats.lights;
    figures.paths = PathFigures{options.samples, options.depth, options.seed, stats.frame.rays,
                                stats.frame.gpu_ms * 1e-3};
    return figures;
}

} // namespace

int run_reference(const Options& options) {
    const Stopwatch total;
    if (const Status outputs = check_outputs(options.outputs); !outputs) {
        return fail(outputs.error(), kWrongCommand);
    }
    Diagnostics diagnostics;
    Expected<LoadedScene> loaded = load_scene(options, diagnostics);
    if (!loaded) {
        return fail(loaded.error());
    }
    print_warnings(diagnostics, options.verbosity);
    ProgressBar bar(fmt::format("tracing {} paths a pixel", options.samples), options.verbosity);
    const std::unique_ptr<scene::SceneTree> tree = make_tree(options, loaded->settings, bar);
    if (const Status drawn = draw(*tree, std::move(loaded->root), options); !drawn) {
        return fail(drawn.error());
    }
    bar.clear();
    if (const Status saved = save_pictures(*tree, options.outputs); !saved) {
        return fail(saved.error());
    }
    for (const std::filesystem::path& path : options.outputs) {
        log_info(fmt::format("{} ({:.0f} ms)", path.string(), total.elapsed_ms()));
    }
    if (options.stats_file.empty()) {
        return kDone;
    }
    Figures figures = describe(*tree, options, total.elapsed_ms());
    figures.load_ms = loaded->load_ms;
    figures.warnings = diagnostics.warnings().size();
    const Status written = write_json(to_json(figures), options.stats_file);
    return written ? kDone : fail(written.error());
}

} // namespace cl::demo
