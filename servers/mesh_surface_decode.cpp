// Arrays from interleaved bytes (spec tscn section 9.1).
#include "servers/mesh_surface.h"

#include <algorithm>
#include <cstring>

namespace cl {

namespace {

using namespace surface_format;

/// As GL reads normalised signed bytes: -128 is -1. Times the reciprocal, whose last bit is Godot's; a GI
/// bake of a sphere shows the difference.
float from_snorm8(uint8_t byte) {
    return std::max(float(int8_t(byte)) * (1.0f / 127.0f), -1.0f);
}

template <typename T>
T read(const uint8_t* from, int i) {
    T value;
    std::memcpy(&value, from + size_t(i) * sizeof(T), sizeof value);
    return value;
}

template <int N>
glm::vec<N, float> read_floats(const uint8_t* from, bool halves) {
    glm::vec<N, float> v(0.0f);
    for (int i = 0; i < N; ++i) {
        v[i] = halves ? float_from_half(read<uint16_t>(from, i)) : read<float>(from, i);
    }
    return v;
}

template <int N>
glm::vec<N, float> read_snorm8_or_floats(const uint8_t* from, bool compressed) {
    if (!compressed) {
        return read_floats<N>(from, false);
    }
    glm::vec<N, float> v(0.0f);
    for (int i = 0; i < N; ++i) {
        v[i] = from_snorm8(from[i]);
    }
    return v;
}

bool compressed(uint32_t format, uint32_t bit) {
    return (format & (bit << kCompressShift)) != 0;
}

Color read_color(const uint8_t* from, bool as_bytes) {
    if (as_bytes) {
        return {float(from[0]) / 255.0f, float(from[1]) / 255.0f, float(from[2]) / 255.0f,
                float(from[3]) / 255.0f};
    }
    return {read<float>(from, 0), read<float>(from, 1), read<float>(from, 2), read<float>(from, 3)};
}

glm::ivec4 read_bones(const uint8_t* from, bool wide) {
    glm::ivec4 bones(0);
    for (int i = 0; i < 4; ++i) {
        bones[i] = wide ? int(read<uint16_t>(from, i)) : int(from[i]);
    }
    return bones;
}

glm::vec4 read_weights(const uint8_t* from, bool as_words) {
    glm::vec4 weights(0.0f);
    for (int i = 0; i < 4; ++i) {
        weights[i] = as_words ? float(read<uint16_t>(from, i)) / 65535.0f : read<float>(from, i);
    }
    return weights;
}

glm::vec3 read_position(const uint8_t* from, uint32_t format) {
    const bool halves = compressed(format, kVertex);
    return (format & k2D) ? glm::vec3(read_floats<2>(from, halves), 0.0f) : read_floats<3>(from, halves);
}

/// Fills `out` with one value a vertex, if the array at `offset` is there.
template <typename T, typename Read>
void decode_array(const MeshSurface& surface, int stride, int offset, std::vector<T>& out, Read read_one) {
    if (offset < 0) {
        return;
    }
    out.resize(surface.vertex_count);
    const uint8_t* from = surface.vertices.data() + offset;
    for (T& value : out) {
        value = read_one(from);
        from += stride;
    }
}

std::vector<uint32_t> decode_indices(const MeshSurface& surface) {
    std::vector<uint32_t> indices(surface.index_count);
    const bool narrow = surface.vertex_count < 65536;
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint8_t* from = surface.indices.data() + i * (narrow ? 2 : 4);
        indices[i] = narrow ? uint32_t(read<uint16_t>(from, 0)) : read<uint32_t>(from, 0);
    }
    return indices;
}

} // namespace

Expected<SurfaceArrays> decode_surface(const MeshSurface& surface) {
    if (Status valid = validate_surface(surface); !valid) {
        return valid.error();
    }
    const uint32_t format = surface.format;
    const VertexLayout at = vertex_layout(format);
    const auto decode = [&](int offset, auto& out, auto read_one) {
        decode_array(surface, at.stride, offset, out, read_one);
    };
    SurfaceArrays arrays;
    decode(at.vertex, arrays.positions, [&](const uint8_t* p) { return read_position(p, format); });
    decode(at.normal, arrays.normals,
           [&](const uint8_t* p) { return read_snorm8_or_floats<3>(p, compressed(format, kNormal)); });
    decode(at.tangent, arrays.tangents,
           [&](const uint8_t* p) { return read_snorm8_or_floats<4>(p, compressed(format, kTangent)); });
    decode(at.color, arrays.colors,
           [&](const uint8_t* p) { return read_color(p, compressed(format, kColor)); });
    decode(at.uv, arrays.uvs, [&](const uint8_t* p) { return read_floats<2>(p, compressed(format, kUV)); });
    decode(at.uv2, arrays.uv2s,
           [&](const uint8_t* p) { return read_floats<2>(p, compressed(format, kUV2)); });
    decode(at.bones, arrays.bones,
           [&](const uint8_t* p) { return read_bones(p, (format & k16BitBones) != 0); });
    decode(at.weights, arrays.weights,
           [&](const uint8_t* p) { return read_weights(p, compressed(format, kWeights)); });
    arrays.indices = decode_indices(surface);
    return arrays;
}

} // namespace cl
