#include "scene/3d/mesh_instance.h"

#include "scene/3d/server_call.h"

#include "core/object/class_registry.h"

#include <charconv>
#include <optional>
#include <utility>

namespace cl::scene {

namespace {

constexpr std::string_view kMaterialPrefix = "material/";
constexpr std::string_view kBlendShapePrefix = "blend_shapes/";

bool has_prefix(std::string_view text, std::string_view prefix) {
    return text.substr(0, prefix.size()) == prefix;
}

/// The i of "material/i"; std::nullopt for any other name.
std::optional<int> slot_of(std::string_view property) {
    if (!has_prefix(property, kMaterialPrefix)) {
        return std::nullopt;
    }
    const std::string_view digits = property.substr(kMaterialPrefix.size());
    int slot = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), slot);
    const bool is_number = error == std::errc() && end == digits.data() + digits.size() && slot >= 0;
    return is_number ? std::optional<int>(slot) : std::nullopt;
}

} // namespace

void MeshInstance::bind(ClassBuilder<MeshInstance>& c) {
    c.doc("Shows a mesh.").dynamic();
    c.property("mesh", &MeshInstance::mesh, &MeshInstance::set_mesh)
        .doc("What is shown. Setting it empties the material slots.")
        .default_value(Variant());
    c.property("skin", &MeshInstance::skin, &MeshInstance::set_skin)
        .doc("Kept for saving, without effect.")
        .hint(PropertyHint::ResourceType, "Skin")
        .default_value(Variant());
    c.property("skeleton", &MeshInstance::skeleton, &MeshInstance::set_skeleton)
        .doc("Kept for saving, without effect.")
        .default_value(NodePath(".."));
}

MeshInstance::MeshInstance() : mesh_([this] { mesh_changed(); }), skeleton_("..") {}

void MeshInstance::set_mesh(Ref<Mesh> mesh) {
    mesh_.set(std::move(mesh));
    surface_materials_.clear();
    blend_shapes_.clear();
    mesh_changed();
}

void MeshInstance::mesh_changed() {
    const Ref<Mesh>& mesh = mesh_.get();
    surface_materials_.resize(mesh ? static_cast<size_t>(mesh->surface_count()) : 0);
    const std::map<std::string, float> old_weights = std::exchange(blend_shapes_, {});
    if (mesh) {
        for (const std::string& name : mesh->blend_shape_names()) {
            const auto old = old_weights.find(name);
            blend_shapes_.emplace(name, old == old_weights.end() ? 0.0f : old->second);
        }
    }
    if (update_base()) {
        for (size_t i = 0; i < surface_materials_.size(); ++i) {
            describe_surface(*server(), instance_rid(), static_cast<int>(i));
        }
    }
}

Ref<Material> MeshInstance::surface_material(int surface) const {
    const auto slot = static_cast<size_t>(surface);
    return surface >= 0 && slot < surface_materials_.size() ? surface_materials_[slot] : nullptr;
}

SetResult MeshInstance::set_surface_material(int surface, Ref<Material> material) {
    const auto slot = static_cast<size_t>(surface);
    if (surface < 0 || slot >= surface_materials_.size()) {
        return SetResult::Refused;
    }
    surface_materials_[slot] = std::move(material);
    if (instance_rid()) {
        describe_surface(*server(), instance_rid(), surface);
    }
    return SetResult::Done;
}

Ref<Material> MeshInstance::active_material(int surface) const {
    if (material_override()) {
        return material_override();
    }
    if (Ref<Material> own = surface_material(surface)) {
        return own;
    }
    return mesh() ? mesh()->surface_material(surface) : nullptr;
}

RID MeshInstance::base_rid(VisualServer& server) {
    return mesh() ? mesh()->rid(server) : RID{};
}

void MeshInstance::describe_instance(VisualServer& server, RID instance) {
    GeometryInstance::describe_instance(server, instance);
    for (size_t i = 0; i < surface_materials_.size(); ++i) {
        describe_surface(server, instance, static_cast<int>(i));
    }
}

void MeshInstance::describe_surface(VisualServer& server, RID instance, int surface) {
    const Ref<Material> material = surface_material(surface);
    tell(server.instance_set_surface_material(instance, surface, material ? material->rid(server) : RID{}));
}

SetResult MeshInstance::set_dynamic(const StringName& property, const Variant& value) {
    const std::string_view name = property.view();
    if (const std::optional<int> slot = slot_of(name)) {
        std::optional<Ref<Material>> material = VariantCast<Ref<Material>>::from_variant(value);
        return material ? set_surface_material(*slot, std::move(*material)) : SetResult::WrongType;
    }
    if (has_prefix(name, kBlendShapePrefix)) {
        const auto found = blend_shapes_.find(std::string(name.substr(kBlendShapePrefix.size())));
        const std::optional<float> weight = VariantCast<float>::from_variant(value);
        if (found == blend_shapes_.end() || !weight) {
            return weight ? SetResult::Refused : SetResult::WrongType;
        }
        found->second = *weight;
        return SetResult::Done;
    }
    return GeometryInstance::set_dynamic(property, value);
}

bool MeshInstance::get_dynamic(const StringName& property, Variant& value) const {
    const std::string_view name = property.view();
    if (const std::optional<int> slot = slot_of(name);
        slot && static_cast<size_t>(*slot) < surface_materials_.size()) {
        value = VariantCast<Ref<Material>>::to_variant(surface_material(*slot));
        return true;
    }
    if (has_prefix(name, kBlendShapePrefix)) {
        const auto found = blend_shapes_.find(std::string(name.substr(kBlendShapePrefix.size())));
        if (found != blend_shapes_.end()) {
            value = Variant(found->second);
            return true;
        }
    }
    return GeometryInstance::get_dynamic(property, value);
}

void MeshInstance::list_dynamic(std::vector<PropertyValue>& out) const {
    for (const auto& [name, weight] : blend_shapes_) {
        out.push_back({StringName(std::string(kBlendShapePrefix) + name), Variant(weight)});
    }
    for (size_t i = 0; i < surface_materials_.size(); ++i) {
        out.push_back({StringName(std::string(kMaterialPrefix) + std::to_string(i)),
                       VariantCast<Ref<Material>>::to_variant(surface_materials_[i])});
    }
    GeometryInstance::list_dynamic(out);
}

} // namespace cl::scene
