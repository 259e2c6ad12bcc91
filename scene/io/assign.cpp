#include "scene/io/assign.h"

#include "scene/resources/explains_refusal.h"
#include "scene/resources/missing_resource.h"

#include "core/object/class_registry.h"
#include "core/variant/variant_components.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace cl::scene {

namespace {

bool stands_in(const Object& object) {
    return object.class_name() != object.class_info().name;
}

bool has_script(const Object& object) {
    static const StringName kScript("script");
    return object.get(kScript).to_object() != nullptr;
}

/// "a Texture", "float": what the property takes.
std::string expected_by(const Object& object, const StringName& property) {
    const PropertyInfo* info = object.class_info().find_property(property);
    if (!info) {
        return "a value of another type";
    }
    return info->hint == PropertyHint::ResourceType ? "a " + info->hint_text
                                                    : std::string(type_name(info->type));
}

std::string found_in(const Variant& value) {
    const Reference* object = value.to_object();
    return object           ? "a " + object->class_name().str()
           : value.is_nil() ? "null"
                            : std::string(type_name(value.type()));
}

Status wrong_type(Object& object, const TextAssignment& assignment, const Variant& value,
                  Diagnostics& diagnostics) {
    const StringName property(assignment.key);
    const std::string name = fmt::format("{}.{}", object.class_name().view(), assignment.key);
    const std::string message =
        fmt::format("{}: expected {}, found {}", name, expected_by(object, property), found_in(value));
    const bool is_missing = dynamic_cast<const MissingResource*>(value.to_object()) != nullptr;
    if (!value.is_nil() && !is_missing) {
        return Error{ErrorCode::ParseError, message, assignment.value_where};
    }
    if (is_missing) {
        object.keep_extra(property, value);
    }
    diagnostics.warn(assignment.value_where, message, "wrong type: " + name);
    return {};
}

Status refused(const Object& object, const TextAssignment& assignment, const Variant& value,
               Diagnostics& diagnostics) {
    const std::string name = fmt::format("{}.{}", object.class_name().view(), assignment.key);
    const auto* explains = dynamic_cast<const ExplainsRefusal*>(&object);
    if (explains && !explains->refusal().empty()) {
        return Error{ErrorCode::ParseError, fmt::format("{}: {}", name, explains->refusal()),
                     assignment.value_where};
    }
    diagnostics.warn(assignment.value_where,
                     fmt::format("{}: expected a value in range, found {}, which is left out", name,
                                 value.to_object() ? found_in(value) : value.to_text()),
                     "refused: " + name);
    return {};
}

/// Godot takes infinities and NaN and draws what comes of them; one in a transform would make all below it
/// vanish.
bool is_finite(const Variant& value) {
    if (const double* number = value.get_if<double>()) {
        return std::isfinite(*number);
    }
    const Components numbers = components_of(value);
    return std::all_of(numbers.span().begin(), numbers.span().end(),
                       [](float number) { return std::isfinite(number); });
}

/// As the property would hold the value: 1e300 is not finite as a float.
bool is_finite_in(const Object& object, const StringName& property, const Variant& value) {
    const PropertyInfo* info = object.class_info().find_property(property);
    if (!info || (value.type() != Variant::Type::Real && component_count(value.type()) == 0)) {
        return true;
    }
    const std::optional<Variant> held = info->convert(value);
    return !held || is_finite(*held);
}

} // namespace

bool is_bookkeeping(std::string_view key) noexcept {
    return key == "script" || key == "__meta__" || key == "_import_path";
}

void warn_unknown_property(const Object& object, const TextAssignment& assignment, Diagnostics& diagnostics) {
    if (is_bookkeeping(assignment.key) || stands_in(object) || has_script(object)) {
        return;
    }
    const std::string_view class_name = object.class_name().view();
    diagnostics.warn(
        assignment.where,
        fmt::format("{} has no property \"{}\": kept, without effect", class_name, assignment.key),
        fmt::format("unknown property: {}.{}", class_name, assignment.key));
}

void warn_unknown_node_class(const std::string& type, const SourceLocation& where, Diagnostics& diagnostics) {
    diagnostics.warn(where, fmt::format("nodes of class {} are kept, without effect", type),
                     "node class: " + type);
}

void warn_unknown_resource_class(const std::string& type, const SourceLocation& where,
                                 Diagnostics& diagnostics) {
    diagnostics.warn(where, fmt::format("resources of class {} are kept, without effect", type),
                     "resource class: " + type);
}

Status assign(Object& object, const TextAssignment& assignment, const Variant& value,
              Diagnostics& diagnostics) {
    const StringName property(assignment.key);
    if (!is_finite_in(object, property, value)) {
        return refused(object, assignment, value, diagnostics);
    }
    switch (object.set(property, value)) {
    case SetResult::Done:
        return {};
    case SetResult::WrongType:
        return wrong_type(object, assignment, value, diagnostics);
    case SetResult::Refused:
        return refused(object, assignment, value, diagnostics);
    case SetResult::UnknownProperty:
        break;
    }
    warn_unknown_property(object, assignment, diagnostics);
    return {};
}

} // namespace cl::scene
