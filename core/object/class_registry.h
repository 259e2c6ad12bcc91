#pragma once

#include "core/object/object.h"
#include "core/object/variant_cast.h"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <typeindex>
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
    std::string
        hint_text; ///< "0,16,0.1" for Range; "Disabled,Indirect,All" for Enum; a class name for ResourceType
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

/// Fills in one property; returned by ClassBuilder::property so that calls chain.
template <typename T>
class PropertyBuilder {
public:
    explicit PropertyBuilder(PropertyInfo& info) : info_(info) {}
    PropertyBuilder& doc(std::string text) {
        info_.doc = std::move(text);
        return *this;
    }
    /// What a fresh instance has; read from one where this is not called. Converts as an assignment does.
    PropertyBuilder& default_value(const Variant& value) {
        info_.declared_default = info_.convert(value);
        CL_ASSERT(info_.declared_default, "the default of a property does not convert to its type");
        return *this;
    }
    PropertyBuilder& range(std::string text) { return hint(PropertyHint::Range, std::move(text)); }
    PropertyBuilder& enumeration(std::string names) { return hint(PropertyHint::Enum, std::move(names)); }
    PropertyBuilder& hint(PropertyHint kind, std::string text) {
        info_.hint = kind;
        info_.hint_text = std::move(text);
        return *this;
    }
    PropertyBuilder& not_stored() {
        info_.stored = false;
        return *this;
    }
    /// Saved only while `condition` holds for the object, such as a feature group that can be switched off.
    PropertyBuilder& stored_if(std::function<bool(const T&)> condition) {
        info_.stored_if = [condition = std::move(condition)](const Object& o) {
            return condition(static_cast<const T&>(o));
        };
        return *this;
    }
    /// Saved even when it equals its default; a null object in a Resource is still left out.
    PropertyBuilder& always_stored() {
        info_.always_stored = true;
        return *this;
    }
    /// Saved after the properties of all derived classes, as Godot does with `script`.
    PropertyBuilder& saved_last() {
        info_.save_order = SaveOrder::Last;
        return *this;
    }

private:
    PropertyInfo& info_;
};

/// Describes class T to the registry: T::bind(ClassBuilder<T>&) calls these in save order.
template <typename T>
class ClassBuilder {
public:
    explicit ClassBuilder(ClassInfo& info) : info_(info) {}

    ClassBuilder& doc(std::string text) {
        info_.doc = std::move(text);
        return *this;
    }
    /// The class is a base only: no object of exactly this class is made from a file.
    ClassBuilder& abstract() {
        info_.create = nullptr;
        return *this;
    }
    /// This class overrides list_dynamic(): saving puts those properties after its static ones. Without the
    /// mark they follow the static ones of the most derived class.
    ClassBuilder& dynamic() {
        info_.lists_dynamic = true;
        return *this;
    }

    /// A property by its getter (a const member function) and setter. The setter takes the value or a const
    /// reference to it and returns void, or SetResult when it can refuse. Values convert through VariantCast.
    template <typename Get, typename Set>
    PropertyBuilder<T> property(std::string_view name, Get get, Set set) {
        using Value = std::remove_cvref_t<std::invoke_result_t<Get, const T&>>;
        PropertyInfo p;
        p.name = StringName(name);
        p.type = VariantCast<Value>::kType;
        if constexpr (requires { VariantCast<Value>::resource_class(); }) {
            p.hint = PropertyHint::ResourceType;
            p.hint_text = std::string(VariantCast<Value>::resource_class());
        }
        p.get = [get](const Object& o) {
            return VariantCast<Value>::to_variant(std::invoke(get, static_cast<const T&>(o)));
        };
        p.set = [set](Object& o, const Variant& v) {
            std::optional<Value> value = VariantCast<Value>::from_variant(v);
            if (!value) {
                return SetResult::WrongType;
            }
            if constexpr (std::is_same_v<std::invoke_result_t<Set, T&, Value>, SetResult>) {
                return std::invoke(set, static_cast<T&>(o), std::move(*value));
            } else {
                std::invoke(set, static_cast<T&>(o), std::move(*value));
                return SetResult::Done;
            }
        };
        p.convert = [](const Variant& v) -> std::optional<Variant> {
            std::optional<Value> value = VariantCast<Value>::from_variant(v);
            return value ? std::optional<Variant>(VariantCast<Value>::to_variant(*value)) : std::nullopt;
        };
        info_.properties.push_back(std::move(p));
        return PropertyBuilder<T>(info_.properties.back());
    }

    /// A method callable by name. Arguments and result convert through VariantCast. `f` may be a base's.
    template <typename C, typename R, typename... Args>
    requires std::is_base_of_v<C, T> ClassBuilder& method(std::string_view name, R (C::*f)(Args...),
                                                          std::string doc = {});
    template <typename C, typename R, typename... Args>
    requires std::is_base_of_v<C, T> ClassBuilder& method(std::string_view name, R (C::*f)(Args...) const,
                                                          std::string doc = {});

    ClassBuilder& signal(std::string_view name, std::vector<std::string> arguments = {},
                         std::string doc = {}) {
        info_.signals.push_back({StringName(name), std::move(arguments), std::move(doc)});
        return *this;
    }
    ClassBuilder& enumeration(std::string_view name, std::vector<std::pair<std::string, int64_t>> values) {
        info_.enums.push_back({StringName(name), std::move(values)});
        return *this;
    }

private:
    ClassInfo& info_;
};

/// All classes of the process, filled by explicit register_*_types() calls (no static initialisers).
class ClassRegistry {
public:
    [[nodiscard]] static ClassRegistry& instance();

    /// Registers T (base before derived; twice is a no-op). T has a `kClassName` of its own and may have a
    /// public `static void bind(ClassBuilder<T>&)`. `Base` is its registered base class. A T that is abstract
    /// or has no default constructor gives no `create`.
    template <typename T, typename Base = void>
    const ClassInfo& add();

    /// nullptr if unknown.
    [[nodiscard]] const ClassInfo* find(const StringName& name) const noexcept;
    [[nodiscard]] const ClassInfo* find(std::type_index type) const noexcept;
    /// Description of the object's dynamic type, else of its nearest registered base; nullptr if not even
    /// Object is registered.
    [[nodiscard]] const ClassInfo* class_of(const Object& object) const;
    /// nullptr if unknown or abstract.
    [[nodiscard]] std::unique_ptr<Object> create(const StringName& name) const;
    /// The same for classes derived from Reference. Null if unknown, abstract or not a Reference.
    [[nodiscard]] Ref<Reference> create_ref(const StringName& name) const;
    /// Every class, base before derived, in order of registration.
    [[nodiscard]] std::vector<const ClassInfo*> classes() const;

private:
    ClassInfo& insert(std::string_view name, std::type_index type, const ClassInfo* parent);
    std::vector<std::unique_ptr<ClassInfo>> classes_;
    std::unordered_map<StringName, ClassInfo*> by_name_;
    std::unordered_map<std::type_index, ClassInfo*> by_type_;
};

/// Registers Object, Reference, Resource. Called by the layers' register functions.
void register_core_types(ClassRegistry& registry);

} // namespace cl

#include "core/object/class_registry_inl.h"
