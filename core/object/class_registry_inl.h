#pragma once

// Template bodies of class_registry.h, which includes this file at its end.

#include "core/object/class_registry.h"

#include <array>
#include <tuple>
#include <type_traits>
#include <utility>

namespace cl {

namespace detail {

[[nodiscard]] Error wrong_argument_count(size_t expected, size_t found);
/// @param index  position of the argument, from 0
[[nodiscard]] Error wrong_argument_type(size_t index, Variant::Type expected, Variant::Type found);

template <typename T, typename F, typename R, typename... Args, size_t... I>
Expected<Variant> invoke_converted(F f, Object& object, std::span<const Variant> given,
                                   std::index_sequence<I...>) {
    if (given.size() != sizeof...(Args)) {
        return wrong_argument_count(sizeof...(Args), given.size());
    }
    std::tuple<std::optional<std::remove_cvref_t<Args>>...> converted{
        VariantCast<std::remove_cvref_t<Args>>::from_variant(given[I])...};
    const std::array<bool, sizeof...(Args)> fits{std::get<I>(converted).has_value()...};
    const std::array<Variant::Type, sizeof...(Args)> types{VariantCast<std::remove_cvref_t<Args>>::kType...};
    for (size_t i = 0; i < sizeof...(Args); ++i) {
        if (!fits[i]) {
            return wrong_argument_type(i, types[i], given[i].type());
        }
    }
    if constexpr (std::is_void_v<R>) {
        std::invoke(f, static_cast<T&>(object), *std::get<I>(converted)...);
        return Variant();
    } else {
        return VariantCast<std::remove_cvref_t<R>>::to_variant(
            std::invoke(f, static_cast<T&>(object), *std::get<I>(converted)...));
    }
}

template <typename T, typename R, typename... Args, typename F>
MethodInfo make_method(std::string_view name, F f, std::string doc) {
    MethodInfo method;
    method.name = StringName(name);
    method.doc = std::move(doc);
    method.arguments = {VariantCast<std::remove_cvref_t<Args>>::kType...};
    if constexpr (!std::is_void_v<R>) {
        method.result = VariantCast<std::remove_cvref_t<R>>::kType;
    }
    method.call = [f](Object& object, std::span<const Variant> given) {
        return invoke_converted<T, F, R, Args...>(f, object, given, std::index_sequence_for<Args...>());
    };
    return method;
}

} // namespace detail

template <typename T>
template <typename C, typename R, typename... Args>
requires std::is_base_of_v<C, T> ClassBuilder<T>
&ClassBuilder<T>::method(std::string_view name, R (C::*f)(Args...), std::string doc) {
    info_.methods.push_back(detail::make_method<T, R, Args...>(name, f, std::move(doc)));
    return *this;
}

template <typename T>
template <typename C, typename R, typename... Args>
requires std::is_base_of_v<C, T> ClassBuilder<T>
&ClassBuilder<T>::method(std::string_view name, R (C::*f)(Args...) const, std::string doc) {
    info_.methods.push_back(detail::make_method<T, R, Args...>(name, f, std::move(doc)));
    return *this;
}

template <typename T, typename Base>
const ClassInfo& ClassRegistry::add() {
    static_assert(std::is_base_of_v<Object, T>, "only Objects have classes in the registry");
    if (const ClassInfo* known = find(std::type_index(typeid(T)))) {
        return *known;
    }
    const ClassInfo* parent = nullptr;
    if constexpr (!std::is_void_v<Base>) {
        static_assert(std::is_base_of_v<Base, T> && !std::is_same_v<Base, T>, "Base is not a base of T");
        parent = find(std::type_index(typeid(Base)));
        CL_ASSERT(parent, "register the base class before the derived one");
    }
    ClassInfo& info = insert(T::kClassName, std::type_index(typeid(T)), parent);
    if constexpr (std::is_same_v<T, Object>) {
        info.is_instance = [](const Object&) { return true; };
    } else {
        info.is_instance = [](const Object& o) { return dynamic_cast<const T*>(&o) != nullptr; };
    }
    if constexpr (std::is_default_constructible_v<T>) { // false for classes with pure virtual functions
        info.create = []() -> std::unique_ptr<Object> { return std::make_unique<T>(); };
    }
    if constexpr (requires(ClassBuilder<T> & builder) { T::bind(builder); }) {
        ClassBuilder<T> builder(info);
        T::bind(builder);
    }
    return info;
}

} // namespace cl
