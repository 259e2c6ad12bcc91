#include "servers/radiosity/ray_scene.h"

#include "core/math/traceable.h"

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace cl::radiosity {

struct RayScene::Impl {
    const StillScene* scene = nullptr;
    std::vector<glm::vec3> normals; ///< one a triangle
    RTCDevice device = nullptr;
    RTCScene bvh = nullptr;

    [[nodiscard]] bool is_front(uint32_t triangle, const glm::vec3& direction) const noexcept {
        const Surface& surface = scene->surfaces[scene->surface_of[triangle]];
        return surface.two_sided || glm::dot(normals[triangle], direction) < 0.0f;
    }
    void trace(RTCIntersectContext& context, std::span<const Ray> rays, std::span<Hit> hits) const noexcept;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (bvh) {
            rtcReleaseScene(bvh);
        }
        if (device) {
            rtcReleaseDevice(device);
        }
    }
};

namespace {

constexpr size_t kBatch = 64;

/// Lets rays through the holes of cut-out surfaces. Called by Embree for a packet of candidate hits.
void pass_holes(const RTCFilterFunctionNArguments* args) {
    const auto& scene = *static_cast<const StillScene*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) {
            continue;
        }
        const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
        const glm::vec2 at(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
        if (scene.is_hole(triangle, at)) {
            args->valid[i] = 0;
        }
    }
}

/// What trace_side() hands to its filter.
struct SideContext {
    RTCIntersectContext embree; // first: Embree knows this part
    const RayScene::Impl* impl;
    RayScene::Side side;
};

/// Lets rays through all but one side of surfaces.
void pass_other_side(const RTCFilterFunctionNArguments* args) {
    const SideContext& context = *reinterpret_cast<const SideContext*>(args->context);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) {
            continue;
        }
        const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
        const glm::vec3 direction(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                                  RTCRayN_dir_z(args->ray, args->N, i));
        if (context.impl->is_front(triangle, direction) != (context.side == RayScene::Side::Front)) {
            args->valid[i] = 0;
        }
    }
}

/// A ray that no library takes becomes one that ends before it begins: it meets nothing.
void fill(RTCRay& out, const Ray& asked) noexcept {
    constexpr Ray kNothing{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, -1.0f};
    const bool is_sound = is_traceable(asked.origin) && is_traceable(asked.direction) && asked.max_t >= 0.0f;
    const Ray& ray = is_sound ? asked : kNothing;
    out.org_x = ray.origin.x;
    out.org_y = ray.origin.y;
    out.org_z = ray.origin.z;
    out.tnear = 0.0f;
    out.dir_x = ray.direction.x;
    out.dir_y = ray.direction.y;
    out.dir_z = ray.direction.z;
    out.time = 0.0f;
    out.tfar = ray.max_t;
    out.mask = 0xFFFFFFFFu;
    out.id = 0;
    out.flags = 0;
}

Error library_error(RTCDevice device) {
    const RTCError code = rtcGetDeviceError(device);
    return Error{code == RTC_ERROR_OUT_OF_MEMORY ? ErrorCode::OutOfMemory : ErrorCode::Unsupported,
                 "ray tracing: Embree reports error " + std::to_string(int(code))};
}

bool has_holes(const StillScene& scene) noexcept {
    return std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                       [](const Surface& s) { return s.alpha_cutoff > 0.0f && s.albedo_map; });
}

} // namespace

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Expected<RayScene> RayScene::create(const StillScene& scene) {
    auto impl = std::make_unique<Impl>();
    impl->scene = &scene;
    impl->device = rtcNewDevice(nullptr);
    if (!impl->device) {
        return library_error(nullptr);
    }
    impl->bvh = rtcNewScene(impl->device);
    rtcSetSceneFlags(impl->bvh,
                     RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    if (!scene.triangles.empty()) {
        RTCGeometry geometry = rtcNewGeometry(impl->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                 sizeof(glm::vec3), scene.positions.size());
        void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                sizeof(glm::uvec3), scene.triangles.size());
        if (!vertices || !indices) {
            rtcReleaseGeometry(geometry);
            return library_error(impl->device);
        }
        std::copy(scene.positions.begin(), scene.positions.end(), static_cast<glm::vec3*>(vertices));
        std::copy(scene.triangles.begin(), scene.triangles.end(), static_cast<glm::uvec3*>(indices));
        if (has_holes(scene)) {
            rtcSetGeometryUserData(geometry, const_cast<StillScene*>(&scene));
            rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
            rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(impl->bvh, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(impl->bvh);
    if (rtcGetDeviceError(impl->device) != RTC_ERROR_NONE) {
        return library_error(impl->device);
    }
    impl->normals.reserve(scene.triangles.size());
    for (uint32_t i = 0; i < scene.triangles.size(); ++i) {
        impl->normals.push_back(scene.normal(i));
    }
    return RayScene(std::move(impl));
}

const glm::vec3& RayScene::normal(uint32_t triangle) const noexcept {
    return impl_->normals[triangle];
}

void RayScene::trace(std::span<const Ray> rays, std::span<Hit> hits) const noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    impl_->trace(context, rays, hits);
}

void RayScene::trace_side(Side side, std::span<const Ray> rays, std::span<Hit> hits) const noexcept {
    SideContext context{{}, impl_.get(), side};
    rtcInitIntersectContext(&context.embree);
    context.embree.filter = pass_other_side;
    impl_->trace(context.embree, rays, hits);
}

void RayScene::Impl::trace(RTCIntersectContext& context, std::span<const Ray> rays,
                           std::span<Hit> hits) const noexcept {
    std::array<RTCRayHit, kBatch> batch;
    for (size_t begin = 0; begin < rays.size(); begin += kBatch) {
        const size_t count = std::min(kBatch, rays.size() - begin);
        for (size_t i = 0; i < count; ++i) {
            fill(batch[i].ray, rays[begin + i]);
            batch[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
            batch[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect1M(bvh, &context, batch.data(), unsigned(count), sizeof(RTCRayHit));
        for (size_t i = 0; i < count; ++i) {
            const RTCRayHit& got = batch[i];
            Hit& hit = hits[begin + i];
            hit = {};
            if (got.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
                continue;
            }
            hit.triangle = got.hit.primID;
            hit.t = got.ray.tfar;
            hit.barycentric = {got.hit.u, got.hit.v};
            hit.is_front = is_front(hit.triangle, rays[begin + i].direction);
        }
    }
}

bool RayScene::is_blocked(const Ray& ray) const noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r;
    fill(r, ray);
    rtcOccluded1(impl_->bvh, &context, &r);
    return r.tfar == -INFINITY; // Embree's sign for a hit
}

void RayScene::find_blocked(std::span<const Ray> rays, std::span<uint8_t> blocked) const noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    std::array<RTCRay, kBatch> batch;
    for (size_t begin = 0; begin < rays.size(); begin += kBatch) {
        const size_t count = std::min(kBatch, rays.size() - begin);
        for (size_t i = 0; i < count; ++i) {
            fill(batch[i], rays[begin + i]);
        }
        rtcOccluded1M(impl_->bvh, &context, batch.data(), unsigned(count), sizeof(RTCRay));
        for (size_t i = 0; i < count; ++i) {
            blocked[begin + i] = batch[i].tfar == -INFINITY;
        }
    }
}

} // namespace cl::radiosity
