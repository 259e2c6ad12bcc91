#pragma once

#include "core/object/object.h"
#include "core/ref.h"
#include "core/variant/variant.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace cl {

/// How a C++ type of a property or argument appears as a Variant:
///   kType                the Variant type it is saved as; Nil = any
///   to_variant(value)    never fails
///   from_variant(value)  converts as an assignment in a scene file does (Variant::converted_to);
///   std::nullopt
///                        where the value does not convert
/// Specialised below for every type that the registry accepts; another type fails to compile.
template <typename T>
struct VariantCast;

/// For types that a Variant holds as they are.
template <typename T, Variant::Type Type>
struct StoredVariantCast {
    static constexpr Variant::Type kType = Type;
    static Variant to_variant(const T& value) { return Variant(value); }
    static std::optional<T> from_variant(const Variant& value) {
        if (const T* exact = value.get_if<T>()) {
            return *exact;
        }
        const std::optional<Variant> converted = value.converted_to(Type);
        const T* held = converted ? converted->get_if<T>() : nullptr;
        return held ? std::optional<T>(*held) : std::nullopt;
    }
};

// clang-format off
template <> struct VariantCast<bool> : StoredVariantCast<bool, Variant::Type::Bool> {};
template <> struct VariantCast<int64_t> : StoredVariantCast<int64_t, Variant::Type::Int> {};
template <> struct VariantCast<double> : StoredVariantCast<double, Variant::Type::Real> {};
template <> struct VariantCast<std::string> : StoredVariantCast<std::string, Variant::Type::String> {};
template <> struct VariantCast<glm::vec2> : StoredVariantCast<glm::vec2, Variant::Type::Vector2> {};
template <> struct VariantCast<Rect2> : StoredVariantCast<Rect2, Variant::Type::Rect2> {};
template <> struct VariantCast<glm::vec3> : StoredVariantCast<glm::vec3, Variant::Type::Vector3> {};
template <> struct VariantCast<Transform2D> : StoredVariantCast<Transform2D, Variant::Type::Transform2D> {};
template <> struct VariantCast<Plane> : StoredVariantCast<Plane, Variant::Type::Plane> {};
template <> struct VariantCast<glm::quat> : StoredVariantCast<glm::quat, Variant::Type::Quat> {};
template <> struct VariantCast<AABB> : StoredVariantCast<AABB, Variant::Type::AABB> {};
template <> struct VariantCast<glm::mat3> : StoredVariantCast<glm::mat3, Variant::Type::Basis> {};
template <> struct VariantCast<Transform> : StoredVariantCast<Transform, Variant::Type::Transform> {};
template <> struct VariantCast<Color> : StoredVariantCast<Color, Variant::Type::Color> {};
template <> struct VariantCast<NodePath> : StoredVariantCast<NodePath, Variant::Type::NodePath> {};
template <> struct VariantCast<TextRID> : StoredVariantCast<TextRID, Variant::Type::RID> {};
template <> struct VariantCast<Dictionary> : StoredVariantCast<Dictionary, Variant::Type::Dictionary> {};
template <> struct VariantCast<Array> : StoredVariantCast<Array, Variant::Type::Array> {};
template <> struct VariantCast<PoolByteArray> : StoredVariantCast<PoolByteArray, Variant::Type::PoolByteArray> {};
template <> struct VariantCast<PoolIntArray> : StoredVariantCast<PoolIntArray, Variant::Type::PoolIntArray> {};
template <> struct VariantCast<PoolRealArray> : StoredVariantCast<PoolRealArray, Variant::Type::PoolRealArray> {};
template <> struct VariantCast<PoolStringArray>
    : StoredVariantCast<PoolStringArray, Variant::Type::PoolStringArray> {};
template <> struct VariantCast<PoolVector2Array>
    : StoredVariantCast<PoolVector2Array, Variant::Type::PoolVector2Array> {};
template <> struct VariantCast<PoolVector3Array>
    : StoredVariantCast<PoolVector3Array, Variant::Type::PoolVector3Array> {};
