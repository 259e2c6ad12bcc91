#include "drivers/embree/picture.h"

#include "core/threads.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace cl::embree {

namespace {

constexpr int kTileEdge = 16; // [pixels]: neighbours meet the same parts of the scene

bool is_finite(const glm::vec3& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::vec3 trace_pixel(PathTracer& tracer, const PathOptions& options, const glm::ivec2& pixel,
                      uint32_t index) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < options.samples; ++i) {
        const glm::vec3 sample = tracer.trace(pixel, Sampler(options.seed, index, static_cast<uint32_t>(i)));
        if (is_finite(sample)) { // numbers at the end of the world must not spoil a pixel
            sum += glm::dvec3(sample);
        }
    }
    return glm::vec3(sum / static_cast<double>(options.samples));
}

} // namespace

int64_t trace_picture(const TracedScene& scene, const PathOptions& options, glm::ivec2 size,
                      std::vector<glm::vec3>& radiance, const std::function<void(float)>& progress) {
    radiance.assign(static_cast<size_t>(size.x) * static_cast<size_t>(size.y), glm::vec3(0.0f));
    const glm::ivec2 tiles = (size + kTileEdge - 1) / kTileEdge;
    const size_t count = static_cast<size_t>(tiles.x) * static_cast<size_t>(tiles.y);
    std::mutex mutex;
    size_t done = 0;
    int64_t rays = 0;
    parallel_for(count, 1, [&](size_t begin, size_t end) {
        for (size_t tile = begin; tile < end; ++tile) {
            PathTracer tracer(scene, options);
            const glm::ivec2 corner = kTileEdge * glm::ivec2(tile % static_cast<size_t>(tiles.x),
                                                             tile / static_cast<size_t>(tiles.x));
            const glm::ivec2 far = glm::min(corner + kTileEdge, size);
            for (int y = corner.y; y < far.y; ++y) {
                for (int x = corner.x; x < far.x; ++x) {
                    const auto index =
                        static_cast<uint32_t>(y) * static_cast<uint32_t>(size.x) + static_cast<uint32_t>(x);
                    radiance[index] = trace_pixel(tracer, options, {x, y}, index);
                }
            }
            const std::lock_guard lock(mutex);
            rays += tracer.rays();
            ++done;
            if (progress) {
                progress(static_cast<float>(done) / static_cast<float>(count));
            }
        }
    });
    return rays;
}

} // namespace cl::embree
