#include "scene/resources/material.h"

#include "servers/visual_server.h"

#include "core/object/class_registry.h"

#include <algorithm>

namespace cl::scene {

void Material::bind(ClassBuilder<Material>& c) {
    c.doc("How a surface reflects and emits light.").abstract();
    c.property("render_priority", &Material::render_priority, &Material::set_render_priority)
        .range("-128,127,1")
        .doc("Transparent surfaces of a higher priority are drawn over those of a lower one.");
    c.property("next_pass", &Material::next_pass, &Material::set_next_pass)
        .doc("Material of a further pass; stored, not drawn.");
}

SetResult Material::set_render_priority(int priority) {
    if (priority < -128 || priority > 127) {
        return SetResult::Refused;
    }
    render_priority_ = priority;
    material_changed();
    return SetResult::Done;
}

SetResult Material::set_next_pass(Ref<Material> material) {
    for (const Material* m = material.get(); m; m = m->next_pass_.get()) {
        if (m == this) {
            return SetResult::Refused;
        }
    }
    next_pass_ = std::move(material);
    material_changed();
    return SetResult::Done;
}

RID Material::rid(VisualServer& server) const {
    if (const RID made = rid_.in(server)) {
        return made;
    }
    rid_.adopt(server, server.material_create(describe(server)));
    return rid_.get();
}

void Material::material_changed() {
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->material_set(rid_.get(), describe(*server)));
    }
    emit_changed();
}

} // namespace cl::scene
