#include "servers/mesh_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace cl {

namespace {

constexpr bool has(uint32_t format, uint32_t bit) {
    return (format & bit) != 0;
}
constexpr bool is_compressed(uint32_t format, uint32_t bit) {
    return has(format, bit << surface_format::kCompressShift);
}

/// Bytes of one vertex of the array whose present bit is `bit`.
int array_size(uint32_t format, uint32_t bit) noexcept {
    using namespace surface_format;
    const bool compressed = is_compressed(format, bit);
    switch (bit) {
    case kVertex:
        return has(format, k2D) ? (compressed ? 4 : 8) : (compressed ? 8 : 12);
    case kNormal:
        return compressed ? 4 : 12;
    case kUV:
    case kUV2:
        return compressed ? 4 : 8;
    case kBones:
        return has(format, k16BitBones) ? 8 : 4; // its compressed bit is unused
    case kWeights:
        return compressed ? 8 : 16;
    default:
        return compressed ? 4 : 16; // tangent, colour
    }
}

Error parse_error(std::string message) {
    return {ErrorCode::ParseError, "surface: " + std::move(message)};
}

template <typename Index>
Status check_index_range(const MeshSurface& surface) {
    for (uint32_t i = 0; i < surface.index_count; ++i) {
        Index index = 0;
        std::memcpy(&index, surface.indices.data() + size_t(i) * sizeof(Index), sizeof(Index));
        if (index >= surface.vertex_count) {
            return parse_error(
                fmt::format("expected index {} below {} vertices, found {}", i, surface.vertex_count, index));
        }
    }
    return {};
}

bool has_old_vertices(const MeshSurface& surface, const VertexLayout& layout) {
    using namespace surface_format;
    const bool compressed_3d =
        has(surface.format, kVertex) && is_compressed(surface.format, kVertex) && !has(surface.format, k2D);
    return compressed_3d && surface.vertex_count > 0 &&
           surface.vertices.size() == uint64_t(layout.stride - 2) * surface.vertex_count;
}

} // namespace

VertexLayout vertex_layout(uint32_t format) noexcept {
    using namespace surface_format;
    VertexLayout layout;
    const auto place = [&](uint32_t bit, int& offset) {
        if (has(format, bit)) {
            offset = layout.stride;
            layout.stride += array_size(format, bit);
        }
    };
    place(kVertex, layout.vertex);
    place(kNormal, layout.normal);
    place(kTangent, layout.tangent);
    place(kColor, layout.color);
    place(kUV, layout.uv);
    place(kUV2, layout.uv2);
    place(kBones, layout.bones);
    place(kWeights, layout.weights);
    return layout;
}

Status validate_surface(const MeshSurface& surface) {
    using namespace surface_format;
    if (!has(surface.format, kVertex)) {
        return parse_error(fmt::format("expected a format with vertices (bit 1), found {}", surface.format));
    }
    if (has(surface.format, kBones) != has(surface.format, kWeights)) {
        return parse_error(
            fmt::format("expected bones and weights both or neither, found format {}", surface.format));
    }
    if (surface.vertex_count == 0) {
        return parse_error("expected at least 1 vertex, found 0");
    }
    const VertexLayout layout = vertex_layout(surface.format);
    const uint64_t vertex_bytes = uint64_t(layout.stride) * surface.vertex_count;
    if (surface.vertices.size() != vertex_bytes) {
        return parse_error(fmt::format("expected {} vertices of {} bytes, found {} bytes",
                                       surface.vertex_count, layout.stride, surface.vertices.size()));
    }
    const int index_size = surface.vertex_count < 65536 ? 2 : 4;
    if (surface.indices.size() != uint64_t(index_size) * surface.index_count) {
        return parse_error(fmt::format("expected {} indices of {} bytes, found {} bytes", surface.index_count,
                                       index_size, surface.indices.size()));
    }
    return index_size == 2 ? check_index_range<uint16_t>(surface) : check_index_range<uint32_t>(surface);
}

void widen_old_vertices(MeshSurface& surface) {
    const VertexLayout layout = vertex_layout(surface.format);
    if (!has_old_vertices(surface, layout)) {
        return;
    }
    constexpr size_t kOldVertex = 6;
    constexpr uint8_t kHalfOne[2] = {0x00, 0x3C}; // 1.0, little-endian: what the fourth half holds
    const size_t new_stride = size_t(layout.stride);
    const size_t old_stride = new_stride - sizeof kHalfOne;
    std::vector<uint8_t> wide(new_stride * surface.vertex_count);
    for (size_t i = 0; i < surface.vertex_count; ++i) {
        const uint8_t* from = surface.vertices.data() + i * old_stride;
        uint8_t* to = wide.data() + i * new_stride;
        to = std::copy_n(from, kOldVertex, to);
        to = std::copy_n(kHalfOne, sizeof kHalfOne, to);
        std::copy(from + kOldVertex, from + old_stride, to);
    }
    surface.vertices = std::move(wide);
}

uint16_t half_from_float_truncated(float v) noexcept {
    uint32_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    const uint32_t sign = (bits >> 16) & 0x8000u;
    const uint32_t magnitude = bits & 0x7FFFFFFFu;
    constexpr uint32_t kInfinity = 0x7F800000u; // float
    constexpr uint32_t kTwoTo16 = 0x47800000u;  // 65536.0f
    constexpr uint32_t kTwoToMinus14 = 0x38800000u;
    if (magnitude > kInfinity) {
        return uint16_t(sign | 0x7E00u);
    }
    if (magnitude >= kTwoTo16) {
        return uint16_t(sign | 0x7C00u);
    }
    if (magnitude < kTwoToMinus14) {
        return 0; // the sign goes, too: checked with Godot 3.2.3
    }
    constexpr uint32_t kBiasChange = (127u - 15u) << 23;
    return uint16_t(sign | ((magnitude - kBiasChange) >> 13));
}

float float_from_half(uint16_t h) noexcept {
    const float sign = (h & 0x8000u) ? -1.0f : 1.0f;
    const uint32_t magnitude = h & 0x7FFFu;
    constexpr uint32_t kInfinity = 0x7C00u, kOneOver2To14 = 0x0400u;
    if (magnitude >= kInfinity) {
        return magnitude > kInfinity ? std::numeric_limits<float>::quiet_NaN()
                                     : sign * std::numeric_limits<float>::infinity();
    }
    if (magnitude < kOneOver2To14) { // denormal: no multiple of a float that some thread takes for 0
        return sign * float(magnitude) * 0x1p-24f;
    }
    constexpr uint32_t kBiasChange = (127u - 15u) << 23;
    return sign * std::bit_cast<float>((magnitude << 13) + kBiasChange);
}

} // namespace cl
