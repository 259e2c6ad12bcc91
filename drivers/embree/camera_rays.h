#pragma once

#include "drivers/embree/ray_scene.h"

#include "servers/rasterizer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cl::embree {

/// The rays of a picture's points, between the near and the far plane as the rasteriser clips.
class CameraRays {
public:
    explicit CameraRays(const Frame& frame);

    struct CameraRay {
        Ray ray;
        glm::vec3 sky_direction{0.0f}; ///< where it sees the sky: parallel cameras and a sky with a field of
                                       ///< view of its own look elsewhere than their rays go
    };
    /// @param pixel  (0, 0) is the picture's upper left corner, size its lower right one
    [[nodiscard]] CameraRay ray(const glm::vec2& pixel) const noexcept;

private:
    glm::vec2 size_;
    glm::dmat4 world_from_clip_;
    glm::dmat4 view_from_sky_clip_;
    glm::mat3 world_from_view_;
};

} // namespace cl::embree
