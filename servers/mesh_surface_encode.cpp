// Interleaved bytes from arrays (spec tscn section 9.1).
#include "servers/mesh_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace cl {

namespace {

using namespace surface_format;

/// Truncates toward zero inside [lo, hi]; NaN gives 0, so that no input is undefined behaviour.
int truncated(float v, float lo, float hi) {
    return std::isnan(v) ? 0 : int(std::clamp(v, lo, hi));
}

uint8_t snorm8(float v) {
    return uint8_t(int8_t(truncated(v * 127.0f, -128.0f, 127.0f)));
}
uint8_t unorm8(float v) {
    return uint8_t(truncated(v * 255.0f, 0.0f, 255.0f));
}
uint16_t unorm16(float v) {
    return uint16_t(truncated(v * 65535.0f, 0.0f, 65535.0f));
}

/// Writes little-endian numbers one after the other (every machine we build for is little-endian).
class Writer {
public:
    explicit Writer(uint8_t* to) : to_(to) {}
    template <typename T>
    void put(T value) {
        std::memcpy(to_, &value, sizeof value);
        to_ += sizeof value;
    }
    template <int N, typename V>
    void put_floats(const V& v) {
        for (int i = 0; i < N; ++i) {
            put(float(v[i]));
        }
    }
    template <int N, typename V>
    void put_halves(const V& v) {
        for (int i = 0; i < N; ++i) {
            put(half_from_float_truncated(v[i]));
        }
    }
    template <int N, typename V>
    void put_snorm8(const V& v) {
        for (int i = 0; i < N; ++i) {
            put(snorm8(v[i]));
        }
    }

private:
    uint8_t* to_;
};

bool compressed(uint32_t format, uint32_t bit) {
    return (format & (bit << kCompressShift)) != 0;
}

Error invalid(std::string message) {
    return {ErrorCode::InvalidArgument, "surface: " + std::move(message)};
}

Status check_lengths(const SurfaceArrays& a) {
    const size_t n = a.positions.size();
    const struct {
        const char* name;
        size_t length;
    } arrays[] = {{"normals", a.normals.size()}, {"tangents", a.tangents.size()}, {"colors", a.colors.size()},
                  {"uvs", a.uvs.size()},         {"uv2s", a.uv2s.size()},         {"bones", a.bones.size()},
                  {"weights", a.weights.size()}};
    for (const auto& array : arrays) {
        if (array.length != 0 && array.length != n) {
            return invalid(
                fmt::format("expected {} {}, one a vertex, found {}", n, array.name, array.length));
        }
    }
    return {};
}

Status check_arrays(const SurfaceArrays& a) {
    if (a.positions.empty() || a.positions.size() > std::numeric_limits<uint32_t>::max()) {
        return invalid(fmt::format("expected 1 to 4294967295 positions, found {}", a.positions.size()));
    }
    if (a.indices.size() > std::numeric_limits<uint32_t>::max()) {
        return invalid(fmt::format("expected at most 4294967295 indices, found {}", a.indices.size()));
    }
    if (Status lengths = check_lengths(a); !lengths) {
        return lengths;
    }
    if (a.bones.empty() != a.weights.empty()) {
        return invalid("expected bones and weights both or neither, found one of them");
    }
    for (const glm::ivec4& bones : a.bones) {
        for (int i = 0; i < 4; ++i) {
            if (bones[i] < 0 || bones[i] > 65535) {
                return invalid(fmt::format("expected bones in 0 to 65535, found {}", bones[i]));
            }
        }
    }
    for (size_t i = 0; i < a.indices.size(); ++i) {
        if (a.indices[i] >= a.positions.size()) {
            return invalid(fmt::format("expected index {} below {} vertices, found {}", i, a.positions.size(),
                                       a.indices[i]));
        }
    }
    return {};
}

uint32_t format_of(const SurfaceArrays& a, uint32_t compression) {
    const bool wide_bones = std::any_of(a.bones.begin(), a.bones.end(), [](const glm::ivec4& b) {
        return std::max(std::max(b.x, b.y), std::max(b.z, b.w)) > 255;
    });
    return compression | kVertex | (a.normals.empty() ? 0 : kNormal) | (a.tangents.empty() ? 0 : kTangent) |
           (a.colors.empty() ? 0 : kColor) | (a.uvs.empty() ? 0 : kUV) | (a.uv2s.empty() ? 0 : kUV2) |
           (a.bones.empty() ? 0 : kBones) | (a.weights.empty() ? 0 : kWeights) |
           (a.indices.empty() ? 0 : kIndex) | (wide_bones ? k16BitBones : 0);
}

void put_position(Writer out, const glm::vec3& p, uint32_t format) {
    if (compressed(format, kVertex)) {
        out.put_halves<4>(glm::vec4(p, 1.0f));
    } else {
        out.put_floats<3>(p);
    }
}

template <int N, typename V>
void put_direction(Writer out, const V& v, bool as_bytes) {
    if (as_bytes) {
        out.put_snorm8<4>(glm::vec4(v, glm::vec<4 - N, float>(0.0f)));
    } else {
        out.put_floats<N>(v);
    }
}
template <>
void put_direction<4, glm::vec4>(Writer out, const glm::vec4& v, bool as_bytes) {
    if (as_bytes) {
        out.put_snorm8<4>(v);
    } else {
        out.put_floats<4>(v);
    }
}

void put_color(Writer out, const Color& c, bool as_bytes) {
    for (const float v : {c.r, c.g, c.b, c.a}) {
        if (as_bytes) {
            out.put(unorm8(v));
        } else {
            out.put(v);
        }
    }
}

void put_uv(Writer out, const glm::vec2& uv, bool as_halves) {
    if (as_halves) {
        out.put_halves<2>(uv);
    } else {
        out.put_floats<2>(uv);
    }
}

void put_bones(Writer out, const glm::ivec4& bones, bool wide) {
    for (int i = 0; i < 4; ++i) {
        if (wide) {
            out.put(uint16_t(bones[i]));
        } else {
            out.put(uint8_t(bones[i]));
        }
    }
}

void put_weights(Writer out, const glm::vec4& weights, bool as_words) {
    for (int i = 0; i < 4; ++i) {
        if (as_words) {
            out.put(unorm16(weights[i]));
        } else {
            out.put(weights[i]);
        }
    }
}

void put_vertex(const SurfaceArrays& a, size_t i, uint32_t format, const VertexLayout& at, uint8_t* vertex) {
    put_position(Writer(vertex + at.vertex), a.positions[i], format);
    if (at.normal >= 0) {
        put_direction<3>(Writer(vertex + at.normal), a.normals[i], compressed(format, kNormal));
    }
    if (at.tangent >= 0) {
        put_direction<4>(Writer(vertex + at.tangent), a.tangents[i], compressed(format, kTangent));
    }
    if (at.color >= 0) {
        put_color(Writer(vertex + at.color), a.colors[i], compressed(format, kColor));
    }
    if (at.uv >= 0) {
        put_uv(Writer(vertex + at.uv), a.uvs[i], compressed(format, kUV));
    }
    if (at.uv2 >= 0) {
        put_uv(Writer(vertex + at.uv2), a.uv2s[i], compressed(format, kUV2));
    }
    if (at.bones >= 0) {
        put_bones(Writer(vertex + at.bones), a.bones[i], (format & k16BitBones) != 0);
        put_weights(Writer(vertex + at.weights), a.weights[i], compressed(format, kWeights));
    }
}

/// Starts as the first vertex with a size of 1e-5 on each axis, then grows (spec tscn section 9.1, `aabb`).
AABB bounds_of(const std::vector<glm::vec3>& positions) {
    glm::vec3 lo = positions.front();
    glm::vec3 hi = lo + 1e-5f;
    for (const glm::vec3& p : positions) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    return {lo, hi - lo};
}

std::vector<uint8_t> packed_indices(const SurfaceArrays& a) {
    if (a.positions.size() < 65536) {
        std::vector<uint8_t> bytes(a.indices.size() * 2);
        Writer out(bytes.data());
        for (const uint32_t index : a.indices) {
            out.put(uint16_t(index));
        }
        return bytes;
    }
    std::vector<uint8_t> bytes(a.indices.size() * 4);
    if (!bytes.empty()) {
        std::memcpy(bytes.data(), a.indices.data(), bytes.size());
    }
    return bytes;
}

} // namespace

Expected<MeshSurface> encode_surface(const SurfaceArrays& arrays, PrimitiveType primitive,
                                     uint32_t compression) {
    if (Status checked = check_arrays(arrays); !checked) {
        return checked.error();
    }
    constexpr uint32_t kCompressionBits = 0x1FFu << kCompressShift;
    MeshSurface surface;
    surface.primitive = primitive;
    surface.format = format_of(arrays, compression & kCompressionBits);
    surface.vertex_count = uint32_t(arrays.positions.size());
    surface.index_count = uint32_t(arrays.indices.size());
    const VertexLayout layout = vertex_layout(surface.format);
    surface.vertices.resize(size_t(layout.stride) * surface.vertex_count);
    for (size_t i = 0; i < surface.vertex_count; ++i) {
        put_vertex(arrays, i, surface.format, layout, surface.vertices.data() + i * size_t(layout.stride));
    }
    surface.indices = packed_indices(arrays);
    surface.aabb = bounds_of(arrays.positions);
    return surface;
}

} // namespace cl
