#include "drivers/embree/ray_scene.h"

#include "drivers/embree/sampler.h"

#include "core/math/traceable.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace cl::embree {

namespace {

/// What the filter must know of the ray beyond Embree's own.
struct Query {
    RTCIntersectContext context; // first: Embree hands back a pointer to it
    RayKind kind;
    uint32_t seed;
    uint32_t camera_mask;
};

Query make_query(RayKind kind, uint32_t seed, uint32_t camera_mask) noexcept {
    Query query{{}, kind, seed, camera_mask};
    rtcInitIntersectContext(&query.context);
    return query;
}

bool is_there_for(const TracedItem& item, const Query& query) noexcept {
    switch (query.kind) {
    case RayKind::Camera:
        return item.casting != ShadowCasting::ShadowsOnly && (item.layers & query.camera_mask) != 0;
    case RayKind::Path:
        return item.casting != ShadowCasting::ShadowsOnly;
    case RayKind::Shadow:
        return item.casting != ShadowCasting::Off;
    }
    return true;
}

/// Embree's normals lie where triangles run counter-clockwise.
bool is_front(const TracedItem& item, float normal_dot_direction) noexcept {
    return (normal_dot_direction > 0.0f) != item.mirrored;
}

/// Whether a ray meets a triangle that lies in its way.
bool meets(const TracedItem& item, const Query& query, bool front, uint32_t geometry, uint32_t triangle,
           const glm::vec2& barycentric) noexcept {
    const bool both_sides = query.kind == RayKind::Shadow && item.casting == ShadowCasting::DoubleSided;
    // A shadow ray runs against the light, which a caster's culled side lets pass.
    const bool shown_side = query.kind == RayKind::Shadow ? !front : front;
    if (!is_there_for(item, query) || !(both_sides || item.shows(shown_side))) {
        return false;
    }
    if (!item.material.has_holes()) {
        return true;
    }
    const float opacity = item.material.opacity(item.coordinates(triangle, barycentric));
    return unit_float(pcg3d({query.seed, geometry, triangle}).x) < opacity;
}

void filter(const RTCFilterFunctionNArguments* args) {
    const TracedItem& item = *static_cast<const TracedItem*>(args->geometryUserPtr);
    const Query& query = *reinterpret_cast<const Query*>(args->context);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) {
            continue;
        }
        const glm::vec3 direction(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                                  RTCRayN_dir_z(args->ray, args->N, i));
        const glm::vec3 normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
                               RTCHitN_Ng_z(args->hit, args->N, i));
        const glm::vec2 at(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
        const float facing = normal.x * direction.x + normal.y * direction.y + normal.z * direction.z;
        if (!meets(item, query, is_front(item, facing), RTCHitN_geomID(args->hit, args->N, i),
                   RTCHitN_primID(args->hit, args->N, i), at)) {
            args->valid[i] = 0;
        }
    }
}

/// Items that every ray meets on every side need no filter, which costs a call a triangle.
bool needs_filter(const TracedItem& item, uint32_t camera_mask) noexcept {
    return item.material.desc().cull_mode != CullMode::Disabled || item.material.has_holes() ||
           (item.casting != ShadowCasting::On && item.casting != ShadowCasting::DoubleSided) ||
           (item.layers & camera_mask) == 0;
}

Error embree_error(RTCError code) {
    return {code == RTC_ERROR_OUT_OF_MEMORY ? ErrorCode::OutOfMemory : ErrorCode::Unsupported,
            fmt::format("Embree: error {} while the scene was prepared", static_cast<int>(code)),
            {}};
}

/// Adds an item; its geometry number is its place among the items. False if Embree has no memory for it.
bool attach(RTCDevice device, RTCScene scene, const TracedItem& item, uint32_t number, uint32_t camera_mask) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto& triangles = item.surface->triangles;
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), item.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(glm::uvec3), triangles.size());
    if (!vertices || !indices) {
        rtcReleaseGeometry(geometry);
        return false;
    }
    std::memcpy(vertices, item.positions.data(), item.positions.size() * sizeof(glm::vec3));
    std::memcpy(indices, triangles.data(), triangles.size() * sizeof(glm::uvec3));
    rtcSetGeometryUserData(geometry, const_cast<TracedItem*>(&item)); // C has one pointer for both; only read
    if (needs_filter(item, camera_mask)) {
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, number);
    rtcReleaseGeometry(geometry);
    return true;
}

