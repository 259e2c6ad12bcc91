#pragma once

#include "core/expected.h"
#include "core/math/aabb.h"
#include "core/math/color.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl {

enum class PrimitiveType : uint8_t {
    Points,
    Lines,
    LineStrip,
    LineLoop,
    Triangles,
    TriangleStrip,
    TriangleFan
};

/// Bits of a surface's format word (spec tscn section 9.1): which arrays are there and which are compressed.
namespace surface_format {
inline constexpr uint32_t kVertex = 1u << 0, kNormal = 1u << 1, kTangent = 1u << 2, kColor = 1u << 3;
inline constexpr uint32_t kUV = 1u << 4, kUV2 = 1u << 5, kBones = 1u << 6, kWeights = 1u << 7,
                          kIndex = 1u << 8;
inline constexpr uint32_t kCompressShift = 9; ///< compressed bit of array i = 1 << (i + 9)
inline constexpr uint32_t kDefaultCompression = 97280;
inline constexpr uint32_t k2D = 262144, k16BitBones = 524288, kDynamic = 1048576;
} // namespace surface_format

/// One surface as Godot 3 stores it: interleaved little-endian vertices in the format's layout (which
/// GLES 3.0 reads as they are: half, int8, uint8 attributes), and 16- or 32-bit indices.
struct MeshSurface {
    PrimitiveType primitive = PrimitiveType::Triangles;
    uint32_t format = 0;
    uint32_t vertex_count = 0;
    uint32_t index_count = 0; ///< 0: not indexed
    std::vector<uint8_t> vertices;
    std::vector<uint8_t> indices; ///< uint16 if vertex_count < 65536, else uint32
    AABB aabb;
};

/// Where each array lies in an interleaved vertex, spec tscn section 9.1. Offset -1: absent.
struct VertexLayout {
    int stride = 0; ///< [bytes]
    int vertex = -1, normal = -1, tangent = -1, color = -1, uv = -1, uv2 = -1, bones = -1, weights = -1;
};
[[nodiscard]] VertexLayout vertex_layout(uint32_t format) noexcept;

/// A surface as plain arrays: what primitive meshes make and what the GI bake reads. Empty = absent,
/// otherwise one entry a vertex. tangent.w = sign of the binormal, B = cross(N, T) * w.
struct SurfaceArrays {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<Color> colors;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec2> uv2s;
    std::vector<glm::ivec4> bones;
    std::vector<glm::vec4> weights;
    std::vector<uint32_t> indices;
};

/// Packs arrays with Godot's default compression (int8 normals and tangents, uint8 colours, truncated half
/// UVs).
/// @param compression  compressed bits; those of absent arrays are kept in the format, as Godot does.
/// @return InvalidArgument if there are no positions or an array's length does not match them, bones come
/// without
///         weights (or the reverse), a bone is not in 0..65535, or an index is out of range.
/// Source: spec tscn section 9.1.
[[nodiscard]] Expected<MeshSurface>
encode_surface(const SurfaceArrays& arrays, PrimitiveType primitive,
               uint32_t compression = surface_format::kDefaultCompression);

/// Unpacks a surface: the values the GPU would read (int8 / 127 etc.). Vertices of 2D surfaces get z = 0.
/// @return what validate_surface() says of it, if that is an error.
[[nodiscard]] Expected<SurfaceArrays> decode_surface(const MeshSurface& surface);

/// Checks sizes, counts and index range without decoding.
/// @return ParseError "surface: expected ..., found ..." if byte sizes do not match the format, or an index
/// is out
///         of range.
[[nodiscard]] Status validate_surface(const MeshSurface& surface);

/// Old files stored a compressed 3D vertex in 6 bytes; gives those vertices the 8 bytes of vertex_layout().
/// Anything else is left alone, so that it may be called on every surface read from a file (spec tscn
/// section 9.1).
void widen_old_vertices(MeshSurface& surface);

/// IEEE half from float as Godot does it: mantissa truncated, below 2^-14 to 0, from 65536 to infinity. NaN
/// stays NaN (spec tscn section 9.1).
[[nodiscard]] uint16_t half_from_float_truncated(float v) noexcept;
[[nodiscard]] float float_from_half(uint16_t h) noexcept;

} // namespace cl
