#include "scene/resources/surface_arrays.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace cl::scene {

namespace {

constexpr std::array<std::string_view, 9> kNames{"vertex", "normal", "tangent", "color", "uv",
                                                 "uv2",    "bones",  "weights", "index"};

Error wrong_type(size_t entry, std::string_view expected, const Variant& found) {
    return {ErrorCode::ParseError, fmt::format("expected a {} as {} array, found {}", expected, kNames[entry],
                                               type_name(found.type()))};
}

Error not_a_multiple(size_t entry, size_t found) {
    return {
        ErrorCode::ParseError,
        fmt::format("expected 4 numbers a vertex in the {} array, found {} numbers", kNames[entry], found)};
}

Status read_positions(const Variant& value, std::vector<glm::vec3>& out) {
    if (const auto* flat = value.get_if<PoolVector2Array>()) {
        for (const glm::vec2& p : flat->span()) {
            out.emplace_back(p, 0.0f);
        }
        return {};
    }
    const auto* positions = value.get_if<PoolVector3Array>();
    if (!positions) {
        return wrong_type(0, "PoolVector3Array", value);
    }
    out.assign(positions->span().begin(), positions->span().end());
    return {};
}

template <typename T>
Status read_exact(const Variant& value, size_t entry, std::string_view expected, std::vector<T>& out) {
    if (value.is_nil()) {
        return {};
    }
    const auto* values = value.get_if<PoolArray<T>>();
    if (!values) {
        return wrong_type(entry, expected, value);
    }
    out.assign(values->span().begin(), values->span().end());
    return {};
}

Status read_uvs(const Variant& value, size_t entry, std::vector<glm::vec2>& out) {
    if (const auto* deep = value.get_if<PoolVector3Array>()) {
        for (const glm::vec3& uv : deep->span()) {
            out.emplace_back(uv.x, uv.y);
        }
        return {};
    }
    return read_exact(value, entry, "PoolVector2Array", out);
}

Status read_fours(const Variant& value, size_t entry, std::vector<glm::vec4>& out) {
    std::vector<float> flat;
    if (Status read = read_exact(value, entry, "PoolRealArray", flat); !read) {
        return read;
    }
    if (flat.size() % 4 != 0) {
        return not_a_multiple(entry, flat.size());
    }
    for (size_t i = 0; i + 3 < flat.size(); i += 4) {
        out.emplace_back(flat[i], flat[i + 1], flat[i + 2], flat[i + 3]);
    }
    return {};
}

int bone_from_real(float v) {
    return std::isfinite(v) && v >= 0.0f && v <= 65535.0f ? static_cast<int>(v) : 0;
}

Status read_bones(const Variant& value, std::vector<glm::ivec4>& out) {
    constexpr size_t kEntry = 6;
    if (const auto* reals = value.get_if<PoolRealArray>()) {
        std::vector<int32_t> ints;
        for (float v : reals->span()) {
            ints.push_back(bone_from_real(v));
        }
        return read_bones(PoolIntArray(std::move(ints)), out);
    }
    std::vector<int32_t> flat;
    if (Status read = read_exact(value, kEntry, "PoolIntArray", flat); !read) {
        return read;
    }
    if (flat.size() % 4 != 0) {
        return not_a_multiple(kEntry, flat.size());
    }
    for (size_t i = 0; i + 3 < flat.size(); i += 4) {
        out.emplace_back(flat[i], flat[i + 1], flat[i + 2], flat[i + 3]);
    }
    return {};
}

Status read_indices(const Variant& value, std::vector<uint32_t>& out) {
    std::vector<int32_t> signed_indices;
    if (Status read = read_exact(value, 8, "PoolIntArray", signed_indices); !read) {
        return read;
    }
    out.assign(signed_indices.begin(),
               signed_indices.end()); // negative ones become huge and are refused as such
    return {};
}

} // namespace

Expected<SurfaceArrays> surface_arrays_from_variants(const Array& entries) {
    if (entries.size() != kNames.size()) {
        return Error{ErrorCode::ParseError,
                     fmt::format("expected 9 entries in \"arrays\", found {}", entries.size())};
    }
    SurfaceArrays arrays;
    const Status reads[] = {
        read_positions(entries[0], arrays.positions),
        read_exact(entries[1], 1, "PoolVector3Array", arrays.normals),
        read_fours(entries[2], 2, arrays.tangents),
        read_exact(entries[3], 3, "PoolColorArray", arrays.colors),
        read_uvs(entries[4], 4, arrays.uvs),
        read_uvs(entries[5], 5, arrays.uv2s),
        read_bones(entries[6], arrays.bones),
        read_fours(entries[7], 7, arrays.weights),
        read_indices(entries[8], arrays.indices),
    };
    for (const Status& read : reads) {
        if (!read) {
            return read.error();
        }
    }
    return arrays;
}

} // namespace cl::scene
