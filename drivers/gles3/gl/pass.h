#pragma once

#include "drivers/gles3/gl/draw_state.h"
#include "drivers/gles3/gl/framebuffer.h"
#include "drivers/gles3/gl/program.h"
#include "drivers/gles3/gl/vertex_array.h"

#include <glm/vec4.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace cl::gles3::gl {

enum class Load : uint8_t {
    Keep,     ///< what is there stays
    Clear,    ///< filled with the clear value
    DontCare, ///< the pass writes all of it: no need to load
};

struct PassDesc {
    std::string_view label{};            ///< a group in graphics debuggers
    const Framebuffer* target = nullptr; ///< never null
    std::optional<Rect> viewport{};      ///< nullopt: the whole target; clears stay inside it
    std::array<Load, kMaxColorAttachments> colors{Load::Keep, Load::Keep, Load::Keep, Load::Keep};
    std::array<glm::vec4, kMaxColorAttachments> clear_colors{};
    Load depth = Load::Keep;
    float clear_depth = 1.0f;
};

/// What a draw call covers: vertices or indices first.. first+count.
struct DrawRange {
    PrimitiveType primitive = PrimitiveType::Triangles;
    int first = 0;
    int count = 0;
    int instances = 1;
};

/// The only place where draws happen. From construction to destruction its target is bound; a second Pass may
/// not begin meanwhile. Nothing that a Pass sets is seen by the next, which names its own state whole.
class Pass {
public:
    explicit Pass(const PassDesc& desc);
    ~Pass();
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;

    void draw(const Program& program, const VertexArray& vertices, const DrawState& state,
              const DrawRange& range);
    /// One triangle that covers the viewport; the program's vertex stage is lib/fullscreen.glsl.
    void draw_fullscreen(const Program& program, const VertexArray& empty,
                         const DrawState& state = kFullscreenState);
    /// Draws go to this part from now on, without clearing (tiles of an atlas).
    void set_viewport(const Rect& rect);

private:
    const Framebuffer* target_;
};

} // namespace cl::gles3::gl
