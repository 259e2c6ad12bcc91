#include "scene/3d/visual_instance.h"

#include "scene/3d/server_call.h"
#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"

#include "servers/visual_server.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void VisualInstance::bind(ClassBuilder<VisualInstance>& c) {
    c.doc("A node that the renderer sees. Abstract.").abstract();
    c.property("layers", &VisualInstance::layers, &VisualInstance::set_layers)
        .doc("Bit mask: seen by cameras and lit by lights whose cull mask has one of these bits.")
        .hint(PropertyHint::Flags, "20 layers")
        .default_value(1);
}

void VisualInstance::set_layers(uint32_t mask) {
    layers_ = mask;
    if (instance_.get()) {
        tell(server()->instance_set_layers(instance_.get(), layers_));
    }
}

RID VisualInstance::base_rid(VisualServer& /*server*/) {
    return {};
}

bool VisualInstance::is_shown() const {
    return is_visible_in_tree();
}

void VisualInstance::describe_instance(VisualServer& server, RID instance) {
    tell(server.instance_set_transform(instance, global_transform()));
    tell(server.instance_set_visible(instance, is_shown()));
    tell(server.instance_set_layers(instance, layers_));
}

void VisualInstance::show_or_hide() {
    if (instance_.get()) {
        tell(server()->instance_set_visible(instance_.get(), is_shown()));
    }
}

bool VisualInstance::update_base() {
    if (!instance_.get()) {
        return false;
    }
    const RID base = base_rid(*server());
    if (base == base_) {
        return false;
    }
    base_ = base;
    tell(server()->instance_set_base(instance_.get(), base));
    return true;
}

void VisualInstance::restart_base() {
    if (instance_.get() && base_) {
        base_ = RID{};
        tell(server()->instance_set_base(instance_.get(), base_));
    }
    update_base();
}

void VisualInstance::notification(Notification what) {
    Spatial::notification(what);
    switch (what) {
    case Notification::EnterTree:
        if (VisualServer* s = server()) {
            base_ = base_rid(*s);
            instance_.adopt(*s, s->instance_create(base_, tree()->world().scenario()));
            describe_instance(*s, instance_.get());
        }
        break;
    case Notification::ExitTree:
        instance_.reset();
        base_ = RID{};
        break;
    case Notification::TransformChanged:
        if (instance_.get()) {
            tell(server()->instance_set_transform(instance_.get(), global_transform()));
        }
        break;
    case Notification::VisibilityChanged:
        show_or_hide();
        break;
    default:
        break;
    }
}

} // namespace cl::scene
