#pragma once

#include <cstdint>

namespace cl::gles3 {

/// Where the cones of GI probes are traced.
enum class ConePath : uint8_t {
    Best,     ///< Gathered where the driver's shaders run on the CPU, else InShader
    InShader, ///< by each fragment (shaders/lib/gi_probe.glsl)
    Gathered, ///< on the CPU (servers/cones), for the surfaces that the prepass finds
};

} // namespace cl::gles3
