#include "drivers/gles3/gl/pass.h"

#include "drivers/gles3/gl/state.h"

#include <glm/gtc/type_ptr.hpp>

namespace cl::gles3::gl {

namespace {

bool a_pass_is_open = false;

/// Tells tiled GPUs not to load what the pass overwrites anyway.
void discard(const PassDesc& desc) {
    std::array<GLenum, kMaxColorAttachments + 1> points{};
    GLsizei count = 0;
    const bool is_window = desc.target->id() == 0;
    for (int i = 0; i < desc.target->color_count(); ++i) {
        if (desc.colors[static_cast<size_t>(i)] == Load::DontCare) {
            points[static_cast<size_t>(count++)] =
                is_window ? static_cast<GLenum>(GL_COLOR) : GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        }
    }
    if (desc.target->has_depth() && desc.depth == Load::DontCare) {
        points[static_cast<size_t>(count++)] = is_window ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    }
    if (count > 0) {
        glInvalidateFramebuffer(GL_DRAW_FRAMEBUFFER, count, points.data());
    }
}

void clear(const PassDesc& desc) {
    for (int i = 0; i < desc.target->color_count(); ++i) {
        const auto slot = static_cast<size_t>(i);
        if (desc.colors[slot] == Load::Clear) {
            glClearBufferfv(GL_COLOR, i, glm::value_ptr(desc.clear_colors[slot]));
        }
    }
    if (desc.target->has_depth() && desc.depth == Load::Clear) {
        glClearBufferfv(GL_DEPTH, 0, &desc.clear_depth);
    }
}

} // namespace

Pass::Pass(const PassDesc& desc) : target_(desc.target) {
    CL_ASSERT(!a_pass_is_open, "a Pass begins while another is open");
    CL_ASSERT(target_ != nullptr, "a Pass needs a target");
    a_pass_is_open = true;
    State& state = State::current();
    if (state.capabilities().debug_labels) {
        glPushDebugGroupKHR(GL_DEBUG_SOURCE_APPLICATION_KHR, 0, static_cast<GLsizei>(desc.label.size()),
                            desc.label.data());
    }
    state.bind_draw_framebuffer(target_->id());
    state.apply(DrawState{}); // clears obey the write masks
    set_viewport(desc.viewport.value_or(Rect{glm::ivec2(0), target_->size()}));
    if (!desc.viewport) {
        discard(desc);
    }
    clear(desc);
}

Pass::~Pass() {
    if (State::current().capabilities().debug_labels) {
        glPopDebugGroupKHR();
    }
    a_pass_is_open = false;
}

void Pass::set_viewport(const Rect& rect) {
    State& state = State::current();
    state.set_viewport(rect);
    // The viewport does not bound clears, nor wide lines and points: the scissor does.
    const bool whole = rect == Rect{glm::ivec2(0), target_->size()};
    state.set_scissor(whole ? std::nullopt : std::optional(rect));
}

void Pass::draw(const Program& program, const VertexArray& vertices, const DrawState& draw_state,
                const DrawRange& range) {
    State& state = State::current();
    state.use_program(program.id());
    state.bind_vertex_array(vertices.id());
    state.apply(draw_state);
    const GLenum mode = gl_primitive(range.primitive);
    if (vertices.index_type() == IndexType::None) {
        glDrawArraysInstanced(mode, range.first, range.count, range.instances);
        return;
    }
    const bool wide = vertices.index_type() == IndexType::U32;
    const size_t offset = static_cast<size_t>(range.first) * (wide ? 4 : 2);
    glDrawElementsInstanced(mode, range.count, wide ? GL_UNSIGNED_INT : GL_UNSIGNED_SHORT, gl_offset(offset),
                            range.instances);
}

void Pass::draw_fullscreen(const Program& program, const VertexArray& empty, const DrawState& state) {
    draw(program, empty, state, DrawRange{PrimitiveType::Triangles, 0, 3, 1});
}

} // namespace cl::gles3::gl
