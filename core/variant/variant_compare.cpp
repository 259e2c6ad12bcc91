#include "core/variant/variant_compare.h"

#include "core/variant/variant_components.h"

#include <algorithm>
#include <cstring>
#include <functional>

namespace cl {
namespace {

using Type = Variant::Type;

/// Calls f with the elements of a pool array as a span; `otherwise` for values of other types.
template <typename Result, typename F>
Result visit_pool(const Variant& v, Result otherwise, F f) {
    switch (v.type()) {
    case Type::PoolByteArray:
        return f(v.get_if<PoolByteArray>()->span());
    case Type::PoolIntArray:
        return f(v.get_if<PoolIntArray>()->span());
    case Type::PoolRealArray:
        return f(v.get_if<PoolRealArray>()->span());
    case Type::PoolStringArray:
        return f(v.get_if<PoolStringArray>()->span());
    case Type::PoolVector2Array:
        return f(v.get_if<PoolVector2Array>()->span());
    case Type::PoolVector3Array:
        return f(v.get_if<PoolVector3Array>()->span());
    case Type::PoolColorArray:
        return f(v.get_if<PoolColorArray>()->span());
    default:
        return otherwise;
    }
}

/// Equality of values and of their parts. kNanEqual: whether NaN equals NaN (dictionary keys) or not (==).
template <bool kNanEqual>
struct Equality {
    static bool of(double a, double b) noexcept { return a == b || (kNanEqual && a != a && b != b); }
    static bool of(float a, float b) noexcept { return of(static_cast<double>(a), static_cast<double>(b)); }
    static bool of(uint8_t a, uint8_t b) noexcept { return a == b; }
    static bool of(int32_t a, int32_t b) noexcept { return a == b; }
    static bool of(const std::string& a, const std::string& b) noexcept { return a == b; }
    static bool of(glm::vec2 a, glm::vec2 b) noexcept { return of(a.x, b.x) && of(a.y, b.y); }
    static bool of(const glm::vec3& a, const glm::vec3& b) noexcept {
        return of(a.x, b.x) && of(a.y, b.y) && of(a.z, b.z);
    }
    static bool of(const Color& a, const Color& b) noexcept { return of(a.rgb(), b.rgb()) && of(a.a, b.a); }
    template <typename T>
    static bool of(std::span<const T> a, std::span<const T> b) noexcept {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](const T& x, const T& y) { return of(x, y); });
    }
    static bool of(const Dictionary& a, const Dictionary& b) noexcept {
        return a.size() == b.size() &&
               std::all_of(a.entries().begin(), a.entries().end(), [&](const auto& entry) {
                   const Variant* other = b.find(entry.first);
                   return other && of(*other, entry.second);
               });
    }
    static bool of(const Variant& a, const Variant& b) noexcept {
        if (a.type() != b.type()) {
            return false;
        }
        switch (a.type()) {
        case Type::Nil:
            return true;
        case Type::Bool:
            return *a.get_if<bool>() == *b.get_if<bool>();
        case Type::Int:
            return *a.get_if<int64_t>() == *b.get_if<int64_t>();
        case Type::Real:
            return of(*a.get_if<double>(), *b.get_if<double>());
        case Type::String:
            return *a.get_if<std::string>() == *b.get_if<std::string>();
        case Type::NodePath:
            return *a.get_if<NodePath>() == *b.get_if<NodePath>();
        case Type::RID:
            return *a.get_if<TextRID>() == *b.get_if<TextRID>();
        case Type::Object:
            return a.to_object() == b.to_object();
        case Type::Dictionary:
            return of(*a.get_if<Dictionary>(), *b.get_if<Dictionary>());
        case Type::Array:
            return of(std::span<const Variant>(*a.get_if<Array>()), *b.get_if<Array>());
        default:
            break;
        }
        if (component_count(a.type()) > 0) {
            return of(components_of(a).span(), components_of(b).span());
        }
        return visit_pool(a, false, [&]<typename T>(std::span<const T> elements) {
            return of(elements, b.get_if<PoolArray<T>>()->span());
        });
    }
    static bool of(std::span<const Variant> a, const Array& b) noexcept {
        return of(a, std::span<const Variant>(b));
    }
};

/// One round of splitmix64: spreads small integers over all bits, so that a power-of-two table fills evenly.
size_t mixed(size_t seed, size_t value) noexcept {
    uint64_t x = seed * 0x9e3779b97f4a7c15u + value + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return static_cast<size_t>(x ^ (x >> 31));
}

