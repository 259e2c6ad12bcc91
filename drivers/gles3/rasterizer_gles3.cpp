#include "drivers/gles3/rasterizer_gles3.h"

#include "drivers/gles3/frame_block.h"
#include "drivers/gles3/gi_field_storage.h"
#include "drivers/gles3/gi_volume_storage.h"
#include "drivers/gles3/gl/state.h"
#include "drivers/gles3/mesh_storage.h"
#include "drivers/gles3/passes/cone_pass.h"
#include "drivers/gles3/passes/depth_pass.h"
#include "drivers/gles3/passes/directional_shadow_pass.h"
#include "drivers/gles3/passes/local_shadow_pass.h"
#include "drivers/gles3/passes/scene_draws.h"
#include "drivers/gles3/passes/scene_pass.h"
#include "drivers/gles3/passes/sky_pass.h"
#include "drivers/gles3/passes/tone_map_pass.h"
#include "drivers/gles3/sky_storage.h"
#include "drivers/gles3/target_storage.h"
#include "drivers/gles3/texture_storage.h"

#include "servers/cones/gather.h"

#include <chrono>
#include <string>
#include <utility>

namespace cl::gles3 {

namespace {

/// Shading twice costs more than drawing depth twice as soon as cones are traced.
Prepass prepass_for(const Frame& frame, const RenderTarget& target, ConePath cones) noexcept {
    if (frame.gi_mode == GIMode::Off || frame.gi_probes.empty()) {
        return Prepass::None;
    }
    const bool gathers =
        cones == ConePath::Gathered && frame.gi_mode == GIMode::Cones && cone_buffers_fit(target);
    return gathers ? Prepass::Gathered : Prepass::Done;
}

/// The sky that lights the frame; nullptr if none does.
const StoredSky* lighting_sky(const Frame& frame, const SkyStorage& skies) noexcept {
    if (!frame.has_environment) {
        return nullptr;
    }
    const BackgroundMode mode = frame.environment.background_mode;
    const bool has_sky = mode == BackgroundMode::Sky || mode == BackgroundMode::ColorSky;
    return has_sky ? skies.get(frame.environment.sky) : nullptr;
}

} // namespace

/// Members are destroyed from the last to the first: GL objects, then their State, then the context.
struct RasterizerGLES3::Impl {
    std::unique_ptr<drivers::GLContext> context;
    std::unique_ptr<gl::State> state;
    ConePath cones; ///< Gathered or InShader
    TextureStorage textures;
    MeshStorage meshes;
    GIVolumeStorage volumes;
    GIFieldStorage fields;
    SkyStorage skies;
    TargetStorage targets;
    gl::VertexArray no_vertices;
    ScenePass scene_pass;
    CasterDraw casters{};
    LocalShadowPass local_shadows{};
    DirectionalShadowPass directional_shadows{};
    SceneDraws draws{};
    DepthPass depth_pass{};
    ConePass cone_pass{};
    SkyPass sky_pass{};
    ToneMapPass tone_map_pass{};
    FrameStats stats{};
    Prepass last_prepass = Prepass::None;
    int known_errors = 0;

    /// Directs GL here. Call before anything else.
    Status enter() {
        if (Status s = context->make_current(); !s) {
            return s;
        }
        state->make_current();
        return {};
    }
    /// What GL complained about since the last call, as an error.
    Status leave(const char* what) {
        const int errors = context->error_count();
        if (errors == std::exchange(known_errors, errors)) {
            return {};
        }
        return Error{ErrorCode::Unsupported,
                     std::string(what) + ": the graphics driver reported an error (see the log)"};
    }
    /// Runs f between enter() and leave(). f returns a Status or an Expected.
    template <typename F>
    auto guarded(const char* what, const F& f) -> decltype(f()) {
        if (Status s = enter(); !s) {
            return s.error();
        }
        auto result = f();
        if (Status s = leave(what); !s) {
            return s.error();
        }
        return result;
    }

