#include "scene/io/local_resources.h"

#include "core/object/class_registry.h"

namespace cl::scene {

Variant LocalResources::localized(const Variant& value) {
    const auto* original = dynamic_cast<const Resource*>(value.to_object());
    if (!original || !original->local_to_scene()) {
        return value;
    }
    const auto known = copies_.find(original);
    if (known != copies_.end()) {
        return known->second;
    }
    const Ref<Resource> copy =
        ClassRegistry::instance().create_ref(original->class_info().name).cast<Resource>();
    if (!copy) {
        return value; // of a class that code made up: nothing to make another one from
    }
    if (original->class_name() != original->class_info().name) {
        copy->set_declared_class(original->class_name());
    }
    copy->set_path(original->path());
    copies_.emplace(original, copy);
    for (const Object::PropertyValue& p : original->stored_properties()) {
        static_cast<void>(copy->set(p.name, localized(p.value)));
    }
    return copy;
}

} // namespace cl::scene
