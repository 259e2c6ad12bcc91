#include "scene/resources/surface_dictionary.h"

#include "scene/resources/surface_arrays.h"

#include <fmt/format.h>

namespace cl::scene {

using namespace std::string_view_literals;

namespace {

Error parse_error(std::string message) {
    return {ErrorCode::ParseError, std::move(message)};
}

Error wrong_entry(std::string_view key, std::string_view expected, const Variant* found) {
    return parse_error(fmt::format("expected {} in \"{}\", found {}", expected, key,
                                   found ? type_name(found->type()) : std::string_view("none")));
}

/// The value of `key` if it is exactly a T.
template <typename T>
Expected<const T*> entry(const Dictionary& d, std::string_view key, std::string_view expected) {
    const Variant* value = d.find(key);
    const T* exact = value ? value->get_if<T>() : nullptr;
    if (!exact) {
        return wrong_entry(key, expected, value);
    }
    return exact;
}

Expected<uint32_t> count_entry(const Dictionary& d, std::string_view key) {
    const Expected<const int64_t*> value = entry<int64_t>(d, key, "an int");
    if (!value) {
        return value.error();
    }
    if (**value < 0 || **value > 0xFFFFFFFFll) {
        return parse_error(fmt::format("expected \"{}\" from 0 to 4294967295, found {}", key, **value));
    }
    return static_cast<uint32_t>(**value);
}

Expected<PrimitiveType> primitive_entry(const Dictionary& d) {
    const Expected<uint32_t> number = count_entry(d, "primitive");
    if (!number) {
        return number.error();
    }
    if (*number > static_cast<uint32_t>(PrimitiveType::TriangleFan)) {
        return parse_error(fmt::format("expected \"primitive\" from 0 to 6, found {}", *number));
    }
    return static_cast<PrimitiveType>(*number);
}

ArrayMesh::SurfaceExtras read_extras(const Dictionary& d) {
    ArrayMesh::SurfaceExtras extras;
    if (const Variant* name = d.find("name"sv)) {
        extras.name = name->to_text();
    }
    if (const Variant* material = d.find("material"sv)) {
        extras.material = Ref<Material>(dynamic_cast<Material*>(material->to_object()));
    }
    if (const Variant* shapes = d.find("blend_shape_data"sv); shapes && shapes->get_if<Array>()) {
        extras.blend_shape_data = *shapes->get_if<Array>();
    }
    if (const Variant* boxes = d.find("skeleton_aabb"sv); boxes && boxes->get_if<Array>()) {
        extras.skeleton_aabbs = *boxes->get_if<Array>();
    }
    return extras;
}

/// Godot 3.0 stored a compressed position as three halves; since 3.1 a fourth, 1.0, pads it.
void widen_old_positions(MeshSurface& surface) {
    constexpr uint32_t kHalfPositions = surface_format::kVertex << surface_format::kCompressShift;
    if (!(surface.format & kHalfPositions) || (surface.format & surface_format::k2D)) {
        return;
    }
    const uint64_t stride = static_cast<uint64_t>(vertex_layout(surface.format).stride);
    if (stride < 8 || surface.vertices.size() != (stride - 2) * surface.vertex_count) {
        return;
    }
    std::vector<uint8_t> wide(stride * surface.vertex_count);
    for (uint64_t i = 0; i < surface.vertex_count; ++i) {
        const uint8_t* from = surface.vertices.data() + i * (stride - 2);
        uint8_t* to = wide.data() + i * stride;
        std::copy(from, from + 6, to);
        to[6] = 0x00; // half 1.0
        to[7] = 0x3C;
        std::copy(from + 6, from + stride - 2, to + 8);
    }
    surface.vertices = std::move(wide);
}

Expected<StoredSurface> from_packed(const Dictionary& d) {
    StoredSurface result;
    MeshSurface& surface = result.surface;
    const Expected<PrimitiveType> primitive = primitive_entry(d);
    const Expected<uint32_t> format = count_entry(d, "format");
    const Expected<uint32_t> vertex_count = count_entry(d, "vertex_count");
    const Expected<const PoolByteArray*> vertices = entry<PoolByteArray>(d, "array_data", "a PoolByteArray");
    const Expected<const AABB*> aabb = entry<AABB>(d, "aabb", "an AABB");
    for (const Error* error : {primitive ? nullptr : &primitive.error(), format ? nullptr : &format.error(),
                               vertex_count ? nullptr : &vertex_count.error(),
                               vertices ? nullptr : &vertices.error(), aabb ? nullptr : &aabb.error()}) {
        if (error) {
            return *error;
        }
    }
    surface.primitive = *primitive;
    surface.format = *format;
    surface.vertex_count = *vertex_count;
    surface.aabb = **aabb;
    surface.vertices.assign((*vertices)->span().begin(), (*vertices)->span().end());
    if (d.find("index_count"sv)) {
        const Expected<uint32_t> index_count = count_entry(d, "index_count");
        if (!index_count) {
            return index_count.error();
        }
        surface.index_count = *index_count;
    }
    if (surface.index_count > 0) {
        const Expected<const PoolByteArray*> indices =
            entry<PoolByteArray>(d, "array_index_data", "a PoolByteArray");
        if (!indices) {
            return indices.error();
        }
        surface.indices.assign((*indices)->span().begin(), (*indices)->span().end());
    }
    widen_old_positions(surface);
    if (const Status valid = validate_surface(surface); !valid) {
        return valid.error();
    }
    result.extras = read_extras(d);
    return result;
}

Expected<StoredSurface> from_arrays(const Dictionary& d, const Array& arrays) {
    const Expected<PrimitiveType> primitive = primitive_entry(d);
    if (!primitive) {
        return primitive.error();
    }
    const Variant* morphs = d.find("morph_arrays"sv);
    if (!morphs || !morphs->get_if<Array>()) {
        return wrong_entry("morph_arrays", "an Array", morphs); // Godot drops a surface without it, too
    }
    const Expected<SurfaceArrays> plain = surface_arrays_from_variants(arrays);
    if (!plain) {
        return plain.error();
    }
    Expected<MeshSurface> surface = encode_surface(*plain, *primitive);
    if (!surface) {
        return surface.error();
    }
    StoredSurface result{std::move(*surface), read_extras(d)};
    for (const Variant& morph : *morphs->get_if<Array>()) {
        const Array* entries = morph.get_if<Array>();
        Expected<SurfaceArrays> shape =
            entries ? surface_arrays_from_variants(*entries)
                    : Expected<SurfaceArrays>(wrong_entry("morph_arrays", "Arrays", &morph));
        if (!shape) {
            return shape.error();
        }
        shape->indices.clear();
        const Expected<MeshSurface> packed = encode_surface(*shape, *primitive);
        if (!packed) {
            return packed.error();
        }
        result.extras.blend_shape_data.push_back(PoolByteArray(packed->vertices));
    }
    return result;
}

} // namespace

Expected<StoredSurface> surface_from_dictionary(const Dictionary& dictionary) {
    if (const Variant* arrays = dictionary.find("arrays"sv)) {
        const Array* list = arrays->get_if<Array>();
        return list ? from_arrays(dictionary, *list)
                    : Expected<StoredSurface>(wrong_entry("arrays", "an Array", arrays));
    }
    return from_packed(dictionary);
}

Dictionary dictionary_from_surface(const MeshSurface& surface, const ArrayMesh::SurfaceExtras& extras) {
    Dictionary d;
    d.set("aabb", surface.aabb);
    d.set("array_data", PoolByteArray(surface.vertices));
    d.set("array_index_data", PoolByteArray(surface.indices));
    d.set("blend_shape_data", extras.blend_shape_data);
    d.set("format", static_cast<int64_t>(surface.format));
    d.set("index_count", static_cast<int64_t>(surface.index_count));
    if (extras.material) {
        d.set("material", extras.material);
    }
    if (!extras.name.empty()) {
        d.set("name", extras.name);
    }
    d.set("primitive", static_cast<int64_t>(surface.primitive));
    d.set("skeleton_aabb", extras.skeleton_aabbs);
    d.set("vertex_count", static_cast<int64_t>(surface.vertex_count));
    return d;
}

} // namespace cl::scene
