#pragma once

#include "drivers/gl_api.h"

#include <glm/vec2.hpp>

#include <cstdint>

namespace cl::gles3::gl {

enum class DepthTest : uint8_t { Off, Less, LessEqual, Equal, Always };
enum class Cull : uint8_t { Off, Back, Front };
enum class FrontFace : uint8_t { CounterClockwise, Clockwise };

/// How a fragment joins what is in the target: equation(source * its factor, target * its factor).
struct Blend {
    GLenum equation = GL_FUNC_ADD;
    GLenum source = GL_ONE, target = GL_ZERO;             ///< of rgb
    GLenum source_alpha = GL_ONE, target_alpha = GL_ZERO; ///< of a
    friend bool operator==(const Blend&, const Blend&) = default;
};
namespace blend {
inline constexpr Blend kReplace{};
/// Straight alpha over.
inline constexpr Blend kMix{GL_FUNC_ADD, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                            GL_ONE_MINUS_SRC_ALPHA};
/// Sum, weighted by the source's alpha.
inline constexpr Blend kAdd{GL_FUNC_ADD, GL_SRC_ALPHA, GL_ONE, GL_SRC_ALPHA, GL_ONE};
/// Target minus source, weighted by the source's alpha.
inline constexpr Blend kSub{GL_FUNC_REVERSE_SUBTRACT, GL_SRC_ALPHA, GL_ONE, GL_SRC_ALPHA, GL_ONE};
/// Product.
inline constexpr Blend kMul{GL_FUNC_ADD, GL_DST_COLOR, GL_ZERO, GL_DST_ALPHA, GL_ZERO};
} // namespace blend

enum class WriteMask : uint8_t { None = 0, Color = 1, Depth = 2, ColorAndDepth = 3 };

/// All fixed-function state of a draw; every draw names it whole, so none leaks into the next.
struct DrawState {
    DepthTest depth_test = DepthTest::LessEqual;
    WriteMask write = WriteMask::ColorAndDepth;
    Cull cull = Cull::Back;
    FrontFace front_face = FrontFace::CounterClockwise;
    Blend blend = blend::kReplace;
    glm::vec2 polygon_offset{0.0f}; ///< factor, units; (0, 0) is off
    friend bool operator==(const DrawState&, const DrawState&) = default;
};

/// For passes that cover the target with one triangle.
inline constexpr DrawState kFullscreenState{DepthTest::Off, WriteMask::Color, Cull::Off};

/// A rectangle of a target [pixels]; GL's origin, bottom left.
struct Rect {
    glm::ivec2 position{0};
    glm::ivec2 size{0};
    friend bool operator==(const Rect&, const Rect&) = default;
};

} // namespace cl::gles3::gl
