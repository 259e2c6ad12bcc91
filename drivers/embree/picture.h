#pragma once

#include "drivers/embree/path_tracer.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace cl::embree {

/// Traces every pixel of a picture, in tiles on all workers.
/// @param radiance  receives size.x * size.y means of the pixels' samples, row 0 at the top; linear
/// @param progress  may be empty; told the share done, from any thread but never from two at once
/// @return rays sent out
int64_t trace_picture(const TracedScene& scene, const PathOptions& options, glm::ivec2 size,
                      std::vector<glm::vec3>& radiance, const std::function<void(float)>& progress);

} // namespace cl::embree
