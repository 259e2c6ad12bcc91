#include "core/object/object.h"

#include "core/object/class_registry.h"

#include <fmt/core.h>

#include <algorithm>

namespace cl {

Object::Object() = default;

Object::~Object() {
    if (handle_) {
        *handle_ = nullptr; // for those who hold a locked handle at this moment
    }
}

const ClassInfo& Object::class_info() const {
    const ClassInfo* info = ClassRegistry::instance().class_of(*this);
    CL_ASSERT(info, "an Object is used before register_core_types()");
    return *info;
}

StringName Object::class_name() const {
    return declared_class_.empty() ? class_info().name : declared_class_;
}

SetResult Object::set(const StringName& property, const Variant& value) {
    if (const PropertyInfo* info = class_info().find_property(property)) {
        return info->set(*this, value);
    }
    const SetResult result = set_dynamic(property, value);
    if (result == SetResult::UnknownProperty) {
        keep_extra(property, value);
    }
    return result;
}

Variant Object::get(const StringName& property) const {
    if (const PropertyInfo* info = class_info().find_property(property)) {
        return info->get(*this);
    }
    Variant value;
    if (get_dynamic(property, value)) {
        return value;
    }
    const PropertyValue* extra = find_extra(property);
    return extra ? extra->value : Variant();
}

bool Object::has_property(const StringName& property) const {
    Variant ignored;
    return class_info().find_property(property) || get_dynamic(property, ignored) || find_extra(property);
}

void Object::keep_extra(const StringName& property, const Variant& value) {
    if (const PropertyValue* known = find_extra(property)) {
        extra_[static_cast<size_t>(known - extra_.data())].value = value;
        return;
    }
    extra_.push_back({property, value});
}

const Object::PropertyValue* Object::find_extra(const StringName& property) const noexcept {
    const auto found = std::find_if(extra_.begin(), extra_.end(),
                                    [&](const PropertyValue& p) { return p.name == property; });
    return found != extra_.end() ? &*found : nullptr;
}

Expected<Variant> Object::call(const StringName& method, std::span<const Variant> arguments) {
    const MethodInfo* info = class_info().find_method(method);
    if (!info) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{} has no method \"{}\"", class_name().view(), method.view())};
    }
    Expected<Variant> result = info->call(*this, arguments);
    if (!result) {
        return Error{result.error().code,
                     fmt::format("{}.{}(): {}", class_name().view(), method.view(), result.error().message)};
    }
    return result;
}

std::weak_ptr<Object*> Object::handle() const {
    if (!handle_) {
        handle_ = std::make_shared<Object*>(const_cast<Object*>(this));
    }
    return handle_;
}

SetResult Object::set_dynamic(const StringName&, const Variant&) {
    return SetResult::UnknownProperty;
}

bool Object::get_dynamic(const StringName&, Variant&) const {
    return false;
}

void Object::list_dynamic(std::vector<PropertyValue>&) const {}

} // namespace cl
