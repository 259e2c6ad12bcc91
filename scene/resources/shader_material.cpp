#include "scene/resources/material.h"

#include "core/object/class_registry.h"

#include <algorithm>

namespace cl::scene {

namespace {

bool is_parameter(std::string_view property) {
    constexpr std::string_view kPrefix = "shader_param/";
    return property.substr(0, kPrefix.size()) == kPrefix;
}

} // namespace

void ShaderMaterial::bind(ClassBuilder<ShaderMaterial>& c) {
    c.doc("A material with shader code of its own; drawn and baked as plain white.").dynamic();
    c.property("shader", &ShaderMaterial::shader, &ShaderMaterial::set_shader).doc("The shader code.");
}

MaterialDesc ShaderMaterial::describe(VisualServer&) const {
    MaterialDesc desc;
    desc.render_priority = render_priority();
    return desc;
}

SetResult ShaderMaterial::set_dynamic(const StringName& property, const Variant& value) {
    if (!is_parameter(property.view())) {
        return SetResult::UnknownProperty;
    }
    const auto known = std::find_if(parameters_.begin(), parameters_.end(),
                                    [&](const PropertyValue& p) { return p.name == property; });
    if (known != parameters_.end()) {
        known->value = value;
    } else {
        parameters_.push_back({property, value});
    }
    return SetResult::Done;
}

bool ShaderMaterial::get_dynamic(const StringName& property, Variant& value) const {
    for (const PropertyValue& p : parameters_) {
        if (p.name == property) {
            value = p.value;
            return true;
        }
    }
    return false;
}

void ShaderMaterial::list_dynamic(std::vector<PropertyValue>& out) const {
    out.insert(out.end(), parameters_.begin(), parameters_.end());
}

} // namespace cl::scene
