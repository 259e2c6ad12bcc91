#pragma once

#include "drivers/gl_api.h"
#include "drivers/gles3/gl/buffer.h"

#include "servers/mesh_surface.h"

#include <span>
#include <string_view>

namespace cl::gles3::gl {

/// Attribute locations of every program; shaders/lib/vertex_inputs.glsl declares the same.
enum class Attribute : uint8_t { Position, Normal, Tangent, Color, UV, UV2, Bones, Weights };
inline constexpr int kAttributeCount = 8;

enum class IndexType : uint8_t { None, U16, U32 };

/// One attribute of an interleaved vertex.
struct AttributeDesc {
    Attribute attribute = Attribute::Position;
    int components = 3;
    GLenum type = GL_FLOAT;
    bool normalized = false; ///< integers as 0..1 or -1..1
    int offset = 0;          ///< [bytes]
};

/// The attributes of a surface in Godot's vertex layout, read by the GPU as they are stored: halves, int8 /
/// 127 (clamped to -1), uint8 / 255, uint16 / 65535.
struct AttributeList {
    AttributeDesc items[kAttributeCount];
    int count = 0;
    int stride = 0; ///< [bytes]
    [[nodiscard]] std::span<const AttributeDesc> span() const { return {items, static_cast<size_t>(count)}; }
};
[[nodiscard]] AttributeList attributes_of_surface(uint32_t format) noexcept;

struct VertexArrayDesc {
    const Buffer* vertices = nullptr; ///< borrowed while the array lives
    std::span<const AttributeDesc> attributes{};
    int stride = 0;                  ///< [bytes]
    const Buffer* indices = nullptr; ///< likewise; nullptr: not indexed
    IndexType index_type = IndexType::None;
    std::string_view label{};
};

/// Which buffers feed which attributes. An attribute that is absent reads white (Color) or (0, 0, 0, 1).
class VertexArray {
public:
    [[nodiscard]] static VertexArray create(const VertexArrayDesc& desc);
    /// No attributes: for programs that make their vertices of gl_VertexID (lib/fullscreen.glsl).
    [[nodiscard]] static VertexArray create_empty();
    VertexArray(VertexArray&& other) noexcept;
    VertexArray& operator=(VertexArray&& other) noexcept;
    VertexArray(const VertexArray&) = delete;
    VertexArray& operator=(const VertexArray&) = delete;
    ~VertexArray();

    [[nodiscard]] GLuint id() const noexcept { return id_; }
    [[nodiscard]] IndexType index_type() const noexcept { return index_type_; }

private:
    VertexArray(GLuint id, IndexType type) : id_(id), index_type_(type) {}
    GLuint id_ = 0;
    IndexType index_type_ = IndexType::None;
};

/// GL takes offsets into buffers as pointers. [bytes]
[[nodiscard]] const void* gl_offset(size_t bytes) noexcept;

/// GL's name of a primitive type.
[[nodiscard]] GLenum gl_primitive(PrimitiveType type) noexcept;

} // namespace cl::gles3::gl
