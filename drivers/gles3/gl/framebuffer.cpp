#include "drivers/gles3/gl/framebuffer.h"

#include "drivers/gles3/gl/state.h"

#include <fmt/core.h>

#include <utility>

namespace cl::gles3::gl {

namespace {

void attach(GLenum point, const Attachment& a) {
    switch (a.texture->target()) {
    case GL_TEXTURE_2D:
        glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, point, GL_TEXTURE_2D, a.texture->id(), a.mip);
        break;
    case GL_TEXTURE_CUBE_MAP:
        glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, point,
                               GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(a.layer), a.texture->id(),
                               a.mip);
        break;
    default:
        glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, point, a.texture->id(), a.mip, a.layer);
    }
}

GLenum depth_point(const Texture& depth) {
    const bool stencil = format_info(depth.format()).kind == FormatClass::DepthStencil;
    return stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

int layer_count(const Texture& texture, int mip) {
    return texture.target() == GL_TEXTURE_CUBE_MAP ? 6 : texture.size(mip).z;
}

/// InvalidArgument if the attachment names an image that its texture does not have.
Status check_attachment(const Attachment& a) {
    if (a.mip < 0 || a.mip >= a.texture->mips() || a.layer < 0 || a.layer >= layer_count(*a.texture, a.mip)) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("expected a mip below {} and a layer of that mip, found mip {}, layer {}",
                                 a.texture->mips(), a.mip, a.layer)};
    }
    return {};
}

std::string formats_of(const FramebufferDesc& desc) {
    std::string text;
    for (const Attachment& a : desc.colors) {
        if (a.texture) {
            text += fmt::format("{}{}", text.empty() ? "" : ", ", format_info(a.texture->format()).name);
        }
    }
    if (desc.depth.texture) {
        text += fmt::format("{}{}", text.empty() ? "" : ", ", format_info(desc.depth.texture->format()).name);
    }
    return text;
}

} // namespace

Framebuffer::Framebuffer(Framebuffer&& other) noexcept
    : id_(std::exchange(other.id_, 0)), size_(other.size_), color_count_(other.color_count_),
      has_depth_(other.has_depth_) {}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(id_, other.id_);
    size_ = other.size_;
    color_count_ = other.color_count_;
    has_depth_ = other.has_depth_;
    return *this;
}

Framebuffer::~Framebuffer() {
    if (id_) { // 0: moved from, or the window's
        State::current().destroy(ObjectKind::Framebuffer, id_);
    }
}

Framebuffer Framebuffer::window(glm::ivec2 size) noexcept {
    Framebuffer f;
    f.size_ = size;
    f.color_count_ = 1;
    return f;
}

Expected<Framebuffer> Framebuffer::create(const FramebufferDesc& desc) {
    State& state = State::current();
    Framebuffer f;
    f.id_ = state.create(ObjectKind::Framebuffer);
    state.bind_draw_framebuffer(f.id_);
    GLenum buffers[kMaxColorAttachments] = {};
    for (const Attachment& a : desc.colors) {
        if (!a.texture) {
            break;
        }
        if (Status s = check_attachment(a); !s) {
            return s.error();
        }
        const GLenum point = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(f.color_count_);
        attach(point, a);
        buffers[f.color_count_++] = point;
        f.size_ = glm::ivec2(a.texture->size(a.mip));
    }
    if (desc.depth.texture) {
        if (Status s = check_attachment(desc.depth); !s) {
            return s.error();
        }
        attach(depth_point(*desc.depth.texture), desc.depth);
        f.has_depth_ = true;
        f.size_ = glm::ivec2(desc.depth.texture->size(desc.depth.mip));
    }
    glDrawBuffers(f.color_count_, buffers);
    const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("framebuffer {}: the driver cannot draw to {} (status 0x{:04x})", desc.label,
                                 formats_of(desc), status)};
    }
    state.label(ObjectKind::Framebuffer, f.id_, desc.label);
    return f;
}

void Framebuffer::read(const Rect& rect, int index, GLenum type, void* pixels) const {
    CL_ASSERT(index >= 0 && index < color_count_, "a colour attachment");
    State::current().bind_read_framebuffer(id_);
    glReadBuffer(id_ == 0 ? static_cast<GLenum>(GL_BACK) : GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index));
    glReadPixels(rect.position.x, rect.position.y, rect.size.x, rect.size.y, GL_RGBA, type, pixels);
}

std::vector<uint8_t> Framebuffer::read_rgba8(const Rect& rect, int index) const {
    std::vector<uint8_t> pixels(static_cast<size_t>(rect.size.x) * static_cast<size_t>(rect.size.y) * 4);
    read(rect, index, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
}

std::vector<float> Framebuffer::read_rgba32f(const Rect& rect, int index) const {
    std::vector<float> pixels(static_cast<size_t>(rect.size.x) * static_cast<size_t>(rect.size.y) * 4);
    read_rgba32f(rect, index, pixels);
    return pixels;
}

void Framebuffer::read_rgba32f(const Rect& rect, int index, std::span<float> into) const {
    CL_ASSERT(into.size() == static_cast<size_t>(rect.size.x) * static_cast<size_t>(rect.size.y) * 4,
              "memory for the rectangle's pixels");
    read(rect, index, GL_FLOAT, into.data());
}

} // namespace cl::gles3::gl
