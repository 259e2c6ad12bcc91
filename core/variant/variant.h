#pragma once

#include "core/math/aabb.h"
#include "core/math/color.h"
#include "core/math/transform.h"
#include "core/node_path.h"
#include "core/ref.h"
#include "core/string_name.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace cl {

class Reference; // core/object/object.h: a ref-counted Object
class Variant;

/// Copy-on-write array of plain values: copies share one block until one of them is changed.
template <typename T>
class PoolArray {
public:
    PoolArray() = default;
    PoolArray(std::vector<T> values) : block_(std::make_shared<std::vector<T>>(std::move(values))) {}
    [[nodiscard]] std::span<const T> span() const noexcept {
        return block_ ? std::span<const T>(*block_) : std::span<const T>();
    }
    [[nodiscard]] size_t size() const noexcept { return block_ ? block_->size() : 0; }
    [[nodiscard]] bool empty() const noexcept { return size() == 0; }
    const T& operator[](size_t i) const { return (*block_)[i]; }
    /// The values for writing; makes a private copy first if they are shared.
    [[nodiscard]] std::vector<T>& edit() {
        if (!block_) {
            block_ = std::make_shared<std::vector<T>>();
        } else if (block_.use_count() > 1) {
            block_ = std::make_shared<std::vector<T>>(*block_);
        }
        return *block_;
    }
    friend bool operator==(const PoolArray& a, const PoolArray& b) {
        return a.block_ == b.block_ ||
               std::equal(a.span().begin(), a.span().end(), b.span().begin(), b.span().end());
    }

private:
    std::shared_ptr<std::vector<T>> block_;
};

using PoolByteArray = PoolArray<uint8_t>;
using PoolIntArray = PoolArray<int32_t>;
using PoolRealArray = PoolArray<float>;
using PoolStringArray = PoolArray<std::string>;
using PoolVector2Array = PoolArray<glm::vec2>;
using PoolVector3Array = PoolArray<glm::vec3>;
using PoolColorArray = PoolArray<Color>;

/// Value semantics (unlike Godot's shared arrays): a copy is independent.
using Array = std::vector<Variant>;

/// Key-value pairs in insertion order; a key set twice keeps its place and takes the last value. Keys are the
/// same if they have one type and equal values (1 and 1.0 are two keys; NaN is the same key as NaN).
class Dictionary {
public:
    using Entry = std::pair<Variant, Variant>;
    [[nodiscard]] const std::vector<Entry>& entries() const noexcept;
    void set(Variant key, Variant value);
    /// nullptr if there is no such key.
    [[nodiscard]] const Variant* find(const Variant& key) const noexcept;
    [[nodiscard]] const Variant* find(std::string_view key) const noexcept;
    [[nodiscard]] const Variant* find(const char* key) const noexcept { return find(std::string_view(key)); }
    [[nodiscard]] const Variant* find(const std::string& key) const noexcept {
        return find(std::string_view(key));
    }
    [[nodiscard]] size_t size() const noexcept;
    /// The same keys with equal values, in any order.
    friend bool operator==(const Dictionary&, const Dictionary&);

private:
    [[nodiscard]] size_t find_position(const Variant& key) const noexcept;
    void add_to_index(size_t position);
    void rebuild_index();

    std::vector<Entry> entries_;
    // Open-addressing hash table: 0 is a free slot, n stands for entry n - 1. Empty while there are few
    // entries.
    std::vector<uint32_t> index_;
};

/// The `RID( n )` of a text file: a bare number without meaning outside the program that wrote it.
struct TextRID {
    int64_t id = 0;
    friend bool operator==(const TextRID&, const TextRID&) = default;
};

