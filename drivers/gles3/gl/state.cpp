#include "drivers/gles3/gl/state.h"

#include "drivers/gles3/gl/vertex_array.h"
#include "drivers/gles3/gl/workarounds.h"

#include "core/assert.h"

namespace cl::gles3::gl {

namespace {

State* current_state = nullptr;

/// Slot of a target in TextureUnit::names.
size_t target_slot(GLenum target) {
    switch (target) {
    case GL_TEXTURE_2D:
        return 0;
    case GL_TEXTURE_3D:
        return 1;
    default:
        CL_ASSERT(target == GL_TEXTURE_CUBE_MAP, "a texture target that State knows");
        return 2;
    }
}

void set_enabled(GLenum capability, bool on) {
    on ? glEnable(capability) : glDisable(capability);
}

GLenum gl_depth_function(DepthTest test) {
    switch (test) {
    case DepthTest::Less:
        return GL_LESS;
    case DepthTest::LessEqual:
        return GL_LEQUAL;
    case DepthTest::Equal:
        return GL_EQUAL;
    case DepthTest::Off:
    case DepthTest::Always:
        break;
    }
    return GL_ALWAYS;
}

bool has(WriteMask mask, WriteMask bit) {
    return (static_cast<int>(mask) & static_cast<int>(bit)) != 0;
}

} // namespace

State::State() : capabilities_(Capabilities::query()) {
    make_current();
    // Whoever had the context before us may have left anything: make what the mirror starts with true.
    glUseProgram(0);
    glActiveTexture(GL_TEXTURE0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDisable(GL_SCISSOR_TEST);
    apply_workarounds(capabilities_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1); // our texels are tightly packed, also of three bytes
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glDisable(GL_DITHER); // on by default; the same picture everywhere is worth more
    // Meshes without vertex colours are white.
    glVertexAttrib4f(static_cast<GLuint>(Attribute::Color), 1.0f, 1.0f, 1.0f, 1.0f);
    default_vertex_array_ = create(ObjectKind::VertexArray);
    bind_vertex_array(0);
    apply(DrawState{});
}

State::~State() {
    destroy(ObjectKind::VertexArray, default_vertex_array_);
    for (const int count : live_) {
        CL_ASSERT(count == 0, "a GL object outlives its context's State");
    }
    if (current_state == this) {
        current_state = nullptr;
    }
}

State& State::current() {
    CL_ASSERT(current_state, "GL is used without a State");
    return *current_state;
}

void State::make_current() noexcept {
    current_state = this;
}

void State::use_program(GLuint program) {
    if (program_ != program) {
        glUseProgram(program);
        program_ = program;
    }
}

void State::bind_vertex_array(GLuint vertex_array) {
    const GLuint name = vertex_array ? vertex_array : default_vertex_array_;
    if (vertex_array_ != name) {
        glBindVertexArray(name);
        vertex_array_ = name;
    }
}

void State::activate_unit(int unit) {
    if (active_unit_ != unit) {
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        active_unit_ = unit;
    }
}

void State::bind_texture(int unit, GLenum target, GLuint texture) {
    CL_ASSERT(unit >= 0 && unit < kUnits, "a texture unit");
    GLuint& bound = units_[static_cast<size_t>(unit)].names[target_slot(target)];
    if (bound != texture) {
        activate_unit(unit);
        glBindTexture(target, texture);
        bound = texture;
    }
}

void State::bind_texture_for_edit(GLenum target, GLuint texture) {
    // The last unit that every driver has beside the 16 of the fragment stage: no sampler is ever placed
    // there.
    const int unit = 16;
    bind_texture(unit, target, texture);
    activate_unit(unit);
}

void State::bind_buffer(GLenum target, GLuint buffer) {
    // Not mirrored: only uploads bind by target, and an upload costs far more than a bind.
    glBindBuffer(target, buffer);
}

void State::bind_uniform_range(int index, GLuint buffer, GLintptr offset, GLsizeiptr size) {
    CL_ASSERT(index >= 0 && index < kUniformBindings, "a uniform binding point");
    const UniformRange wanted{buffer, offset, size};
    UniformRange& bound = uniforms_[static_cast<size_t>(index)];
    if (bound != wanted) {
        glBindBufferRange(GL_UNIFORM_BUFFER, static_cast<GLuint>(index), buffer, offset, size);
        bound = wanted;
    }
}

void State::bind_draw_framebuffer(GLuint framebuffer) {
    if (draw_framebuffer_ != framebuffer) {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
        draw_framebuffer_ = framebuffer;
    }
}

void State::bind_read_framebuffer(GLuint framebuffer) {
    if (read_framebuffer_ != framebuffer) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        read_framebuffer_ = framebuffer;
    }
}

void State::apply(const DrawState& state) {
    if (draw_ == state) {
        return;
    }
    // Depth writes need the test on: with GL_DEPTH_TEST off nothing is written.
    const bool depth = state.depth_test != DepthTest::Off || has(state.write, WriteMask::Depth);
    set_enabled(GL_DEPTH_TEST, depth);
    glDepthFunc(gl_depth_function(state.depth_test));
    glDepthMask(has(state.write, WriteMask::Depth));
    const GLboolean color = has(state.write, WriteMask::Color);
    glColorMask(color, color, color, color);

    set_enabled(GL_CULL_FACE, state.cull != Cull::Off);
    glCullFace(state.cull == Cull::Front ? GL_FRONT : GL_BACK);
    glFrontFace(state.front_face == FrontFace::Clockwise ? GL_CW : GL_CCW);

    set_enabled(GL_BLEND, state.blend != blend::kReplace);
    glBlendEquation(state.blend.equation);
    glBlendFuncSeparate(state.blend.source, state.blend.target, state.blend.source_alpha,
                        state.blend.target_alpha);

    set_enabled(GL_POLYGON_OFFSET_FILL, state.polygon_offset != glm::vec2(0.0f));
    glPolygonOffset(state.polygon_offset.x, state.polygon_offset.y);
    draw_ = state;
}

void State::set_viewport(const Rect& rect) {
    if (viewport_ != rect) {
        glViewport(rect.position.x, rect.position.y, rect.size.x, rect.size.y);
        viewport_ = rect;
    }
}

void State::set_scissor(const std::optional<Rect>& rect) {
    if (scissor_ == rect) {
        return;
    }
    set_enabled(GL_SCISSOR_TEST, rect.has_value());
    if (rect) {
        glScissor(rect->position.x, rect->position.y, rect->size.x, rect->size.y);
    }
    scissor_ = rect;
}

} // namespace cl::gles3::gl
