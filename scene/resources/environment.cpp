#include "scene/resources/environment.h"

#include "servers/visual_server.h"

namespace cl::scene {

Environment::Environment() : sky_([this] { environment_changed(); }) {}

void Environment::set_desc(const EnvironmentDesc& desc) {
    desc_ = desc;
    desc_.sky = RID{};
    environment_changed();
}

void Environment::set_effects(const EnvironmentEffects& effects) {
    effects_ = effects;
    emit_changed();
}

void Environment::set_sky(Ref<Sky> sky) {
    sky_.set(std::move(sky));
    environment_changed();
}

EnvironmentDesc Environment::describe(VisualServer& server) const {
    EnvironmentDesc desc = desc_;
    if (sky_) {
        desc.sky = sky_->rid(server);
    }
    return desc;
}

RID Environment::rid(VisualServer& server) const {
    if (const RID made = rid_.in(server)) {
        return made;
    }
    rid_.adopt(server, server.environment_create(describe(server)));
    return rid_.get();
}

void Environment::environment_changed() {
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->environment_set(rid_.get(), describe(*server)));
    }
    emit_changed();
}

} // namespace cl::scene
