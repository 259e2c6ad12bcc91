#include "servers/visual_server.h"

#include "servers/visual_server_impl.h"

#include "core/io/log.h"

namespace cl {

VisualServer::VisualServer(std::unique_ptr<Rasterizer> rasterizer)
    : impl_(std::make_unique<Impl>(std::move(rasterizer))) {}

VisualServer::~VisualServer() = default;

VisualServer::Impl& VisualServer::edit() {
    impl_->edited = true;
    return *impl_;
}

void VisualServer::set_settings(const RenderSettings& settings) {
    edit().settings = settings;
    impl_->fields.set_quality(settings.quality);
}
const RenderSettings& VisualServer::settings() const {
    return impl_->settings;
}
RasterizerInfo VisualServer::rasterizer_info() const {
    return impl_->rasterizer->info();
}
Rasterizer& VisualServer::rasterizer() {
    return *impl_->rasterizer;
}

bool VisualServer::Impl::lights_by_gi() const {
    return settings.gi_mode != GIMode::Off && rasterizer->frame_contents() != FrameContents::WholeScene;
}

/// Each way of finding indirect light keeps its own state, and only the one in use costs anything: none under
/// a rasteriser that follows light itself.
Status VisualServer::Impl::step_gi(Rest rest) {
    if (!lights_by_gi()) {
        return {};
    }
    return settings.gi_mode == GIMode::Auto ? fields.step(rest) : probes.step();
}

bool VisualServer::Impl::gi_is_settled() {
    if (!lights_by_gi()) {
        return true;
    }
    return settings.gi_mode == GIMode::Auto ? fields.is_settled() : probes.is_settled();
}

/// Light transport takes about as long as a driver takes to compile shaders, which it does when something is
/// drawn with them: so viewports are, out of turn and before they can show anything.
void VisualServer::Impl::compile_shaders_meanwhile() {
    if (!lights_by_gi() || settings.gi_mode != GIMode::Auto || !fields.is_starting()) {
        return;
    }
    viewports.for_each([this](RID, Viewport& viewport) {
        if (!viewport.drawn) {
            static_cast<void>(draw_viewport(viewport)); // what is wrong with it, draw() will tell
            viewport.drawn = false;
        }
    });
}

/// Where pixels are drawn on the CPU, light and picture share its cores: side by side each is late by chance,
/// one after the other all frames take the same time, and show light that is a frame younger. So new light is
/// waited for, no longer than the picture took; not at all where it will need more (beside a picture light
/// took up to twice its time), which then goes on beside the pictures to come.
Status VisualServer::Impl::let_light_come() {
    const bool is_auto = settings.gi_mode == GIMode::Auto;
    const double picture_ms = frame_stats.gpu_ms;
    const double last_light_ms = is_auto ? fields.relight_ms() : probes.relight_ms();
    if (!lights_by_gi() || !rasterizer->info().draws_on_cpu || last_light_ms > 2.0 * picture_ms ||
        !(is_auto ? fields.is_relighting() : !probes.is_settled()) || !worker.wait_for(picture_ms)) {
        return {};
    }
    return is_auto ? fields.take_in() : probes.step();
}

Status VisualServer::draw() {
    FirstError errors;
    bool to_window = false;
    impl_->instances.update();
    impl_->frame_stats = {};
    impl_->edited = false;
    impl_->drawn_uploads = impl_->gi_uploads();
    impl_->viewports.for_each([&](RID, Viewport& viewport) {
        errors.note(impl_->draw_viewport(viewport));
        to_window = to_window || viewport.to_window;
    });
    errors.note(impl_->step_gi(Rest::AfterSteps));
    errors.note(impl_->let_light_come());
    if (to_window) {
        impl_->rasterizer->present();
    }
    return errors.status();
}

void VisualServer::settle() {
    // Set up and light, upload, find nothing: three rounds, and one more for data that changed on the way.
    constexpr int kMaxRounds = 16;
    for (int round = 0; round < kMaxRounds; ++round) {
        impl_->instances.update();
        if (const Status stepped = impl_->step_gi(Rest::AtOnce); !stepped) {
            log_error(stepped.error().message);
        }
        if (impl_->gi_is_settled()) {
            return;
        }
        impl_->compile_shaders_meanwhile();
        impl_->worker.wait();
    }
    log_warning("GI probes did not come to rest");
}

bool VisualServer::is_settled() {
    impl_->instances.update();
    return impl_->gi_is_settled();
}

bool VisualServer::has_changed() {
    return impl_->edited || impl_->drawn_uploads != impl_->gi_uploads() || !is_settled();
}

ServerStats VisualServer::stats() const {
    ServerStats stats;
    stats.frame = impl_->frame_stats;
    const bool is_auto = impl_->settings.gi_mode == GIMode::Auto;
    stats.relight_ms = is_auto ? impl_->fields.relight_ms() : impl_->probes.relight_ms();
    stats.upload_ms = is_auto ? impl_->fields.upload_ms() : impl_->probes.upload_ms();
    stats.transport_ms = impl_->fields.bake_ms();
    impl_->instances.for_each([&stats](RID, const Instance& instance) {
        const bool light =
            instance.kind == InstanceKind::DirectionalLight || instance.kind == InstanceKind::LocalLight;
        stats.lights += instance.scenario && light && instance.visible ? 1 : 0;
        stats.instances += instance.scenario && instance.kind == InstanceKind::Mesh ? 1 : 0;
    });
    return stats;
}

Status VisualServer::free(RID rid) {
    Impl& impl = edit();
    Storage& storage = impl.storage;
    if (storage.textures.free(rid)) {
        storage.materials.forget_resolved();
        return {};
    }
    if (storage.meshes.get(rid) || storage.lights.owns(rid) || storage.gi_probes.owns(rid)) {
        impl.instances.base_freed(rid);
    }
    if (Viewport* viewport = impl.viewports.get(rid)) {
        const RID target = viewport->target;
        impl.viewports.free(rid);
        return target ? impl.rasterizer->free(target) : Status{};
    }
    const bool freed = storage.materials.free(rid) || storage.meshes.free(rid) || storage.lights.free(rid) ||
                       storage.skies.free(rid) || storage.environments.free(rid) ||
                       storage.cameras.free(rid) || storage.gi_probes.free(rid) ||
                       impl.instances.free_scenario(rid) || impl.instances.free(rid);
    return freed ? Status{} : impl.stale.refuse("free", "a live RID", rid);
}

} // namespace cl
