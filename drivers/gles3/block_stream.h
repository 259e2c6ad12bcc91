#pragma once

#include "drivers/gles3/gl/buffer.h"
#include "drivers/gles3/gl/state.h"

#include "core/expected.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <vector>

namespace cl::gles3 {

/// Many copies of one uniform block, filled anew each frame and sent to the driver in one piece.
template <typename Block>
class BlockStream {
public:
    void clear() noexcept { count_ = 0; }
    /// Index of the copy, for bind().
    int push(const Block& block) {
        const size_t step = stride();
        if (bytes_.size() < (count_ + 1) * step) {
            bytes_.resize((count_ + 1) * step * 2);
        }
        std::memcpy(bytes_.data() + count_ * step, &block, sizeof(Block));
        return static_cast<int>(count_++);
    }
    /// Sends all copies; those of the last frame are gone.
    Status upload() {
        if (count_ == 0) {
            return {};
        }
        const std::span<const std::byte> used(bytes_.data(), count_ * stride());
        if (buffer_) {
            buffer_->replace(used);
            return {};
        }
        Expected<gl::Buffer> buffer =
            gl::Buffer::create({gl::BufferKind::Uniform, gl::BufferUsage::Dynamic, Block::kName}, used);
        if (!buffer) {
            return buffer.error();
        }
        buffer_.emplace(*std::move(buffer));
        return {};
    }
    /// Makes a copy what programs see as this block, whichever programs they are.
    void bind(int index) const {
        gl::State::current().bind_uniform_range(Block::kBinding, buffer_->id(),
                                                static_cast<GLintptr>(stride() * static_cast<size_t>(index)),
                                                static_cast<GLsizeiptr>(sizeof(Block)));
    }

private:
    [[nodiscard]] static size_t stride() {
        const auto alignment =
            static_cast<size_t>(gl::State::current().capabilities().uniform_offset_alignment);
        return (sizeof(Block) + alignment - 1) / alignment * alignment;
    }
    std::vector<std::byte> bytes_;
    size_t count_ = 0;
    std::optional<gl::Buffer> buffer_;
};

} // namespace cl::gles3
