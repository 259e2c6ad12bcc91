#pragma once

#include "servers/gi/float4.h"

#include <glm/vec3.hpp>

namespace cl::radiosity {

/// A linear colour in four lanes, of which the last is not used: a sum is one addition, a read one load.
using Rgb4 = gi::float4;
[[nodiscard]] inline Rgb4 rgb4(const glm::vec3& v) noexcept {
    return Rgb4{v.x, v.y, v.z, 0.0f};
}
[[nodiscard]] inline glm::vec3 rgb(const Rgb4& v) noexcept {
    return {v[0], v[1], v[2]};
}

} // namespace cl::radiosity
