#include "core/object/class_info.h"

#include <algorithm>

namespace cl {

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

} // namespace cl
