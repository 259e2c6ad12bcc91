#include "drivers/gles3/gl/vertex_array.h"

#include "drivers/gles3/gl/state.h"

#include <utility>

namespace cl::gles3::gl {

namespace {

bool is_compressed(uint32_t format, Attribute array) {
    return (format & (1u << (static_cast<uint32_t>(array) + surface_format::kCompressShift))) != 0;
}

/// How one array lies in the vertex (spec tscn section 9.1, table).
AttributeDesc describe(uint32_t format, Attribute array, int offset) {
    const bool compressed = is_compressed(format, array);
    switch (array) {
    case Attribute::Position:
        return {array, (format & surface_format::k2D) ? 2 : 3, GLenum(compressed ? GL_HALF_FLOAT : GL_FLOAT),
                false, offset};
    case Attribute::Normal:
        return {array, 3, GLenum(compressed ? GL_BYTE : GL_FLOAT), compressed, offset};
    case Attribute::Tangent:
        return {array, 4, GLenum(compressed ? GL_BYTE : GL_FLOAT), compressed, offset};
    case Attribute::Color:
        return {array, 4, GLenum(compressed ? GL_UNSIGNED_BYTE : GL_FLOAT), compressed, offset};
    case Attribute::UV:
    case Attribute::UV2:
        return {array, 2, GLenum(compressed ? GL_HALF_FLOAT : GL_FLOAT), false, offset};
    case Attribute::Bones:
        return {array, 4,
                GLenum((format & surface_format::k16BitBones) ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE), false,
                offset};
    case Attribute::Weights:
        break;
    }
    return {array, 4, GLenum(compressed ? GL_UNSIGNED_SHORT : GL_FLOAT), compressed, offset};
}

} // namespace

AttributeList attributes_of_surface(uint32_t format) noexcept {
    const VertexLayout layout = vertex_layout(format);
    const int offsets[kAttributeCount] = {layout.vertex, layout.normal, layout.tangent, layout.color,
                                          layout.uv,     layout.uv2,    layout.bones,   layout.weights};
    AttributeList list;
    list.stride = layout.stride;
    for (int i = 0; i < kAttributeCount; ++i) {
        if (offsets[i] >= 0) {
            list.items[list.count++] = describe(format, static_cast<Attribute>(i), offsets[i]);
        }
    }
    return list;
}

VertexArray::VertexArray(VertexArray&& other) noexcept
    : id_(std::exchange(other.id_, 0)), index_type_(other.index_type_) {}

VertexArray& VertexArray::operator=(VertexArray&& other) noexcept {
    std::swap(id_, other.id_);
    index_type_ = other.index_type_;
    return *this;
}

VertexArray::~VertexArray() {
    if (id_) {
        State::current().destroy(ObjectKind::VertexArray, id_);
    }
}

VertexArray VertexArray::create(const VertexArrayDesc& desc) {
    State& state = State::current();
    VertexArray array(state.create(ObjectKind::VertexArray),
                      desc.indices ? desc.index_type : IndexType::None);
    state.bind_vertex_array(array.id_);
    if (desc.vertices) {
        state.bind_buffer(GL_ARRAY_BUFFER, desc.vertices->id());
    }
    for (const AttributeDesc& a : desc.attributes) {
        const auto location = static_cast<GLuint>(a.attribute);
        glEnableVertexAttribArray(location);
        glVertexAttribPointer(location, a.components, a.type, a.normalized, desc.stride,
                              gl_offset(static_cast<size_t>(a.offset)));
    }
    if (desc.indices) {
        state.bind_buffer(GL_ELEMENT_ARRAY_BUFFER, desc.indices->id());
    }
    state.label(ObjectKind::VertexArray, array.id_, desc.label);
    return array;
}

VertexArray VertexArray::create_empty() {
    return create({});
}

const void* gl_offset(size_t bytes) noexcept {
    return reinterpret_cast<const void*>(bytes); // NOLINT(performance-no-int-to-ptr): GL's interface
}

GLenum gl_primitive(PrimitiveType type) noexcept {
    static constexpr GLenum kModes[] = {GL_POINTS,    GL_LINES,          GL_LINE_STRIP,  GL_LINE_LOOP,
                                        GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN};
    return kModes[static_cast<size_t>(type)];
}

} // namespace cl::gles3::gl
