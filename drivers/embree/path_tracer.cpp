#include "drivers/embree/path_tracer.h"

#include "drivers/embree/warp.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cl::embree {

namespace {

constexpr int kSureVertices = 4;           // surfaces before the roulette begins
constexpr float kLeastSurvival = 0.05f;    // bounds the weight of survivors
constexpr float kMostSurvival = 0.95f;     // even white rooms let paths end
constexpr float kShortOfEmitter = 0.9999f; // of the way to a point on an emitter, which is not in its own way

/// A seed of its own for each ray that leaves a vertex.
enum class RayUse : uint32_t { Bounce, Emitter, Sky, FirstLamp };
uint32_t seed_of(const Sampler& sampler, int vertex, RayUse use, uint32_t index = 0) noexcept {
    return pcg3d({sampler.ray_seed(vertex), static_cast<uint32_t>(use), index}).x;
}

float largest(const glm::vec3& v) noexcept {
    return std::max({v.x, v.y, v.z});
}

/// Reflectance of what is around, with the material's own occlusion.
Scattering scattering_of(const SurfacePoint& at, Scattering s) noexcept {
    s.diffuse *= at.occlusion;
    s.specular *= at.occlusion_lamp;
    return s;
}

bool takes_ambient(const SurfacePoint& at) noexcept {
    return !at.item->material.desc().disable_ambient_light;
}

} // namespace

glm::vec3 PathTracer::trace(const glm::ivec2& pixel, const Sampler& sampler) {
    const CameraRays::CameraRay camera =
        scene_.camera().ray(glm::vec2(pixel) + sampler.pair(0, Choice::Pixel));
    Path path;
    path.ray = camera.ray;
    path.from_diffuse = glm::vec3(1.0f);
    glm::vec3 radiance(0.0f);
    for (int vertex = 0;; ++vertex) {
        const RayKind kind = vertex == 0 ? RayKind::Camera : RayKind::Path;
        ++rays_;
        const std::optional<Hit> hit =
            scene_.rays().first_hit(path.ray, kind, seed_of(sampler, vertex, RayUse::Bounce));
        if (!hit) {
            return radiance +
                   (vertex == 0 ? scene_.environment().background(camera.sky_direction) : leave(path));
        }
        const SurfacePoint at = surface_point(scene_.items()[hit->item], *hit, path.ray.direction);
        if (at.emission != glm::vec3(0.0f)) {
            radiance +=
                path.throughput() * at.emission * (vertex == 0 ? 1.0f : emission_weight(path, at, *hit));
        }
        if (vertex >= options_.depth || at.item->material.desc().unshaded) {
            return radiance;
        }
        radiance +=
            path.throughput() * (light_of_lamps(at, sampler, vertex) +
                                 light_of_emitters(at, sampler, vertex) + light_of_sky(at, sampler, vertex));
        if (!reflect(at, sampler, vertex, path)) {
            return radiance;
        }
    }
}

glm::vec3 PathTracer::leave(const Path& path) const {
    if (!path.sees_sky) {
        return glm::vec3(0.0f);
    }
    const Environment& environment = scene_.environment();
    const float weight = weight_of_bounce(path.pdf, environment.pdf(path.ray.direction));
    return weight * (path.from_diffuse * environment.ambient(path.ray.direction) +
                     path.from_specular * environment.reflected(path.ray.direction));
}

float PathTracer::emission_weight(const Path& path, const SurfacePoint& at, const Hit& hit) const {
    const float pdf_area = scene_.emitters().pdf_area(hit.item, hit.triangle);
    const glm::vec3 way = at.position - path.ray.origin;
    const float cosine = glm::dot(at.geometric_normal, at.to_eye);
    return weight_of_bounce(path.pdf, solid_angle_pdf(pdf_area, glm::dot(way, way), cosine));
}

glm::vec3 PathTracer::light_of_lamps(const SurfacePoint& at, const Sampler& sampler, int vertex) {
    glm::vec3 sum(0.0f);
    const bool receives_shadows = !at.item->material.desc().do_not_receive_shadows;
    for (uint32_t i = 0; i < scene_.lamps().size(); ++i) {
        const Lamp& lamp = scene_.lamps()[i];
        const std::optional<Lamp::Arrival> arrival = lamp.arrival(at);
        if (!arrival) {
            continue;
        }
        glm::vec3 light = reflect_lamp(at, *arrival, lamp.specular());
        light *= vertex == 0 ? 1.0f : lamp.bounce_factor();
        if (light == glm::vec3(0.0f)) {
            continue;
        }
        if (lamp.casts_shadow() && receives_shadows) {
            const Ray ray{at.start_of(at.geometric_normal), arrival->to_lamp, 0.0f, arrival->distance_m};
            const bool hides_itself =
                !at.is_outside(arrival->to_lamp) && at.item->casting != ShadowCasting::Off;
            if (hides_itself ||
                is_blocked(ray, RayKind::Shadow, seed_of(sampler, vertex, RayUse::FirstLamp, i))) {
                light *= lamp.shadow_color();
            }
        }
        sum += light;
    }
    return sum;
}

