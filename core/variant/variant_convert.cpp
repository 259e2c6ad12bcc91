// Variant::converted_to: the conversions that an assignment in a scene file makes (tscn format, section 4).

#include "core/variant/numbers.h"
#include "core/variant/variant.h"

#include <concepts>

namespace cl {
namespace {

using Type = Variant::Type;

bool is_number_like(const Variant& value) {
    return value.is_num() || value.type() == Type::Bool;
}

// What an element of an Array becomes in a Pool array; false if it does not fit.
bool convert_element(const Variant& from, int32_t& to) {
    const double* real = from.get_if<double>();
    to = real ? truncated_to_int32(*real) : static_cast<int32_t>(from.to_int()); // integers modulo 2^32
    return is_number_like(from);
}
bool convert_element(const Variant& from, uint8_t& to) {
    int32_t number = 0;
    const bool fits = convert_element(from, number);
    to = static_cast<uint8_t>(number); // modulo 256
    return fits;
}
bool convert_element(const Variant& from, float& to) {
    to = static_cast<float>(from.to_real());
    return is_number_like(from);
}
bool convert_element(const Variant& from, std::string& to) {
    const std::optional<Variant> text = from.converted_to(Type::String);
    if (text) {
        to = *text->get_if<std::string>();
    }
    return text.has_value();
}
template <typename T>
requires std::same_as<T, glm::vec2> || std::same_as<T, glm::vec3> || std::same_as<T, Color>
bool convert_element(const Variant& from, T& to) {
    const T* exact = from.get_if<T>();
    if (exact) {
        to = *exact;
    }
    return exact != nullptr;
}

template <typename T>
std::optional<Variant> pool_from_array(const Array& array) {
    std::vector<T> values(array.size());
    for (size_t i = 0; i < array.size(); i++) {
        T value{};
        if (!convert_element(array[i], value)) {
            return std::nullopt;
        }
        values[i] = std::move(value);
    }
    return Variant(PoolArray<T>(std::move(values)));
}

std::optional<Variant> pool_from_array(const Array& array, Type to) {
    switch (to) {
    case Type::PoolByteArray:
        return pool_from_array<uint8_t>(array);
    case Type::PoolIntArray:
        return pool_from_array<int32_t>(array);
    case Type::PoolRealArray:
        return pool_from_array<float>(array);
    case Type::PoolStringArray:
        return pool_from_array<std::string>(array);
    case Type::PoolVector2Array:
        return pool_from_array<glm::vec2>(array);
    case Type::PoolVector3Array:
        return pool_from_array<glm::vec3>(array);
    case Type::PoolColorArray:
        return pool_from_array<Color>(array);
    default:
        return std::nullopt;
    }
}

template <typename T>
std::optional<Variant> array_from_pool(const Variant& pool) {
    Array array;
    const std::span<const T> values = pool.get_if<PoolArray<T>>()->span();
    array.reserve(values.size());
    for (const T& value : values) {
        if constexpr (std::same_as<T, uint8_t>) {
            array.emplace_back(static_cast<int>(value));
        } else {
            array.emplace_back(value);
        }
    }
    return Variant(std::move(array));
}

std::optional<Variant> array_from_pool(const Variant& pool) {
    switch (pool.type()) {
    case Type::PoolByteArray:
        return array_from_pool<uint8_t>(pool);
    case Type::PoolIntArray:
        return array_from_pool<int32_t>(pool);
    case Type::PoolRealArray:
        return array_from_pool<float>(pool);
    case Type::PoolStringArray:
        return array_from_pool<std::string>(pool);
    case Type::PoolVector2Array:
        return array_from_pool<glm::vec2>(pool);
    case Type::PoolVector3Array:
        return array_from_pool<glm::vec3>(pool);
    case Type::PoolColorArray:
        return array_from_pool<Color>(pool);
    default:
        return std::nullopt;
    }
}

} // namespace

std::optional<Variant> Variant::converted_to(Type to) const {
    if (type() == to || to == Type::Nil) { // Nil: a property that takes any value
        return *this;
    }
    const bool number_like = is_number_like(*this);
    switch (to) {
    case Type::Bool:
        return number_like ? std::optional<Variant>(to_bool()) : std::nullopt;
    case Type::Int:
        return number_like ? std::optional<Variant>(to_int()) : std::nullopt;
    case Type::Real:
        return number_like ? std::optional<Variant>(to_real()) : std::nullopt;
    case Type::String: {
        const cl::NodePath* path = get_if<cl::NodePath>();
        return path ? std::optional<Variant>(path->to_string()) : std::nullopt;
    }
    case Type::NodePath: {
        const std::string* text = get_if<std::string>();
        return text ? std::optional<Variant>(cl::NodePath(*text)) : std::nullopt;
    }
    case Type::Object:
        return is_nil() ? std::optional<Variant>(ObjectRef()) : std::nullopt;
    case Type::Array:
        return array_from_pool(*this);
    default: {
        const cl::Array* array = get_if<cl::Array>();
        return array ? pool_from_array(*array, to) : std::nullopt;
    }
    }
}

} // namespace cl
