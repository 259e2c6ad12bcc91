#include "scene/3d/world_environment.h"

#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void WorldEnvironment::bind(ClassBuilder<WorldEnvironment>& c) {
    c.doc("Gives the world its environment.");
    c.property("environment", &WorldEnvironment::environment, &WorldEnvironment::set_environment)
        .doc("Background, ambient light, fog and tone mapping of the world.")
        .default_value(Variant());
}

void WorldEnvironment::set_environment(Ref<Environment> environment) {
    const Ref<Environment> old =
        std::exchange(environment_, std::move(environment)); // its RID is still shown
    if (is_inside_tree()) {
        tree()->world().environment_changed();
    }
}

void WorldEnvironment::notification(Notification what) {
    Node::notification(what);
    if (what == Notification::EnterTree) {
        tree()->world().world_environment_entered(*this);
    } else if (what == Notification::ExitTree) {
        tree()->world().world_environment_exited(*this);
    }
}

} // namespace cl::scene
