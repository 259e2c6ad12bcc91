#include "scene/resources/array_mesh.h"

#include "scene/resources/surface_dictionary.h"

#include "core/object/class_registry.h"

#include <fmt/format.h>

#include <charconv>

namespace cl::scene {

namespace {

constexpr std::string_view kSurfacePrefix = "surfaces/";
constexpr std::string_view kNames = "blend_shape/names", kMode = "blend_shape/mode";

/// All of `text` as a number from 0; -1 if it is not one.
int index_from(std::string_view text) {
    int index = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    return error == std::errc() && end == text.data() + text.size() && index >= 0 ? index : -1;
}

/// `surface_<i + 1>/<what>`: another spelling, read only.
struct SurfaceField {
    int surface = -1;
    std::string_view what;
};
SurfaceField surface_field(std::string_view property) {
    constexpr std::string_view kPrefix = "surface_";
    const size_t slash = property.find('/');
    if (property.substr(0, kPrefix.size()) != kPrefix || slash == std::string_view::npos) {
        return {};
    }
    const int number = index_from(property.substr(kPrefix.size(), slash - kPrefix.size()));
    return {number - 1, property.substr(slash + 1)};
}

} // namespace

void ArrayMesh::bind(ClassBuilder<ArrayMesh>& c) {
    c.doc("A mesh of stored surfaces.").dynamic();
    c.property(
         "blend_shape_mode", [](const ArrayMesh& m) { return m.blend_shape_mode_; },
         [](ArrayMesh& m, int mode) { m.blend_shape_mode_ = mode; })
        .enumeration("Normalized,Relative")
        .doc("How blend shapes add up; stored only.");
    c.property("custom_aabb", &ArrayMesh::custom_aabb, &ArrayMesh::set_custom_aabb)
        .doc("Box for culling [m] in place of the mesh's own; zero size: none.");
}

Status ArrayMesh::add_surface(MeshSurface surface, SurfaceExtras extras) {
    if (Status valid = validate_surface(surface); !valid) {
        return valid;
    }
    surfaces_.push_back(std::move(surface));
    extras_.push_back(std::move(extras));
    surfaces_changed();
    return {};
}

Status ArrayMesh::add_surface_from_arrays(const SurfaceArrays& arrays, PrimitiveType primitive,
                                          SurfaceExtras extras) {
    Expected<MeshSurface> surface = encode_surface(arrays, primitive);
    if (!surface) {
        return surface.error();
    }
    return add_surface(std::move(*surface), std::move(extras));
}

void ArrayMesh::clear_surfaces() {
    surfaces_.clear();
    extras_.clear();
    surfaces_changed();
}

void ArrayMesh::set_surface_material(int surface, Ref<Material> material) {
    if (surface < 0 || surface >= surface_count()) {
        return;
    }
    extras_[surface].material = std::move(material);
    surface_material_changed(surface);
}

Ref<Material> ArrayMesh::surface_material(int surface) const {
    return surface >= 0 && surface < static_cast<int>(extras_.size()) ? extras_[surface].material : nullptr;
}

SetResult ArrayMesh::refuse(std::string why) {
    refusal_ = std::move(why);
    return SetResult::Refused;
}

SetResult ArrayMesh::set_surface(std::string_view index, const Variant& value) {
    if (index_from(index) != surface_count()) {
        return refuse(fmt::format("expected surfaces/{} next, found surfaces/{}", surface_count(), index));
    }
    const Dictionary* dictionary = value.get_if<Dictionary>();
    if (!dictionary) {
        return SetResult::WrongType;
    }
    Expected<StoredSurface> stored = surface_from_dictionary(*dictionary);
    if (!stored) {
        return refuse(stored.error().message);
    }
    surfaces_.push_back(std::move(stored->surface)); // validated where it was read
    extras_.push_back(std::move(stored->extras));
    surfaces_changed();
    return SetResult::Done;
}

SetResult ArrayMesh::set_blend_shape_names(const Variant& value) {
    const std::optional<PoolStringArray> names = VariantCast<PoolStringArray>::from_variant(value);
    if (!names) {
        return SetResult::WrongType;
    }
    if (!surfaces_.empty()) {
        return refuse("expected blend_shape/names before surfaces/0, found it later");
    }
    blend_shape_names_.assign(names->span().begin(), names->span().end());
    return SetResult::Done;
}

SetResult ArrayMesh::set_dynamic(const StringName& property, const Variant& value) {
    const std::string_view name = property.view();
    refusal_.clear();
    if (name.substr(0, kSurfacePrefix.size()) == kSurfacePrefix) {
        return set_surface(name.substr(kSurfacePrefix.size()), value);
    }
    if (name == kNames) {
        return set_blend_shape_names(value);
    }
    if (name == kMode) {
        blend_shape_mode_ = static_cast<int>(value.to_int());
        return value.is_num() ? SetResult::Done : SetResult::WrongType;
    }
    const SurfaceField field = surface_field(name);
    if (field.surface < 0 || field.surface >= surface_count()) {
        return SetResult::UnknownProperty;
    }
    if (field.what == "name") {
        extras_[field.surface].name = value.to_text();
        return SetResult::Done;
    }
    if (field.what == "material") {
        const std::optional<Ref<Material>> material = VariantCast<Ref<Material>>::from_variant(value);
        if (!material) {
            return SetResult::WrongType;
        }
        set_surface_material(field.surface, *material);
        return SetResult::Done;
    }
    return SetResult::UnknownProperty;
}

bool ArrayMesh::get_dynamic(const StringName& property, Variant& value) const {
    const std::string_view name = property.view();
    if (name.substr(0, kSurfacePrefix.size()) == kSurfacePrefix) {
        const int surface = index_from(name.substr(kSurfacePrefix.size()));
        if (surface < 0 || surface >= surface_count()) {
            return false;
        }
        value = dictionary_from_surface(surfaces_[surface], extras_[surface]);
        return true;
    }
    if (name == kNames) {
        value = PoolStringArray(blend_shape_names_);
        return true;
    }
    if (name == kMode) {
        value = blend_shape_mode_;
        return true;
    }
    const SurfaceField field = surface_field(name);
    if (field.surface < 0 || field.surface >= surface_count() ||
        (field.what != "name" && field.what != "material")) {
        return false;
    }
    const SurfaceExtras& extras = extras_[field.surface];
    value =
        field.what == "name" ? Variant(extras.name) : VariantCast<Ref<Material>>::to_variant(extras.material);
    return true;
}

void ArrayMesh::list_dynamic(std::vector<PropertyValue>& out) const {
    if (!blend_shape_names_.empty()) {
        out.push_back({kNames, PoolStringArray(blend_shape_names_)});
        out.push_back({kMode, blend_shape_mode_});
    }
    for (int i = 0; i < surface_count(); ++i) {
        out.push_back({StringName(fmt::format("{}{}", kSurfacePrefix, i)),
                       dictionary_from_surface(surfaces_[i], extras_[i])});
    }
}

} // namespace cl::scene
