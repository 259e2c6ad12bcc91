#pragma once

#include <cstdint>

namespace cl::gles3::gl {

/// What the current context offers beyond, or instead of, GLES 3.0's minimum. Asked once, when a State is
/// made.
struct Capabilities {
    bool browser = false;               ///< WebGL 2: differs from ES in details
    bool desktop = false;               ///< OpenGL core profile, not ES: see workarounds.h
    bool color_buffer_float = false;    ///< RGBA16F, R11F_G11F_B10F, RGBA32F can be rendered to
    bool float_linear = false;          ///< 32-bit float textures can be filtered
    bool software = false;              ///< the driver runs shaders on the CPU
    bool debug_labels = false;          ///< KHR_debug: object labels and pass groups
    float max_anisotropy = 1.0f;        ///< 1: not there
    int max_texture_size = 2048;        ///< 2D edge [texels]
    int max_texture_3d_size = 256;      ///< 3D edge [texels]
    int max_cube_size = 2048;           ///< [texels]
    int uniform_offset_alignment = 256; ///< of a block's start in its buffer [bytes]

    [[nodiscard]] static Capabilities query();
};

} // namespace cl::gles3::gl