/// A Ref<Reference> whose copying is compiled in variant.cpp, where Reference is a complete type.
class ObjectRef {
public:
    ObjectRef() noexcept = default;
    explicit ObjectRef(const Ref<Reference>& ref);
    ObjectRef(const ObjectRef& other);
    ObjectRef(ObjectRef&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    ObjectRef& operator=(const ObjectRef& other) {
        ObjectRef copy(other);
        std::swap(object_, copy.object_);
        return *this;
    }
    ObjectRef& operator=(ObjectRef&& other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~ObjectRef();
    [[nodiscard]] Reference* get() const noexcept { return object_; }
    friend bool operator==(const ObjectRef& a, const ObjectRef& b) noexcept { return a.object_ == b.object_; }

private:
    Reference* object_ = nullptr;
};

/// Any value that the text scene format can hold (scene format 2 of Godot 3).
class Variant {
public:
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow" // GCC 12 takes scoped enumerators for shadows of the aliases above
    /// Numbers are Godot 3's own type numbers, as stored in binary files.
    enum class Type : uint8_t {
        Nil = 0,
        Bool,
        Int,
        Real,
        String,
        Vector2,
        Rect2,
        Vector3,
        Transform2D,
        Plane,
        Quat,
        AABB,
        Basis,
        Transform,
        Color,
        NodePath,
        RID,
        Object,
        Dictionary,
        Array,
        PoolByteArray,
        PoolIntArray,
        PoolRealArray,
        PoolStringArray,
        PoolVector2Array,
        PoolVector3Array,
        PoolColorArray,
        Count,
    };
#pragma GCC diagnostic pop

    Variant() noexcept = default;
    Variant(std::nullptr_t) noexcept {}
    Variant(bool v) : value_(v) {}
    Variant(int v) : value_(static_cast<int64_t>(v)) {}
    Variant(uint32_t v) : value_(static_cast<int64_t>(v)) {}
    Variant(int64_t v) : value_(v) {}
    Variant(float v) : value_(static_cast<double>(v)) {}
    Variant(double v) : value_(v) {}
    Variant(const char* v) : value_(std::string(v)) {}
    Variant(std::string_view v) : value_(std::string(v)) {}
    Variant(std::string v) : value_(std::move(v)) {}
    Variant(const StringName& v) : value_(v.str()) {}
    Variant(glm::vec2 v) : value_(v) {}
    Variant(const cl::Rect2& v) : value_(v) {}
    Variant(glm::vec3 v) : value_(v) {}
    Variant(const cl::Transform2D& v) : value_(v) {}
    Variant(const cl::Plane& v) : value_(v) {}
    Variant(const glm::quat& v) : value_(v) {}
    Variant(const cl::AABB& v) : value_(v) {}
    Variant(const glm::mat3& v) : value_(v) {}
    Variant(const cl::Transform& v) : value_(v) {}
    Variant(const cl::Color& v) : value_(v) {}
    Variant(cl::NodePath v) : value_(std::move(v)) {}
    Variant(TextRID v) : value_(v) {}
    Variant(ObjectRef v) : value_(std::move(v)) {}
    template <typename T>
    Variant(const Ref<T>& v) : value_(ObjectRef(Ref<Reference>(v))) {}
    Variant(cl::Dictionary v) : value_(std::make_shared<cl::Dictionary>(std::move(v))) {}
    Variant(cl::Array v) : value_(std::make_shared<cl::Array>(std::move(v))) {}
    Variant(cl::PoolByteArray v) : value_(std::move(v)) {}
    Variant(cl::PoolIntArray v) : value_(std::move(v)) {}
    Variant(cl::PoolRealArray v) : value_(std::move(v)) {}
    Variant(cl::PoolStringArray v) : value_(std::move(v)) {}
    Variant(cl::PoolVector2Array v) : value_(std::move(v)) {}
    Variant(cl::PoolVector3Array v) : value_(std::move(v)) {}
    Variant(cl::PoolColorArray v) : value_(std::move(v)) {}

    [[nodiscard]] Type type() const noexcept {
        return static_cast<Type>(value_.index());
    }
    [[nodiscard]] bool is_nil() const noexcept {
        return type() == Type::Nil;
    }
    [[nodiscard]] bool is_num() const noexcept {
        return type() == Type::Int || type() == Type::Real;
    }

    /// The stored value if it is exactly a T, else nullptr. T: bool, int64_t, double, std::string, glm::vec2,
    /// ..., cl::Dictionary, cl::Array, cl::PoolByteArray, ...; for objects see to_object().
    template <typename T>
    [[nodiscard]] const T* get_if() const noexcept {
        if constexpr (std::is_same_v<T, cl::Dictionary> || std::is_same_v<T, cl::Array>) {
            const auto* p = std::get_if<std::shared_ptr<T>>(&value_);
            return p ? p->get() : nullptr;
        } else {
            return std::get_if<T>(&value_);
        }
    }

    /// This value converted as an assignment to a property of type `to` converts it (spec tscn section 4):
    /// int, real and bool into each other (real to int truncates), String to NodePath and back, Array to a
    /// Pool array and back when every element fits. std::nullopt where Godot would ignore the assignment.
    [[nodiscard]] std::optional<Variant> converted_to(Type to) const;

    /// Conversions for getters whose type was checked before; a wrong type gives the type's zero value.
    [[nodiscard]] bool to_bool() const noexcept;
    [[nodiscard]] int64_t to_int() const noexcept;
    [[nodiscard]] double to_real() const noexcept;
    [[nodiscard]] std::string to_text() const; ///< String, NodePath; else the text Godot's str() gives
    [[nodiscard]] Reference* to_object() const noexcept; ///< nullptr unless it holds an object; a borrow

    /// Exact comparison, type included; objects by identity. NaN differs from itself.
    friend bool operator==(const Variant& a, const Variant& b);

private:
    // Order is that of Type: index() is the type number.
    std::variant<std::monostate, bool, int64_t, double, std::string, glm::vec2, cl::Rect2, glm::vec3,
                 cl::Transform2D, cl::Plane, glm::quat, cl::AABB, glm::mat3, cl::Transform, cl::Color,
                 cl::NodePath, TextRID, ObjectRef, std::shared_ptr<cl::Dictionary>,
                 std::shared_ptr<cl::Array>, cl::PoolByteArray, cl::PoolIntArray, cl::PoolRealArray,
                 cl::PoolStringArray, cl::PoolVector2Array, cl::PoolVector3Array, cl::PoolColorArray>
        value_;
};

/// Godot's name of a type as the text format spells it: "Nil", "bool", "int", "float", "String", "Vector2",
/// ...
[[nodiscard]] std::string_view type_name(Variant::Type type) noexcept;

} // namespace cl
