// VisualServer: viewports.
#include "servers/visual_server.h"
#include "servers/visual_server_impl.h"

namespace cl {

RID VisualServer::viewport_create(glm::ivec2 size, bool to_window) {
    Viewport viewport;
    viewport.size = size;
    viewport.to_window = to_window;
    return edit().viewports.make(viewport);
}

Status VisualServer::viewport_set_size(RID rid, glm::ivec2 size) {
    Viewport* viewport = edit().viewports.get(rid);
    if (!viewport) {
        return edit().stale.refuse("viewport_set_size", "a viewport", rid);
    }
    viewport->size = size;
    return {};
}

Status VisualServer::viewport_set_scenario(RID rid, RID scenario) {
    Viewport* viewport = edit().viewports.get(rid);
    if (!viewport) {
        return edit().stale.refuse("viewport_set_scenario", "a viewport", rid);
    }
    if (scenario && !edit().instances.scenario(scenario)) {
        return edit().stale.refuse("viewport_set_scenario", "a scenario", scenario);
    }
    viewport->scenario = scenario;
    return {};
}

Status VisualServer::viewport_set_camera(RID rid, RID camera) {
    Viewport* viewport = edit().viewports.get(rid);
    if (!viewport) {
        return edit().stale.refuse("viewport_set_camera", "a viewport", rid);
    }
    if (Status live = edit().check_or_null("viewport_set_camera", "a camera", camera, edit().storage.cameras);
        !live) {
        return live;
    }
    viewport->camera = camera;
    return {};
}

Expected<Image> VisualServer::viewport_read(RID rid, TargetFormat format) {
    const Viewport* viewport = impl_->viewports.get(rid);
    if (!viewport) {
        return impl_->stale.refuse("viewport_read", "a viewport", rid).error();
    }
    if (!viewport->drawn) {
        return Error{ErrorCode::InvalidArgument, "viewport_read: expected a viewport that was drawn", {}};
    }
    return impl_->rasterizer->target_read(viewport->target, format);
}

/// Gives a viewport off screen a target of its size.
Status VisualServer::Impl::ensure_target(Viewport& viewport) {
    if (viewport.to_window || viewport.target_size == viewport.size) {
        return {};
    }
    if (viewport.target) {
        static_cast<void>(
            rasterizer->free(viewport.target)); // a backend that lost it has nothing left to free
    }
    viewport.target = {};
    viewport.target_size = {};
    viewport.drawn = false;
    Expected<RID> target = rasterizer->target_create(viewport.size);
    if (!target) {
        return target.error();
    }
    viewport.target = *target;
    viewport.target_size = viewport.size;
    return {};
}

Status VisualServer::Impl::draw_viewport(Viewport& viewport) {
    if (viewport.size.x <= 0 || viewport.size.y <= 0) {
        return {};
    }
    if (Status ready = ensure_target(viewport); !ready) {
        return ready;
    }
    FirstError errors;
    const View view{.size = viewport.size,
                    .scenario = viewport.scenario,
                    .camera = viewport.camera,
                    .contents = rasterizer->frame_contents()};
    const Status drawn = rasterizer->draw(viewport.target, frames.build(view, settings, errors));
    viewport.drawn = viewport.drawn || drawn.ok();
    errors.note(drawn);
    const FrameStats stats = rasterizer->last_stats();
    frame_stats.draw_calls += stats.draw_calls;
    frame_stats.triangles += stats.triangles;
    frame_stats.gpu_ms += stats.gpu_ms;
    frame_stats.rays += stats.rays;
    return errors.status();
}

} // namespace cl
