#pragma once

#include "drivers/gl_api.h"

#include <cstdint>
#include <string_view>

namespace cl::gles3::gl {

/// Texel formats of GLES 3.0 that we use. Colour is linear unless the name says Srgb.
enum class Format : uint8_t {
    R8,
    RG8,
    RGB8,
    RGBA8,
    Srgb8Alpha8,
    R16F,
    RG16F,
    RGB16F,
    RGBA16F,
    R11G11B10F,
    RGB10A2,
    R32F,
    RG32F,
    RGB32F,
    RGBA32F,
    R32UI,
    RG32UI,
    RGBA32UI,
    RGB9E5,
    Depth16,
    Depth24,
    Depth32F,
    Depth24Stencil8,
};
inline constexpr int kFormatCount = 23;

enum class FormatClass : uint8_t { Normalized, Float, Integer, Depth, DepthStencil };

struct FormatInfo {
    std::string_view name; ///< "RGBA16F"
    GLenum internal;       ///< GL_RGBA16F
    GLenum transfer;       ///< what uploads and reads use with it: GL_RGBA
    GLenum type;           ///< element type of uploads: GL_HALF_FLOAT where the format is 16-bit float
    int bytes_per_texel;   ///< of uploads
    FormatClass kind;
};
[[nodiscard]] const FormatInfo& format_info(Format format) noexcept;

} // namespace cl::gles3::gl
