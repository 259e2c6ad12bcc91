#pragma once

#include "core/object/object.h"
#include "core/object/variant_cast.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <unordered_map>
#include <vector>

namespace cl {

/// How an editor or a check treats a property beyond its type.
enum class PropertyHint { None, Range, Enum, Flags, ResourceType, NodeType };

struct PropertyInfo {
    StringName name;
    Variant::Type type = Variant::Type::Nil; ///< Nil: takes any value
    Variant default_value;
    PropertyHint hint = PropertyHint::None;
    std::string hint_text; ///< "0,16,0.1" for Range; "Disabled,Indirect,All" for Enum; a class name for ResourceType
    std::string doc;       ///< one line: meaning and unit
    bool stored = true;    ///< false: settable (an alias such as rotation_degrees) but never saved
    std::function<SetResult(Object&, const Variant&)> set;
    std::function<Variant(const Object&)> get;
};

struct MethodInfo {
    StringName name;
    std::string doc;
    std::vector<Variant::Type> arguments;
    Variant::Type result = Variant::Type::Nil;
    std::function<Variant(Object&, std::span<const Variant>)> call;
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
    std::vector<PropertyInfo> properties; ///< own ones, in save order
    std::vector<MethodInfo> methods;
    std::vector<SignalInfo> signals;
    std::vector<EnumInfo> enums;
    std::function<std::unique_ptr<Object>()> create; ///< empty for abstract classes

    /// Looks here, then in the bases; nullptr if nowhere.
    [[nodiscard]] const PropertyInfo* find_property(const StringName& property) const noexcept;
    [[nodiscard]] const MethodInfo* find_method(const StringName& method) const noexcept;
    [[nodiscard]] bool has_signal(const StringName& signal) const noexcept;
    [[nodiscard]] bool is_a(const StringName& class_name) const noexcept;
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
    PropertyBuilder& default_value(Variant value) {
        info_.default_value = std::move(value);
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
        info_.properties.push_back(std::move(p));
        return PropertyBuilder<T>(info_.properties.back());
    }

    /// A method callable by name. Arguments and result convert through VariantCast.
    template <typename R, typename... Args>
    ClassBuilder& method(std::string_view name, R (T::*f)(Args...), std::string doc = {});
    template <typename R, typename... Args>
    ClassBuilder& method(std::string_view name, R (T::*f)(Args...) const, std::string doc = {});

    ClassBuilder& signal(std::string_view name, std::vector<std::string> arguments = {}, std::string doc = {}) {
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

    /// Registers T (base before derived; twice is a no-op). T has `kClassName` and may have `static bind()`.
    /// `Base` is its registered base class.
    template <typename T, typename Base = void>
    const ClassInfo& add();

    /// nullptr if unknown.
    [[nodiscard]] const ClassInfo* find(const StringName& name) const noexcept;
    [[nodiscard]] const ClassInfo* find(std::type_index type) const noexcept;
    /// nullptr if unknown or abstract.
    [[nodiscard]] std::unique_ptr<Object> create(const StringName& name) const;
    /// The same for classes derived from Reference. Null if unknown, abstract or not a Reference.
    [[nodiscard]] Ref<Reference> create_ref(const StringName& name) const;
    /// Every class, base before derived, in order of registration.
    [[nodiscard]] std::vector<const ClassInfo*> classes() const;

private:
    ClassInfo& insert(std::string_view name, std::type_index type, const ClassInfo* parent, bool& is_new);
    std::vector<std::unique_ptr<ClassInfo>> classes_;
    std::unordered_map<StringName, ClassInfo*> by_name_;
    std::unordered_map<std::type_index, ClassInfo*> by_type_;
};

/// Registers Object, Reference, Resource. Called by the layers' register functions.
void register_core_types(ClassRegistry& registry);

} // namespace cl

#include "core/object/class_registry_inl.h"
