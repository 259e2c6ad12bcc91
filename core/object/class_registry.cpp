#include "core/object/class_registry.h"

#include "core/object/resource.h"

namespace cl {

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