/// A ray that Embree does not take becomes one that ends before it begins: it meets nothing.
RTCRay to_embree(const Ray& asked) noexcept {
    constexpr Ray kNothing{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.0f, -1.0f};
    const bool is_sound = is_traceable(asked.origin) && is_traceable(asked.direction) &&
                          asked.near_m >= 0.0f && asked.far_m >= 0.0f;
    const Ray& ray = is_sound ? asked : kNothing;
    RTCRay r{};
    r.org_x = ray.origin.x;
    r.org_y = ray.origin.y;
    r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x;
    r.dir_y = ray.direction.y;
    r.dir_z = ray.direction.z;
    r.tnear = ray.near_m;
    r.tfar = ray.far_m;
    r.mask = 0xFFFFFFFFu;
    return r;
}

} // namespace

struct RayScene::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::span<const TracedItem> items;
    uint32_t camera_mask = 0xFFFFFFFFu;
    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (scene) {
            rtcReleaseScene(scene);
        }
        if (device) {
            rtcReleaseDevice(device);
        }
    }
};

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

Expected<RayScene> RayScene::build(std::span<const TracedItem> items, uint32_t camera_mask) {
    auto impl = std::make_unique<Impl>();
    impl->items = items;
    impl->camera_mask = camera_mask;
    impl->device = rtcNewDevice(nullptr);
    if (!impl->device) {
        return embree_error(rtcGetDeviceError(nullptr));
    }
    impl->scene = rtcNewScene(impl->device);
    rtcSetSceneFlags(impl->scene, RTC_SCENE_FLAG_ROBUST); // no ray slips through between two triangles
    rtcSetSceneBuildQuality(impl->scene, RTC_BUILD_QUALITY_MEDIUM);
    for (uint32_t i = 0; i < items.size(); ++i) {
        if (!items[i].surface->triangles.empty() &&
            !attach(impl->device, impl->scene, items[i], i, camera_mask)) {
            return embree_error(rtcGetDeviceError(impl->device));
        }
    }
    rtcCommitScene(impl->scene);
    if (const RTCError code = rtcGetDeviceError(impl->device); code != RTC_ERROR_NONE) {
        return embree_error(code);
    }
    return RayScene(std::move(impl));
}

std::optional<Hit> RayScene::first_hit(const Ray& ray, RayKind kind, uint32_t seed) const noexcept {
    Query query = make_query(kind, seed, impl_->camera_mask);
    RTCRayHit found{to_embree(ray), {}};
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->scene, &query.context, &found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    const float facing = found.hit.Ng_x * ray.direction.x + found.hit.Ng_y * ray.direction.y +
                         found.hit.Ng_z * ray.direction.z;
    return Hit{found.hit.geomID,
               found.hit.primID,
               {found.hit.u, found.hit.v},
               is_front(impl_->items[found.hit.geomID], facing)};
}

bool RayScene::is_blocked(const Ray& ray, RayKind kind, uint32_t seed) const noexcept {
    Query query = make_query(kind, seed, impl_->camera_mask);
    RTCRay embree_ray = to_embree(ray);
    rtcOccluded1(impl_->scene, &query.context, &embree_ray);
    return embree_ray.tfar == -INFINITY; // Embree's sign for a hit
}

glm::vec3 offset_point(const glm::vec3& point, const glm::vec3& normal) noexcept {
    constexpr float kNearOrigin_m = 1.0f / 32.0f, kFloatStep = 1.0f / 65536.0f, kIntStep = 256.0f;
    glm::vec3 moved;
    for (int i = 0; i < 3; ++i) {
        const auto step = static_cast<int32_t>(kIntStep * normal[i]);
        int32_t bits;
        std::memcpy(&bits, &point[i], sizeof(bits));
        bits += point[i] < 0.0f ? -step : step;
        float far;
        std::memcpy(&far, &bits, sizeof(far));
        moved[i] = std::abs(point[i]) < kNearOrigin_m ? point[i] + kFloatStep * normal[i] : far;
    }
    return moved;
}

} // namespace cl::embree
