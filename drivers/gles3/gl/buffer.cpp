#include "drivers/gles3/gl/buffer.h"

#include "drivers/gles3/gl/state.h"

#include <fmt/core.h>

namespace cl::gles3::gl {

namespace {

/// Uploads bind here: it disturbs no vertex array, and the browser lets any buffer be bound to it, while it
/// ties one to index or other data by its first binding elsewhere (WebGL 2.0 section 5.1).
constexpr GLenum kEditTarget = GL_COPY_WRITE_BUFFER;

GLenum gl_usage(BufferUsage usage) {
    return usage == BufferUsage::Static ? GL_STATIC_DRAW : GL_DYNAMIC_DRAW;
}

} // namespace

Buffer::Buffer(Buffer&& other) noexcept
    : id_(std::exchange(other.id_, 0)), kind_(other.kind_), usage_(other.usage_), size_(other.size_) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(id_, other.id_);
    kind_ = other.kind_;
    usage_ = other.usage_;
    size_ = other.size_;
    return *this;
}

Buffer::~Buffer() {
    if (id_) {
        State::current().destroy(ObjectKind::Buffer, id_);
    }
}

Expected<Buffer> Buffer::create_raw(const BufferDesc& desc, size_t size, const void* bytes) {
    State& state = State::current();
    Buffer buffer(state.create(ObjectKind::Buffer), desc.kind, desc.usage, size);
    state.bind_buffer(kEditTarget, buffer.id_);
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) {
    } // older errors, which the debug output has told already
    glBufferData(kEditTarget, static_cast<GLsizeiptr>(size), bytes, gl_usage(desc.usage));
    if (glGetError() != GL_NO_ERROR) {
        return Error{ErrorCode::OutOfMemory,
                     fmt::format("buffer {}: the driver has no room for {} bytes", desc.label, size)};
    }
    state.label(ObjectKind::Buffer, buffer.id_, desc.label);
    return buffer;
}

Expected<Buffer> Buffer::create(const BufferDesc& desc, std::span<const std::byte> bytes) {
    return create_raw(desc, bytes.size(), bytes.data());
}

Expected<Buffer> Buffer::create(const BufferDesc& desc, size_t size) {
    return create_raw(desc, size, nullptr);
}

Status Buffer::update(size_t offset, std::span<const std::byte> bytes) {
    if (offset > size_ || bytes.size() > size_ - offset) {
        return Error{
            ErrorCode::InvalidArgument,
            fmt::format("expected bytes within a buffer of {}, found {} at {}", size_, bytes.size(), offset)};
    }
    State::current().bind_buffer(kEditTarget, id_);
    glBufferSubData(kEditTarget, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                    bytes.data());
    return {};
}

void Buffer::replace(std::span<const std::byte> bytes) {
    State::current().bind_buffer(kEditTarget, id_);
    glBufferData(kEditTarget, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), gl_usage(usage_));
    size_ = bytes.size();
}

} // namespace cl::gles3::gl
