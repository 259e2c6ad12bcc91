#pragma once

#include "core/object/class_info.h"
#include "core/object/variant_cast.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace cl {

namespace detail {

[[nodiscard]] Error wrong_argument_count(size_t expected, size_t found);
/// @param index  position of the argument, from 0
[[nodiscard]] Error wrong_argument_type(size_t index, Variant::Type expected, Variant::Type found);

/// Calls member function `f` of the T behind `object` with the arguments converted to Args.
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

/// The description of a member function of T or a base, with `call` bound to it.
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

} // namespace cl
