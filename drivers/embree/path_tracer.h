#pragma once

#include "drivers/embree/sampler.h"
#include "drivers/embree/traced_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace cl::embree {

/// How light of surfaces and sky is found. All three agree in the mean; Mis has the least noise.
enum class LightSearch : uint8_t {
    Mis,        ///< both ways, weighted
    ByEmitters, ///< points on emitters and bright parts of the sky alone
    ByBounces,  ///< what the path runs into alone
};

struct PathOptions {
    int samples = 256; ///< paths a pixel
    int depth = 64; ///< most surfaces that light is reflected by on its way to the camera; 0: emission alone
    uint32_t seed = 0;
    LightSearch light_search = LightSearch::Mis;
};

/// Follows paths from the camera: at each surface the lamps (each tried, with a shadow ray), one point on an
/// emitter, one bright direction of the sky, and one reflected direction, in which the path goes on. Paths
/// end by Russian roulette, so that no light is lost on the mean. One tracer a thread. Source: Kajiya 1986;
/// PBRT 4th edition, section 14.5 (path tracer), with section 2.2.3's weights.
class PathTracer {
public:
    PathTracer(const TracedScene& scene, const PathOptions& options) : scene_(scene), options_(options) {}

    /// Radiance along one path through a pixel; linear. @param pixel  its column and row
    [[nodiscard]] glm::vec3 trace(const glm::ivec2& pixel, const Sampler& sampler);
    /// Rays sent out so far.
    [[nodiscard]] int64_t rays() const noexcept { return rays_; }

private:
    /// What a path carries from one surface to the next.
    struct Path {
        Ray ray;
        glm::vec3 from_diffuse{0.0f}, from_specular{0.0f}; ///< throughput, by the lobe of the last reflection
        float pdf = 0.0f;                                  ///< of the ray's direction [1/sr]
        bool sees_sky = true;                              ///< false: the last surface takes no ambient light
        [[nodiscard]] glm::vec3 throughput() const noexcept { return from_diffuse + from_specular; }
    };
    [[nodiscard]] glm::vec3 leave(const Path& path) const;
    [[nodiscard]] float emission_weight(const Path& path, const SurfacePoint& at, const Hit& hit) const;
    [[nodiscard]] glm::vec3 light_of_lamps(const SurfacePoint& at, const Sampler& sampler, int vertex);
    [[nodiscard]] glm::vec3 light_of_emitters(const SurfacePoint& at, const Sampler& sampler, int vertex);
    [[nodiscard]] glm::vec3 light_of_sky(const SurfacePoint& at, const Sampler& sampler, int vertex);
    /// Turns the path into its next direction; false if it ends here.
    [[nodiscard]] bool reflect(const SurfacePoint& at, const Sampler& sampler, int vertex, Path& path) const;
    [[nodiscard]] bool is_blocked(const Ray& ray, RayKind kind, uint32_t seed);
    /// Weight of light found on an emitter or in the sky with density `pdf`.
    [[nodiscard]] float weight_of_search(float pdf, float pdf_bounce) const noexcept;
    /// Weight of light that the path ran into, which a search would have found with density `pdf_search`.
    [[nodiscard]] float weight_of_bounce(float pdf_bounce, float pdf_search) const noexcept;

    const TracedScene& scene_;
    const PathOptions& options_;
    int64_t rays_ = 0;
};

} // namespace cl::embree