size_t hash_of(double value) noexcept {
    if (value != value) {
        return 1; // every NaN is the same key
    }
    const double canonical = value == 0.0 ? 0.0 : value; // -0 equals 0
    uint64_t bits = 0;
    std::memcpy(&bits, &canonical, sizeof bits);
    return static_cast<size_t>(bits);
}
size_t hash_of(float v) noexcept {
    return hash_of(static_cast<double>(v));
}
size_t hash_of(uint8_t v) noexcept {
    return v;
}
size_t hash_of(int32_t v) noexcept {
    return static_cast<size_t>(v);
}
size_t hash_of(const std::string& v) noexcept {
    return std::hash<std::string_view>{}(v);
}
size_t hash_of(glm::vec2 v) noexcept {
    return mixed(hash_of(v.x), hash_of(v.y));
}
size_t hash_of(const glm::vec3& v) noexcept {
    return mixed(hash_of(glm::vec2(v)), hash_of(v.z));
}
size_t hash_of(const Color& v) noexcept {
    return mixed(hash_of(v.rgb()), hash_of(v.a));
}
size_t hash_of(const Variant& v) noexcept {
    return hash_key(v);
}

template <typename T>
size_t hash_of(std::span<const T> values) noexcept {
    size_t hash = values.size();
    for (const T& value : values) {
        hash = mixed(hash, hash_of(value));
    }
    return hash;
}

size_t hash_of(const Dictionary& dictionary) noexcept {
    size_t hash = dictionary.size();
    for (const auto& [key, value] : dictionary.entries()) {
        hash += mixed(hash_key(key), hash_key(value)); // a sum: order does not matter
    }
    return hash;
}

/// hash_key() before the type is mixed in.
size_t hash_content(const Variant& key) noexcept {
    switch (key.type()) {
    case Type::Nil:
        return 0;
    case Type::Bool:
    case Type::Int:
        return static_cast<size_t>(key.to_int());
    case Type::Real:
        return hash_of(key.to_real());
    case Type::String:
        return hash_of(*key.get_if<std::string>());
    case Type::NodePath:
        return hash_of(key.get_if<NodePath>()->to_string());
    case Type::RID:
        return static_cast<size_t>(key.get_if<TextRID>()->id);
    case Type::Object:
        return std::hash<const void*>{}(key.to_object());
    case Type::Dictionary:
        return hash_of(*key.get_if<Dictionary>());
    case Type::Array:
        return hash_of(std::span<const Variant>(*key.get_if<Array>()));
    default:
        break;
    }
    if (component_count(key.type()) > 0) {
        return hash_of(components_of(key).span());
    }
    return visit_pool(key, size_t{0}, [](auto elements) { return hash_of(elements); });
}

size_t element_count(const Variant& v) noexcept {
    const Array* array = v.get_if<Array>();
    return array ? array->size() : visit_pool(v, size_t{0}, [](auto elements) { return elements.size(); });
}

bool real_less(double a, double b) noexcept {
    return a < b || (a != a && b == b);
}

} // namespace

bool operator==(const Variant& a, const Variant& b) {
    return Equality<false>::of(a, b);
}
bool operator==(const Dictionary& a, const Dictionary& b) {
    return Equality<false>::of(a, b);
}
bool same_key(const Variant& a, const Variant& b) noexcept {
    return Equality<true>::of(a, b);
}

size_t hash_key(const Variant& key) noexcept {
    return mixed(static_cast<size_t>(key.type()), hash_content(key));
}

size_t hash_key(std::string_view text) noexcept {
    return mixed(static_cast<size_t>(Type::String), std::hash<std::string_view>{}(text));
}

bool key_less(const Variant& a, const Variant& b) noexcept {
    if (a.type() != b.type()) {
        return a.type() < b.type();
    }
    switch (a.type()) {
    case Type::Bool:
    case Type::Int:
        return a.to_int() < b.to_int();
    case Type::Real:
        return real_less(a.to_real(), b.to_real());
    case Type::String:
        return *a.get_if<std::string>() < *b.get_if<std::string>();
    case Type::Vector2:
    case Type::Vector3: {
        const Components x = components_of(a), y = components_of(b);
        return std::lexicographical_compare(x.span().begin(), x.span().end(), y.span().begin(),
                                            y.span().end(), real_less);
    }
    default:
        return element_count(a) < element_count(b);
    }
}

} // namespace cl
