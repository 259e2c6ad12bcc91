#pragma once

#include "core/expected.h"
#include "core/object/object.h"
#include "core/string_name.h"
#include "core/variant/variant.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cl {

/// How an editor or a check treats a property beyond its type.
enum class PropertyHint { None, Range, Enum, Flags, ResourceType, NodeType };

/// Where saving puts a property among those of its object.
enum class SaveOrder {
    Declared, ///< base class first, then as declared
    Last,     ///< after the static and dynamic ones of all classes (`__meta__`, `script`)
};

struct PropertyInfo {
    StringName name;
    Variant::Type type = Variant::Type::Nil; ///< Nil: takes any value
    /// As bind() gave it; std::nullopt if it gave none. ClassInfo::default_of() is what counts.
    std::optional<Variant> declared_default;
    PropertyHint hint = PropertyHint::None;
    /// "0,16,0.1" for Range; "Disabled,Indirect,All" for Enum; a class name for ResourceType
    std::string hint_text;
    std::string doc;            ///< one line: meaning and unit
    bool stored = true;         ///< false: settable (an alias such as rotation_degrees) but never saved
    bool always_stored = false; ///< saved even when it equals the default
    SaveOrder save_order = SaveOrder::Declared;
    /// Empty: saving is not conditional. Else asked of the object that is saved (a feature is switched on).
    std::function<bool(const Object&)> stored_if;
    std::function<SetResult(Object&, const Variant&)> set;
    std::function<Variant(const Object&)> get;
    /// The value as the property would hold it (0.98 rounded to float, 1 as 1.0); std::nullopt on a wrong
    /// type.
    std::function<std::optional<Variant>(const Variant&)> convert;
};

struct MethodInfo {
    StringName name;
    std::string doc;
    std::vector<Variant::Type> arguments;
    Variant::Type result = Variant::Type::Nil;
    /// InvalidArgument for a wrong number or type of arguments.
    std::function<Expected<Variant>(Object&, std::span<const Variant>)> call;
};

struct SignalInfo {
    StringName name;
    std::vector<std::string> arguments;
    std::string doc;
};

struct EnumInfo {
    StringName name;
    std::vector<std::pair<std::string, int64_t>> values;
};

/// Everything known about one class; base classes by `parent`.
class ClassInfo {
public:
    StringName name;
    const ClassInfo* parent = nullptr;
    std::string doc;
    std::deque<PropertyInfo> properties; ///< own ones, in save order; a deque, so that their addresses stay
    std::vector<MethodInfo> methods;
    std::vector<SignalInfo> signals;
    std::vector<EnumInfo> enums;
    bool lists_dynamic = false; ///< Object::list_dynamic() belongs to this class: see ClassBuilder::dynamic()
    std::function<std::unique_ptr<Object>()> create; ///< empty for abstract classes
    std::function<bool(const Object&)> is_instance;  ///< dynamic_cast to this class

    /// Looks here, then in the bases; nullptr if nowhere.
    [[nodiscard]] const PropertyInfo* find_property(const StringName& property) const noexcept;
    [[nodiscard]] const MethodInfo* find_method(const StringName& method) const noexcept;
    [[nodiscard]] bool has_signal(const StringName& signal) const noexcept;
    [[nodiscard]] bool is_a(const StringName& class_name) const noexcept;
    /// This class and its bases, Object first.
    [[nodiscard]] std::vector<const ClassInfo*> lineage() const;

    /// The value with which an object of this class starts, for an own or inherited property: read from a
    /// fresh instance, so a class may start an inherited property at a value of its own. For abstract classes
    /// the declared default, else Nil. The instance is made once, at the first call.
    [[nodiscard]] const Variant& default_of(const PropertyInfo& property) const;

private:
    mutable std::optional<std::unordered_map<StringName, Variant>> fresh_values_;
};

} // namespace cl
