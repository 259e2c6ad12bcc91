#pragma once

#include "drivers/gles3/gl/buffer.h"
#include "drivers/gles3/gl/state.h"

namespace cl::gles3::gl {

template <typename Block>
Expected<UniformBuffer<Block>> UniformBuffer<Block>::create(int count, std::string_view label) {
    const auto alignment = static_cast<size_t>(State::current().capabilities().uniform_offset_alignment);
    const size_t stride = (sizeof(Block) + alignment - 1) / alignment * alignment;
    Expected<Buffer> buffer = Buffer::create({BufferKind::Uniform, BufferUsage::Dynamic, label},
                                             stride * static_cast<size_t>(count));
    if (!buffer) {
        return buffer.error();
    }
    return UniformBuffer(*std::move(buffer), stride);
}

template <typename Block>
Status UniformBuffer<Block>::set(const Block& block, int index) {
    return buffer_.update(stride_ * static_cast<size_t>(index), std::as_bytes(std::span(&block, 1)));
}

template <typename Block>
void UniformBuffer<Block>::bind(int index) const {
    State::current().bind_uniform_range(Block::kBinding, buffer_.id(),
                                        static_cast<GLintptr>(stride_ * static_cast<size_t>(index)),
                                        static_cast<GLsizeiptr>(sizeof(Block)));
}

} // namespace cl::gles3::gl
