#include "demo/cli/stage.h"

#include "demo/cli/scene_camera.h"

#include "scene/3d/world.h"

#include "drivers/gl_context.h"
#include "drivers/gles3/rasterizer_gles3.h"

#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include "core/io/log.h"
#include "core/threads.h"

namespace cl::demo {

namespace {

Expected<std::unique_ptr<drivers::GLContext>> open_context(const Options& options, glm::ivec2 size) {
    if (options.driver.empty()) {
        return drivers::create_offscreen_context();
    }
    const Expected<drivers::DriverKind> kind = drivers::driver_from_name(options.driver);
    if (!kind) {
        return kind.error();
    }
    return drivers::create_context(*kind, {size, "Conelight"});
}

RenderSettings render_settings(const Options& options, const scene::ProjectSettings& settings) {
    RenderSettings s;
    s.gi_mode = options.gi_mode;
    s.quality = options.quality;
    s.clear_color = settings.default_clear_color;
    s.shadow_filter = settings.shadow_filter_mode;
    s.shadow_atlas_size = settings.shadow_atlas_size;
    s.directional_shadow_size = settings.directional_shadow_size;
    return s;
}

} // namespace

struct Stage::Impl {
    gles3::RasterizerGLES3* rasterizer = nullptr; // owned by the server
    std::unique_ptr<scene::SceneTree> tree;
    RenderSettings settings;
};

Stage::Stage() : impl_(std::make_unique<Impl>()) {}
Stage::~Stage() = default;

Expected<std::unique_ptr<Stage>> Stage::open(const Options& options, const scene::ProjectSettings& settings) {
    const glm::ivec2 size = options.size.value_or(settings.window_size);
    Expected<std::unique_ptr<drivers::GLContext>> context = open_context(options, size);
    if (!context) {
        return context.error();
    }
    Expected<std::unique_ptr<gles3::RasterizerGLES3>> rasterizer =
        gles3::RasterizerGLES3::create(std::move(*context));
    if (!rasterizer) {
        return rasterizer.error();
    }
    std::unique_ptr<Stage> stage(new Stage());
    stage->impl_->rasterizer = rasterizer->get();
    auto server = std::make_unique<VisualServer>(std::make_unique<RasterizerChecked>(std::move(*rasterizer)));
    stage->impl_->settings = render_settings(options, settings);
    server->set_settings(stage->impl_->settings);
    const bool to_window = stage->window() != nullptr;
    stage->impl_->tree =
        std::make_unique<scene::SceneTree>(std::move(server), scene::ViewportOptions{size, to_window});
    return stage;
}

Status Stage::show(std::unique_ptr<scene::Node> root, const Options& options) {
    scene::Node& scene_root = *root;
    if (Status shown = tree().set_scene(std::move(root)); !shown) {
        return shown;
    }
    return choose_camera(tree(), scene_root, options);
}

scene::SceneTree& Stage::tree() noexcept {
    return *impl_->tree;
}
VisualServer& Stage::server() noexcept {
    return *impl_->tree->server();
}
drivers::Window* Stage::window() noexcept {
    return impl_->rasterizer->context().window();
}
glm::ivec2 Stage::window_size() const {
    return impl_->rasterizer->context().size();
}
void Stage::present() {
    impl_->rasterizer->present();
}

void Stage::set_gi_mode(GIMode mode) {
    impl_->settings.gi_mode = mode;
    server().set_settings(impl_->settings);
}

void Stage::describe(Figures& figures) {
    const ServerStats stats = server().stats();
    const RasterizerInfo info = server().rasterizer_info();
    figures.driver = info.driver;
    figures.renderer = info.renderer;
    figures.size = tree().world().viewport_size();
    figures.threads = thread_count();
    figures.peak_rss_mib = peak_rss_mib();
    figures.draw_calls = stats.frame.draw_calls;
    figures.triangles = stats.frame.triangles;
    figures.lights = stats.lights;
    if (!figures.probes.empty()) {
        figures.relight_ms = stats.relight_ms;
        figures.upload_ms = stats.upload_ms;
        if (impl_->settings.gi_mode == GIMode::Auto && stats.transport_ms > 0.0) {
            figures.bake_ms = figures.bake_ms.value_or(0.0) + stats.transport_ms;
        }
    }
}

std::string gi_name(GIMode mode) {
    switch (mode) {
    case GIMode::Off:
        return "off";
    case GIMode::Cones:
        return "cones";
    case GIMode::Auto:
        return "auto";
    }
    return "off";
}

} // namespace cl::demo
