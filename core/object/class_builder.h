#pragma once

#include "core/assert.h"
#include "core/object/class_info.h"
#include "core/object/method_call.h"
#include "core/object/variant_cast.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace cl {

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
    ClassBuilder& method(std::string_view name, R (C::*f)(Args...), std::string doc = {}) {
        static_assert(std::is_base_of_v<C, T>, "not a member function of the class");
        info_.methods.push_back(detail::make_method<T, R, Args...>(name, f, std::move(doc)));
        return *this;
    }
    template <typename C, typename R, typename... Args>
    ClassBuilder& method(std::string_view name, R (C::*f)(Args...) const, std::string doc = {}) {
        static_assert(std::is_base_of_v<C, T>, "not a member function of the class");
        info_.methods.push_back(detail::make_method<T, R, Args...>(name, f, std::move(doc)));
        return *this;
    }

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

} // namespace cl