glm::vec3 PathTracer::light_of_emitters(const SurfacePoint& at, const Sampler& sampler, int vertex) {
    if (options_.light_search == LightSearch::ByBounces || scene_.emitters().empty()) {
        return glm::vec3(0.0f);
    }
    const std::optional<Emitters::Point> point = scene_.emitters().sample(
        sampler.pair(vertex, Choice::EmitterTriangle).x, sampler.pair(vertex, Choice::EmitterPoint));
    const glm::vec3 start = at.start_of(at.geometric_normal);
    const glm::vec3 way = point->position - start;
    const float distance2 = glm::dot(way, way);
    if (!(distance2 > 0.0f)) {
        return glm::vec3(0.0f);
    }
    const Ray ray{start, way / std::sqrt(distance2), 0.0f, std::sqrt(distance2) * kShortOfEmitter};
    const float cosine = -glm::dot(point->front_normal, ray.direction);
    const TracedItem& emitter = scene_.items()[point->item];
    if (!emitter.shows(cosine > 0.0f) || !at.is_outside(ray.direction)) {
        return glm::vec3(0.0f);
    }
    const float pdf = solid_angle_pdf(point->pdf_area, distance2, std::abs(cosine));
    const Scattering s = scattering_of(at, evaluate_bsdf(at.bsdf, at.to_eye, ray.direction));
    const glm::vec3 arriving =
        emitter.material.emission(point->coordinates) * emitter.material.opacity(point->coordinates);
    const glm::vec3 light = s.sum() * arriving;
    if (!(pdf > 0.0f) || light == glm::vec3(0.0f) ||
        is_blocked(ray, RayKind::Path, seed_of(sampler, vertex, RayUse::Emitter))) {
        return glm::vec3(0.0f);
    }
    return light * (weight_of_search(pdf, s.pdf) / pdf);
}

glm::vec3 PathTracer::light_of_sky(const SurfacePoint& at, const Sampler& sampler, int vertex) {
    const Environment& environment = scene_.environment();
    if (options_.light_search == LightSearch::ByBounces || !environment.has_bright_parts() ||
        !takes_ambient(at)) {
        return glm::vec3(0.0f);
    }
    const SkyPanorama::Sample sky = environment.sample(sampler.pair(vertex, Choice::Sky));
    if (!(sky.pdf > 0.0f) || !at.is_outside(sky.direction)) {
        return glm::vec3(0.0f);
    }
    const Scattering s = scattering_of(at, evaluate_bsdf(at.bsdf, at.to_eye, sky.direction));
    const glm::vec3 light =
        s.diffuse * environment.ambient(sky.direction) + s.specular * environment.reflected(sky.direction);
    const Ray ray{at.start_of(at.geometric_normal), sky.direction};
    if (light == glm::vec3(0.0f) || is_blocked(ray, RayKind::Path, seed_of(sampler, vertex, RayUse::Sky))) {
        return glm::vec3(0.0f);
    }
    return light * (weight_of_search(sky.pdf, s.pdf) / sky.pdf);
}

bool PathTracer::reflect(const SurfacePoint& at, const Sampler& sampler, int vertex, Path& path) const {
    const glm::vec2 chance = sampler.pair(vertex, Choice::Lobe);
    const std::optional<ScatteredDirection> next =
        sample_bsdf(at.bsdf, at.to_eye, chance.x, sampler.pair(vertex, Choice::Direction));
    if (!next || !at.is_outside(next->direction)) {
        return false;
    }
    const Scattering s = scattering_of(at, next->scattering);
    const glm::vec3 throughput = path.throughput() / s.pdf;
    path.from_diffuse = throughput * s.diffuse;
    path.from_specular = throughput * s.specular;
    path.pdf = s.pdf;
    path.sees_sky = takes_ambient(at);
    path.ray = Ray{at.start_of(at.geometric_normal), next->direction};
    if (vertex + 1 < kSureVertices) {
        return true;
    }
    const float survival = std::clamp(largest(path.throughput()), kLeastSurvival, kMostSurvival);
    path.from_diffuse /= survival;
    path.from_specular /= survival;
    return chance.y < survival;
}

bool PathTracer::is_blocked(const Ray& ray, RayKind kind, uint32_t seed) {
    ++rays_;
    return scene_.rays().is_blocked(ray, kind, seed);
}

float PathTracer::weight_of_search(float pdf, float pdf_bounce) const noexcept {
    return options_.light_search == LightSearch::ByEmitters ? 1.0f : power_heuristic(pdf, pdf_bounce);
}

float PathTracer::weight_of_bounce(float pdf_bounce, float pdf_search) const noexcept {
    if (pdf_search <= 0.0f || options_.light_search == LightSearch::ByBounces) {
        return 1.0f;
    }
    return options_.light_search == LightSearch::ByEmitters ? 0.0f : power_heuristic(pdf_bounce, pdf_search);
}

} // namespace cl::embree
