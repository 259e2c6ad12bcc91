#pragma once

#include "drivers/gl_api.h"

#include "core/expected.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace cl::gles3::gl {

enum class BufferKind : uint8_t { Vertex, Index, Uniform };
enum class BufferUsage : uint8_t { Static, Dynamic };

struct BufferDesc {
    BufferKind kind = BufferKind::Vertex;
    BufferUsage usage = BufferUsage::Static;
    std::string_view label{};
};

class Buffer {
public:
    /// Copies the bytes. @return OutOfMemory if the driver cannot hold them.
    [[nodiscard]] static Expected<Buffer> create(const BufferDesc& desc, std::span<const std::byte> bytes);
    /// Room for `size` bytes, undefined.
    [[nodiscard]] static Expected<Buffer> create(const BufferDesc& desc, size_t size);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer();

    [[nodiscard]] GLuint id() const noexcept { return id_; }
    [[nodiscard]] size_t size() const noexcept { return size_; }
    /// Replaces bytes from `offset`. @return InvalidArgument beyond the end.
    Status update(size_t offset, std::span<const std::byte> bytes);
    /// Gives the old contents up and replaces all: cheaper than update() while draws may still read the old.
    void replace(std::span<const std::byte> bytes);

private:
    static Expected<Buffer> create_raw(const BufferDesc& desc, size_t size, const void* bytes);
    Buffer(GLuint id, BufferKind kind, BufferUsage usage, size_t size)
        : id_(id), kind_(kind), usage_(usage), size_(size) {}
    GLuint id_ = 0;
    BufferKind kind_ = BufferKind::Vertex;
    BufferUsage usage_ = BufferUsage::Static;
    size_t size_ = 0;
};

} // namespace cl::gles3::gl