template <> struct VariantCast<PoolColorArray> : StoredVariantCast<PoolColorArray, Variant::Type::PoolColorArray> {};
// clang-format on

/// Any value, unconverted.
template <>
struct VariantCast<Variant> {
    static constexpr Variant::Type kType = Variant::Type::Nil;
    static Variant to_variant(const Variant& value) { return value; }
    static std::optional<Variant> from_variant(const Variant& value) { return value; }
};

/// Narrow integers wrap modulo 2^32, as they do in Godot: a mask of -1 has all its bits set.
template <typename T>
struct NarrowIntVariantCast {
    static constexpr Variant::Type kType = Variant::Type::Int;
    static Variant to_variant(T value) { return Variant(static_cast<int64_t>(value)); }
    static std::optional<T> from_variant(const Variant& value) {
        const std::optional<int64_t> wide = VariantCast<int64_t>::from_variant(value);
        return wide ? std::optional<T>(static_cast<T>(*wide)) : std::nullopt;
    }
};
template <>
struct VariantCast<int32_t> : NarrowIntVariantCast<int32_t> {};
template <>
struct VariantCast<uint32_t> : NarrowIntVariantCast<uint32_t> {};

template <>
struct VariantCast<float> {
    static constexpr Variant::Type kType = Variant::Type::Real;
    static Variant to_variant(float value) { return Variant(value); }
    static std::optional<float> from_variant(const Variant& value) {
        const std::optional<double> wide = VariantCast<double>::from_variant(value);
        return wide ? std::optional<float>(static_cast<float>(*wide)) : std::nullopt;
    }
};

template <>
struct VariantCast<StringName> {
    static constexpr Variant::Type kType = Variant::Type::String;
    static Variant to_variant(const StringName& value) { return Variant(value); }
    static std::optional<StringName> from_variant(const Variant& value) {
        const std::optional<std::string> text = VariantCast<std::string>::from_variant(value);
        return text ? std::optional<StringName>(StringName(*text)) : std::nullopt;
    }
};

/// Enums are saved as int. A number that is no enumerator is passed on, for the setter to refuse; one that
/// does not even fit the underlying type is clamped to it, so that it cannot wrap to a valid enumerator.
template <typename T>
requires std::is_enum_v<T>
struct VariantCast<T> {
    using Number = std::underlying_type_t<T>;
    static constexpr Variant::Type kType = Variant::Type::Int;
    static Variant to_variant(T value) { return Variant(static_cast<int64_t>(value)); }
    static std::optional<T> from_variant(const Variant& value) {
        const std::optional<int64_t> wide = VariantCast<int64_t>::from_variant(value);
        if (!wide) {
            return std::nullopt;
        }
        constexpr int64_t kLeast = static_cast<int64_t>(std::numeric_limits<Number>::min());
        constexpr int64_t kMost = static_cast<int64_t>(std::numeric_limits<Number>::max());
        return static_cast<T>(static_cast<Number>(std::clamp(*wide, kLeast, kMost)));
    }
};

/// Shared objects of a class derived from Reference. A null Ref is Nil (`null` in a file) and Nil becomes a
/// null Ref; an object of another class does not convert.
template <typename T>
struct VariantCast<Ref<T>> {
    static constexpr Variant::Type kType = Variant::Type::Object;
    static constexpr std::string_view resource_class() { return T::kClassName; }
    static Variant to_variant(const Ref<T>& value) { return value ? Variant(value) : Variant(); }
    static std::optional<Ref<T>> from_variant(const Variant& value) {
        static_assert(std::is_base_of_v<Reference, T>, "only ref-counted objects are held by a Variant");
        if (value.is_nil()) {
            return Ref<T>();
        }
        if (value.type() != Variant::Type::Object) {
            return std::nullopt;
        }
        Reference* object = value.to_object();
        if (!object) {
            return Ref<T>();
        }
        T* wanted = dynamic_cast<T*>(object);
        return wanted ? std::optional<Ref<T>>(Ref<T>(wanted)) : std::nullopt;
    }
};

} // namespace cl
