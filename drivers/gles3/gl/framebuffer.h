#pragma once

#include "drivers/gl_api.h"
#include "drivers/gles3/gl/draw_state.h"
#include "drivers/gles3/gl/texture.h"

#include "core/expected.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cl::gles3::gl {

inline constexpr int kMaxColorAttachments = 4;

/// One image of a texture. `layer`: slice of a 3D texture, layer of an array, face of a cube map; else 0.
struct Attachment {
    const Texture* texture = nullptr;
    int mip = 0;
    int layer = 0;
};

struct FramebufferDesc {
    std::array<Attachment, kMaxColorAttachments> colors{}; ///< gap-free from 0; none for depth alone
    Attachment depth{};
    std::string_view label{};
};

/// A set of images to draw into. It borrows its textures: they must live as long.
class Framebuffer {
public:
    /// @return Unsupported naming the formats if the driver cannot draw to them.
    [[nodiscard]] static Expected<Framebuffer> create(const FramebufferDesc& desc);
    /// The window's own; not owned. Contexts without a window have none.
    [[nodiscard]] static Framebuffer window(glm::ivec2 size) noexcept;
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;
    ~Framebuffer();

    [[nodiscard]] GLuint id() const noexcept { return id_; }
    [[nodiscard]] glm::ivec2 size() const noexcept { return size_; } ///< [pixels]
    [[nodiscard]] int color_count() const noexcept { return color_count_; }
    [[nodiscard]] bool has_depth() const noexcept { return has_depth_; }

    /// Reads a rectangle of colour attachment `index`, bottom row first as GL has it; waits for the drawing.
    /// 8 bit: of normalised formats, 4 bytes a pixel. Floats: of float formats, 4 a pixel.
    [[nodiscard]] std::vector<uint8_t> read_rgba8(const Rect& rect, int index = 0) const;
    [[nodiscard]] std::vector<float> read_rgba32f(const Rect& rect, int index = 0) const;
    /// ... into memory of the caller's, which they must fill.
    void read_rgba32f(const Rect& rect, int index, std::span<float> into) const;

private:
    Framebuffer() = default;
    void read(const Rect& rect, int index, GLenum type, void* pixels) const;
    GLuint id_ = 0; ///< 0: moved from, or the window's: nothing to delete
    glm::ivec2 size_{0};
    int color_count_ = 0;
    bool has_depth_ = false;
};

} // namespace cl::gles3::gl
