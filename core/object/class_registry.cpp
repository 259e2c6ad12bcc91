#include "core/object/class_registry.h"

#include "core/object/resource.h"

#include <fmt/core.h>

#include <algorithm>

namespace cl {

namespace detail {

Error wrong_argument_count(size_t expected, size_t found) {
    return {ErrorCode::InvalidArgument,
            fmt::format("expected {} argument{}, found {}", expected, expected == 1 ? "" : "s", found)};
}

Error wrong_argument_type(size_t index, Variant::Type expected, Variant::Type found) {
    return {ErrorCode::InvalidArgument, fmt::format("argument {}: expected {}, found {}", index + 1,
                                                    type_name(expected), type_name(found))};
}

} // namespace detail

const PropertyInfo* ClassInfo::find_property(const StringName& property) const noexcept {
    for (const ClassInfo* c = this; c; c = c->parent) {
        for (const PropertyInfo& p : c->properties) {
            if (p.name == property) {
                return &p;
            }
        }
    }
    return nullptr;
}

const MethodInfo* ClassInfo::find_method(const StringName& method) const noexcept {
    for (const ClassInfo* c = this; c; c = c->parent) {
        for (const MethodInfo& m : c->methods) {
            if (m.name == method) {
                return &m;
            }
        }
    }
    return nullptr;
}

bool ClassInfo::has_signal(const StringName& signal) const noexcept {
    for (const ClassInfo* c = this; c; c = c->parent) {
        if (std::any_of(c->signals.begin(), c->signals.end(),
                        [&](const SignalInfo& s) { return s.name == signal; })) {
            return true;
        }
    }
    return false;
}

bool ClassInfo::is_a(const StringName& class_name) const noexcept {
    for (const ClassInfo* c = this; c; c = c->parent) {
        if (c->name == class_name) {
            return true;
        }
    }
    return false;
}

std::vector<const ClassInfo*> ClassInfo::lineage() const {
    std::vector<const ClassInfo*> chain;
    for (const ClassInfo* c = this; c; c = c->parent) {
        chain.push_back(c);
    }
    std::reverse(chain.begin(), chain.end());
    return chain;
}

const Variant& ClassInfo::default_of(const PropertyInfo& property) const {
    static const Variant nil;
    if (!create) {
        return property.declared_default ? *property.declared_default : nil;
    }
    // Not at registration: a fresh resource may already want services that start later.
    if (!fresh_values_) {
        std::unordered_map<StringName, Variant> values;
        std::unique_ptr<Object> fresh = create();
        Ref<Reference> keep_alive(
            dynamic_cast<Reference*>(fresh.get())); // a getter may make and drop a Ref to it
        if (keep_alive) {
            static_cast<void>(fresh.release());
        }
        const Object& instance = keep_alive ? static_cast<const Object&>(*keep_alive) : *fresh;
        for (const ClassInfo* c = this; c; c = c->parent) {
            for (const PropertyInfo& p : c->properties) {
                values.emplace(p.name, p.get(instance)); // a derived class's property hides its base's
            }
        }
        fresh_values_ = std::move(values);
    }
    const auto found = fresh_values_->find(property.name);
    return found != fresh_values_->end() ? found->second : nil;
}

ClassRegistry& ClassRegistry::instance() {
    static ClassRegistry registry;
    return registry;
}

const ClassInfo* ClassRegistry::find(const StringName& name) const noexcept {
    const auto found = by_name_.find(name);
    return found != by_name_.end() ? found->second : nullptr;
}

const ClassInfo* ClassRegistry::find(std::type_index type) const noexcept {
    const auto found = by_type_.find(type);
    return found != by_type_.end() ? found->second : nullptr;
}

const ClassInfo* ClassRegistry::class_of(const Object& object) const {
    if (const ClassInfo* exact = find(std::type_index(typeid(object)))) {
        return exact;
    }
    // Bases are registered before what derives from them, so the last that fits is the most derived.
    for (auto c = classes_.rbegin(); c != classes_.rend(); ++c) {
        if ((*c)->is_instance(object)) {
            return c->get();
        }
    }
    return nullptr;
}

std::unique_ptr<Object> ClassRegistry::create(const StringName& name) const {
    const ClassInfo* info = find(name);
    return info && info->create ? info->create() : nullptr;
}

Ref<Reference> ClassRegistry::create_ref(const StringName& name) const {
    static const StringName reference(Reference::kClassName);
    const ClassInfo* info = find(name);
    if (!info || !info->create || !info->is_a(reference)) {
        return {};
    }
    return Ref<Reference>(dynamic_cast<Reference*>(info->create().release()));
}

std::vector<const ClassInfo*> ClassRegistry::classes() const {
    std::vector<const ClassInfo*> all;
    all.reserve(classes_.size());
    for (const std::unique_ptr<ClassInfo>& c : classes_) {
        all.push_back(c.get());
    }
    return all;
}

ClassInfo& ClassRegistry::insert(std::string_view name, std::type_index type, const ClassInfo* parent) {
    const StringName key(name);
    CL_ASSERT(!by_name_.count(key), "two classes with one name: the second lacks a kClassName of its own");
    ClassInfo& info = *classes_.emplace_back(std::make_unique<ClassInfo>());
    info.name = key;
    info.parent = parent;
    by_name_.emplace(key, &info);
    by_type_.emplace(type, &info);
    return info;
}

void register_core_types(ClassRegistry& registry) {
    registry.add<Object>();
    registry.add<Reference, Object>();
    registry.add<Resource, Reference>();
}

} // namespace cl
