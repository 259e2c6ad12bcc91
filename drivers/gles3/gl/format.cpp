#include "drivers/gles3/gl/format.h"

#include "core/assert.h"

#include <array>

namespace cl::gles3::gl {

namespace {

using enum FormatClass;

/// In the order of Format.
constexpr std::array<FormatInfo, kFormatCount> kFormats{{
    {"R8", GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, Normalized},
    {"RG8", GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2, Normalized},
    {"RGB8", GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE, 3, Normalized},
    {"RGBA8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, Normalized},
    {"Srgb8Alpha8", GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, Normalized},
    {"R16F", GL_R16F, GL_RED, GL_HALF_FLOAT, 2, Float},
    {"RG16F", GL_RG16F, GL_RG, GL_HALF_FLOAT, 4, Float},
    {"RGB16F", GL_RGB16F, GL_RGB, GL_HALF_FLOAT, 6, Float},
    {"RGBA16F", GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8, Float},
    {"R11G11B10F", GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, 4, Float},
    {"RGB10A2", GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4, Normalized},
    {"R32F", GL_R32F, GL_RED, GL_FLOAT, 4, Float},
    {"RG32F", GL_RG32F, GL_RG, GL_FLOAT, 8, Float},
    {"RGB32F", GL_RGB32F, GL_RGB, GL_FLOAT, 12, Float},
    {"RGBA32F", GL_RGBA32F, GL_RGBA, GL_FLOAT, 16, Float},
    {"R32UI", GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, Integer},
    {"RG32UI", GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8, Integer},
    {"RGBA32UI", GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16, Integer},
    {"RGB9E5", GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, 4, Float},
    {"Depth16", GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, 2, Depth},
    {"Depth24", GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 4, Depth},
    {"Depth32F", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4, Depth},
    {"Depth24Stencil8", GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 4, DepthStencil},
}};
static_assert(kFormats[static_cast<size_t>(Format::Depth24Stencil8)].internal == GL_DEPTH24_STENCIL8);
static_assert(kFormats[static_cast<size_t>(Format::RGBA16F)].internal == GL_RGBA16F);

} // namespace

const FormatInfo& format_info(Format format) noexcept {
    CL_ASSERT(static_cast<size_t>(format) < kFormats.size(), "not a Format");
    return kFormats[static_cast<size_t>(format)];
}

} // namespace cl::gles3::gl