    Status draw_frame(RenderTarget& target, const Frame& frame);
    Status draw_prepass(RenderTarget& target, const Frame& frame, const shaders::FrameBlock& frame_block,
                        const Resources& resources);
};

Status RasterizerGLES3::Impl::draw_prepass(RenderTarget& target, const Frame& frame,
                                           const shaders::FrameBlock& frame_block,
                                           const Resources& resources) {
    switch (last_prepass) {
    case Prepass::None:
        return {};
    case Prepass::Done:
        return depth_pass.draw(target, draws, resources);
    case Prepass::Gathered:
        break;
    }
    return cone_pass.draw(target, frame, frame_block, draws, resources);
}

Status RasterizerGLES3::Impl::draw_frame(RenderTarget& target, const Frame& frame) {
    const Resources resources{textures, meshes, volumes, fields, skies, no_vertices};
    const auto local = local_shadows.draw(frame, resources, casters);
    if (!local) {
        return local.error();
    }
    const auto directional = directional_shadows.draw(frame, resources, casters);
    if (!directional) {
        return directional.error();
    }
    const StoredSky* sky = lighting_sky(frame, skies);
    const shaders::FrameBlock frame_block = make_frame_block(frame, *directional);
    if (Status s = draws.prepare(frame, frame_block, *local, resources); !s) {
        return s;
    }
    last_prepass = prepass_for(frame, target, cones);
    if (Status s = draw_prepass(target, frame, frame_block, resources); !s) {
        return s;
    }
    const ScenePass::Inputs inputs{frame,
                                   frame_features(frame, sky != nullptr),
                                   draws,
                                   resources,
                                   local_shadows.atlas(),
                                   directional_shadows.map(),
                                   sky};
    if (Status s = scene_pass.draw_opaque(target, inputs, last_prepass, stats); !s) {
        return s;
    }
    if (sky && frame.environment.background_mode == BackgroundMode::Sky) {
        if (Status s = sky_pass.draw(target, frame, *sky, resources); !s) {
            return s;
        }
    }
    if (Status s = scene_pass.draw_transparent(target, inputs, stats); !s) {
        return s;
    }
    return tone_map_pass.draw(target, frame, resources);
}

RasterizerGLES3::RasterizerGLES3(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

RasterizerGLES3::~RasterizerGLES3() {
    // GL objects must be deleted in their own context.
    (void)impl_->enter();
}

Expected<std::unique_ptr<RasterizerGLES3>>
RasterizerGLES3::create(std::unique_ptr<drivers::GLContext> context, ConePath cone_path) {
    if (Status s = context->make_current(); !s) {
        return s.error();
    }
    auto state = std::make_unique<gl::State>();
    if (!state->capabilities().color_buffer_float) {
        return Error{ErrorCode::Unsupported, "the driver cannot draw to RGBA16F (EXT_color_buffer_float)"};
    }
    if (cone_path == ConePath::Best) {
        const bool gathers = state->capabilities().software && cones::can_gather();
        cone_path = gathers ? ConePath::Gathered : ConePath::InShader;
    }
    Expected<TextureStorage> textures = TextureStorage::create();
    if (!textures) {
        return textures.error();
    }
    Expected<GIVolumeStorage> volumes = GIVolumeStorage::create(cone_path);
    if (!volumes) {
        return volumes.error();
    }
    Expected<GIFieldStorage> fields = GIFieldStorage::create();
    if (!fields) {
        return fields.error();
    }
    Expected<SkyStorage> skies = SkyStorage::create();
    if (!skies) {
        return skies.error();
    }
    Expected<ScenePass> scene_pass = ScenePass::create();
    if (!scene_pass) {
        return scene_pass.error();
    }
    std::unique_ptr<Impl> impl(new Impl{std::move(context), std::move(state), cone_path, *std::move(textures),
                                        MeshStorage{}, *std::move(volumes), *std::move(fields),
                                        *std::move(skies), TargetStorage{}, gl::VertexArray::create_empty(),
                                        *std::move(scene_pass)});
    if (Status s = impl->leave("start"); !s) {
        return s.error();
    }
    return std::unique_ptr<RasterizerGLES3>(new RasterizerGLES3(std::move(impl)));
}

RasterizerInfo RasterizerGLES3::info() const {
    return {std::string(drivers::driver_name(impl_->context->kind())), impl_->context->renderer(),
            impl_->context->api_version(), impl_->state->capabilities().software};
}

Expected<RID> RasterizerGLES3::texture_create(const Image& image, const TextureParams& params,
                                              TextureColorSpace space) {
    return impl_->guarded("texture upload", [&] { return impl_->textures.create(image, params, space); });
}

Expected<RID> RasterizerGLES3::mesh_create(std::span<const MeshSurface> surfaces) {
    return impl_->guarded("mesh upload", [&] { return impl_->meshes.create(surfaces); });
}

Expected<RID> RasterizerGLES3::sky_create(const SkyDesc& sky) {
    return impl_->guarded("sky upload", [&] { return impl_->skies.create(sky); });
}

Expected<RID> RasterizerGLES3::gi_volume_create(const GIVolumeDesc& desc) {
    return impl_->guarded("GI volume", [&] { return impl_->volumes.create(desc); });
}

Status RasterizerGLES3::gi_volume_upload(RID volume, int mip, glm::ivec3 offset, glm::ivec3 size,
                                         std::span<const uint8_t> rgba8) {
    return impl_->guarded("GI volume upload",
                          [&] { return impl_->volumes.upload(volume, mip, offset, size, rgba8); });
}

Expected<RID> RasterizerGLES3::gi_field_create(const GIFieldDesc& desc) {
    return impl_->guarded("GI field", [&] { return impl_->fields.create(desc); });
}

Status RasterizerGLES3::gi_field_upload(RID field, std::span<const uint32_t> light,
                                        std::span<const uint16_t> air) {
    return impl_->guarded("GI field upload", [&] { return impl_->fields.upload(field, light, air); });
}

Expected<RID> RasterizerGLES3::target_create(glm::ivec2 size) {
    return impl_->guarded("render target", [&] { return impl_->targets.create(size); });
}

Status RasterizerGLES3::free(RID rid) {
    return impl_->guarded("free", [&]() -> Status {
        const bool freed = impl_->textures.free(rid) || impl_->meshes.free(rid) || impl_->skies.free(rid) ||
                           impl_->volumes.free(rid) || impl_->fields.free(rid) || impl_->targets.free(rid);
        return freed ? Status{}
                     : Error{ErrorCode::InvalidArgument, "free: expected a live RID, found a stale one"};
    });
}

Status RasterizerGLES3::draw(RID target, const Frame& frame) {
    return impl_->guarded("draw", [&]() -> Status {
        const auto begin = std::chrono::steady_clock::now();
        impl_->stats = {};
        RenderTarget* into = impl_->targets.get(target);
        if (!target) {
            const Expected<RenderTarget*> window = impl_->targets.window(frame.size);
            if (!window) {
                return window.error();
            }
            into = *window;
        }
        if (!into || into->size != frame.size) {
            return Error{ErrorCode::InvalidArgument, "draw: expected a live target of the frame's size"};
        }
        if (Status s = impl_->draw_frame(*into, frame); !s) {
            return s;
        }
        glFinish(); // so that the time is that of the pixels, not of the commands
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        impl_->stats.gpu_ms = took.count();
        return {};
    });
}

Expected<Image> RasterizerGLES3::target_read(RID target, TargetFormat format) {
    return impl_->guarded("read", [&] { return impl_->targets.read(target, format); });
}

FrameStats RasterizerGLES3::last_stats() const {
    return impl_->stats;
}

void RasterizerGLES3::present() {
    impl_->context->swap();
}

RendererCounters RasterizerGLES3::counters() const {
    return {impl_->scene_pass.variant_count(), impl_->casters.variant_count(),
            impl_->last_prepass != Prepass::None, impl_->last_prepass == Prepass::Gathered};
}

drivers::GLContext& RasterizerGLES3::context() noexcept {
    return *impl_->context;
}

} // namespace cl::gles3
