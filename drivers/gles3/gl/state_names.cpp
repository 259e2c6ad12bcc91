// The part of State that makes, labels and deletes GL names, and forgets the bindings of deleted ones.
#include "drivers/gles3/gl/state.h"

#include "core/assert.h"

namespace cl::gles3::gl {

GLuint State::create(ObjectKind kind) {
    GLuint name = 0;
    switch (kind) {
    case ObjectKind::Texture:
        glGenTextures(1, &name);
        break;
    case ObjectKind::Buffer:
        glGenBuffers(1, &name);
        break;
    case ObjectKind::VertexArray:
        glGenVertexArrays(1, &name);
        break;
    case ObjectKind::Framebuffer:
        glGenFramebuffers(1, &name);
        break;
    case ObjectKind::Program:
        name = glCreateProgram();
        break;
    }
    CL_ASSERT(name != 0, "GL gives names; it cannot after the context was lost");
    ++live_[static_cast<size_t>(kind)];
    return name;
}

void State::destroy(ObjectKind kind, GLuint name) {
    if (name == 0) {
        return;
    }
    switch (kind) {
    case ObjectKind::Texture:
        forget_texture(name);
        glDeleteTextures(1, &name);
        break;
    case ObjectKind::Buffer:
        for (UniformRange& u : uniforms_) {
            u = u.buffer == name ? UniformRange{} : u;
        }
        glDeleteBuffers(1, &name);
        break;
    case ObjectKind::VertexArray:
        if (vertex_array_ == name) {
            vertex_array_ = 0;
        }
        glDeleteVertexArrays(1, &name);
        break;
    case ObjectKind::Framebuffer:
        draw_framebuffer_ = draw_framebuffer_ == name ? 0 : draw_framebuffer_;
        read_framebuffer_ = read_framebuffer_ == name ? 0 : read_framebuffer_;
        glDeleteFramebuffers(1, &name);
        break;
    case ObjectKind::Program:
        if (program_ == name) {
            use_program(0); // a program in use would be kept by GL until another is used
        }
        glDeleteProgram(name);
        break;
    }
    --live_[static_cast<size_t>(kind)];
}

void State::forget_texture(GLuint name) {
    for (TextureUnit& unit : units_) {
        for (GLuint& bound : unit.names) {
            bound = bound == name ? 0 : bound;
        }
    }
}

void State::label(ObjectKind kind, GLuint name, std::string_view text) {
    if (!capabilities_.debug_labels || text.empty()) {
        return;
    }
    static constexpr GLenum kIdentifiers[kObjectKinds] = {GL_TEXTURE, GL_BUFFER_KHR, GL_VERTEX_ARRAY_KHR,
                                                          GL_FRAMEBUFFER, GL_PROGRAM_KHR};
    glObjectLabelKHR(kIdentifiers[static_cast<size_t>(kind)], name, static_cast<GLsizei>(text.size()),
                     text.data());
}

} // namespace cl::gles3::gl
