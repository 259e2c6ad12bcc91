#include "core/variant/variant.h"

#include "core/object/object.h"
#include "core/variant/numbers.h"
#include "core/variant/variant_writer.h"

#include <array>

namespace cl {

ObjectRef::ObjectRef(const Ref<Reference>& ref) : object_(ref.get()) {
    if (object_) {
        object_->retain();
    }
}

ObjectRef::ObjectRef(const ObjectRef& other) : object_(other.object_) {
    if (object_) {
        object_->retain();
    }
}

ObjectRef::~ObjectRef() {
    if (object_ && object_->release()) {
        delete object_;
    }
}

bool Variant::to_bool() const noexcept {
    switch (type()) {
    case Type::Bool:
        return *get_if<bool>();
    case Type::Int:
        return *get_if<int64_t>() != 0;
    case Type::Real:
        return *get_if<double>() != 0.0;
    default:
        return false;
    }
}

int64_t Variant::to_int() const noexcept {
    switch (type()) {
    case Type::Bool:
        return *get_if<bool>() ? 1 : 0;
    case Type::Int:
        return *get_if<int64_t>();
    case Type::Real:
        return truncated_to_int(*get_if<double>());
    default:
        return 0;
    }
}

double Variant::to_real() const noexcept {
    switch (type()) {
    case Type::Bool:
        return *get_if<bool>() ? 1.0 : 0.0;
    case Type::Int:
        return static_cast<double>(*get_if<int64_t>());
    case Type::Real:
        return *get_if<double>();
    default:
        return 0.0;
    }
}

std::string Variant::to_text() const {
    return variant_to_str(*this);
}

Reference* Variant::to_object() const noexcept {
    const ObjectRef* object = get_if<ObjectRef>();
    return object ? object->get() : nullptr;
}

std::string_view type_name(Variant::Type type) noexcept {
    static constexpr std::array<std::string_view, static_cast<size_t>(Variant::Type::Count)> kNames = {
        "Nil",
        "bool",
        "int",
        "float",
        "String",
        "Vector2",
        "Rect2",
        "Vector3",
        "Transform2D",
        "Plane",
        "Quat",
        "AABB",
        "Basis",
        "Transform",
        "Color",
        "NodePath",
        "RID",
        "Object",
        "Dictionary",
        "Array",
        "PoolByteArray",
        "PoolIntArray",
        "PoolRealArray",
        "PoolStringArray",
        "PoolVector2Array",
        "PoolVector3Array",
        "PoolColorArray"};
    return type < Variant::Type::Count ? kNames[static_cast<size_t>(type)] : "?";
}

} // namespace cl
