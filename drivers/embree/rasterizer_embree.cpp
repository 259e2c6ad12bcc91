#include "drivers/embree/rasterizer_embree.h"

#include "drivers/embree/mesh.h"
#include "drivers/embree/picture.h"
#include "drivers/embree/sky_panorama.h"
#include "drivers/embree/target.h"
#include "drivers/embree/texture.h"

#include "core/rid.h"

#include <embree3/rtcore.h>

#include <chrono>
#include <string>
#include <utility>

namespace cl::embree {

namespace {

/// A RID of one kind is refused by the owners of all others.
enum class RIDKind : uint32_t { Texture = 1, Mesh, Sky, Target };
constexpr uint32_t number(RIDKind kind) {
    return static_cast<uint32_t>(kind);
}

Error no_gi() {
    return {ErrorCode::Unsupported, "the path tracer takes no GI data: it follows light itself", {}};
}

} // namespace

struct RasterizerEmbree::Impl {
    PathOptions options;
    Progress progress;
    // Behind pointers: addresses in an owner are good only until the next make().
    RID_Owner<std::unique_ptr<Texture>> textures{number(RIDKind::Texture)};
    RID_Owner<TriangleMesh> meshes{number(RIDKind::Mesh)};
    RID_Owner<std::unique_ptr<SkyPanorama>> skies{number(RIDKind::Sky)};
    RID_Owner<Target> targets{number(RIDKind::Target)};
    FrameStats stats;

    SceneResources resources();
};

SceneResources RasterizerEmbree::Impl::resources() {
    const auto surface = [this](RID mesh, int index) -> std::shared_ptr<const TriangleSurface> {
        const TriangleMesh* found = meshes.get(mesh);
        const auto i = static_cast<size_t>(index);
        return found && i < found->surfaces.size() ? found->surfaces[i] : nullptr;
    };
    const auto texture = [this](RID rid) -> const Texture* {
        const auto* found = textures.get(rid);
        return found ? found->get() : nullptr;
    };
    const auto sky = [this](RID rid) -> const SkyPanorama* {
        const auto* found = skies.get(rid);
        return found ? found->get() : nullptr;
    };
    return {surface, texture, sky};
}

RasterizerEmbree::RasterizerEmbree(const PathOptions& options, Progress progress)
    : impl_(std::make_unique<Impl>()) {
    impl_->options = options;
    impl_->progress = std::move(progress);
}

RasterizerEmbree::~RasterizerEmbree() = default;

RasterizerInfo RasterizerEmbree::info() const {
    return {"embree", "path tracer", "Embree " RTC_VERSION_STRING};
}

Expected<RID> RasterizerEmbree::texture_create(const Image& image, const TextureParams& params,
                                               TextureColorSpace space) {
    return impl_->textures.make(std::make_unique<Texture>(image, params, space));
}

Expected<RID> RasterizerEmbree::mesh_create(std::span<const MeshSurface> surfaces) {
    Expected<TriangleMesh> mesh = triangulate(surfaces);
    if (!mesh) {
        return mesh.error();
    }
    return impl_->meshes.make(std::move(*mesh));
}

Expected<RID> RasterizerEmbree::sky_create(const SkyDesc& sky) {
    return impl_->skies.make(std::make_unique<SkyPanorama>(sky));
}

Expected<RID> RasterizerEmbree::gi_volume_create(const GIVolumeDesc&) {
    return no_gi();
}

Status RasterizerEmbree::gi_volume_upload(RID, int, glm::ivec3, glm::ivec3, std::span<const uint8_t>) {
    return no_gi();
}

Expected<RID> RasterizerEmbree::gi_field_create(const GIFieldDesc&) {
    return no_gi();
}

Status RasterizerEmbree::gi_field_upload(RID, std::span<const uint32_t>, std::span<const uint16_t>) {
    return no_gi();
}

Expected<RID> RasterizerEmbree::target_create(glm::ivec2 size) {
    Target target;
    target.size = size;
    target.radiance.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y), glm::vec3(0.0f));
    return impl_->targets.make(std::move(target));
}

Status RasterizerEmbree::free(RID rid) {
    const bool freed = impl_->textures.free(rid) || impl_->meshes.free(rid) || impl_->skies.free(rid) ||
                       impl_->targets.free(rid);
    return freed ? Status{}
                 : Error{ErrorCode::InvalidArgument, "free: expected a live RID, found a stale one", {}};
}

Status RasterizerEmbree::draw(RID rid, const Frame& frame) {
    const auto begin = std::chrono::steady_clock::now();
    Target* target = impl_->targets.get(rid);
    if (!target || target->size != frame.size) {
        return Error{ErrorCode::InvalidArgument, "draw: expected a live target of the frame's size", {}};
    }
    const Expected<std::unique_ptr<TracedScene>> scene = TracedScene::build(frame, impl_->resources());
    if (!scene) {
        return scene.error();
    }
    target->tone = frame.has_environment ? frame.environment : EnvironmentDesc{};
    impl_->stats = {};
    impl_->stats.rays = trace_picture(**scene, impl_->options, frame.size, target->radiance, impl_->progress);
    impl_->stats.draw_calls = static_cast<int>(frame.world.size());
    impl_->stats.triangles = (*scene)->triangle_count();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    impl_->stats.gpu_ms = took.count();
    return {};
}

Expected<Image> RasterizerEmbree::target_read(RID rid, TargetFormat format) {
    const Target* target = impl_->targets.get(rid);
    if (!target) {
        return Error{ErrorCode::InvalidArgument, "expected a live target, found a stale or foreign RID", {}};
    }
    return format == TargetFormat::LinearFloat ? radiance_image(*target) : shown_image(*target);
}

FrameStats RasterizerEmbree::last_stats() const {
    return impl_->stats;
}

} // namespace cl::embree
