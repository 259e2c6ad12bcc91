#include "core/object/resource.h"

#include "core/object/class_registry.h"

namespace cl {

namespace {
const StringName kChanged("changed");
}

void Resource::bind(ClassBuilder<Resource>& c) {
    c.doc("Data that nodes share and files hold.");
    c.property("resource_local_to_scene", &Resource::local_to_scene, &Resource::set_local_to_scene)
        .doc("Each instance of the scene gets a copy of its own.")
        .default_value(false);
    c.property("resource_name", &Resource::name, &Resource::set_name)
        .doc("A name for people; need not be unique.")
        .default_value("");
    c.signal(kChanged.view(), {}, "A property changed in a way that users of the resource must see.");
}

uint64_t Resource::on_changed(std::function<void()> f) {
    Expected<uint64_t> id = connect(kChanged, [f = std::move(f)](std::span<const Variant>) { f(); });
    CL_ASSERT(id, "Resource::bind() has no signal \"changed\"");
    return *id;
}

void Resource::remove_on_changed(uint64_t id) {
    disconnect(kChanged, id);
}

void Resource::emit_changed() {
    emit_signal(kChanged);
}

} // namespace cl
