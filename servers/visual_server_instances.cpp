// VisualServer: scenarios and instances.
#include "servers/visual/finite.h"
#include "servers/visual_server.h"
#include "servers/visual_server_impl.h"

#include <fmt/format.h>

#include <cmath>

namespace cl {

RID VisualServer::scenario_create() {
    return edit().instances.make_scenario();
}

Status VisualServer::scenario_set_environment(RID rid, RID environment) {
    Scenario* scenario = edit().instances.scenario(rid);
    if (!scenario) {
        return edit().stale.refuse("scenario_set_environment", "a scenario", rid);
    }
    if (Status live = edit().check_or_null("scenario_set_environment", "an environment", environment,
                                           edit().storage.environments);
        !live) {
        return live;
    }
    scenario->environment = environment;
    return {};
}

RID VisualServer::instance_create(RID base, RID scenario) {
    const RID instance = edit().instances.make();
    // Said in the log where they fail; the instance is then empty or nowhere.
    static_cast<void>(instance_set_scenario(instance, scenario));
    static_cast<void>(instance_set_base(instance, base));
    return instance;
}

Status VisualServer::instance_set_base(RID rid, RID base) {
    return edit().with_instance("instance_set_base", rid, [&](Instance& instance) -> Status {
        const Storage& storage = edit().storage;
        if (base && !storage.meshes.get(base) && !storage.lights.owns(base) &&
            !storage.gi_probes.owns(base)) {
            return edit().stale.refuse("instance_set_base", "a mesh, light or GI probe", base);
        }
        if (instance.base != base) {
            edit().instances.set_base(rid, base);
        }
        return {};
    });
}

Status VisualServer::instance_set_scenario(RID rid, RID scenario) {
    return edit().with_instance("instance_set_scenario", rid, [&](Instance&) -> Status {
        if (scenario && !edit().instances.scenario(scenario)) {
            return edit().stale.refuse("instance_set_scenario", "a scenario", scenario);
        }
        edit().instances.set_scenario(rid, scenario);
        return {};
    });
}

Status VisualServer::instance_set_transform(RID rid, const Transform& world_from_local) {
    return edit().with_instance("instance_set_transform", rid, [&](Instance&) -> Status {
        if (!is_finite(world_from_local)) {
            return edit().stale.refuse("instance_set_transform: expected a transform of finite numbers");
        }
        edit().instances.set_transform(rid, world_from_local);
        return {};
    });
}

Status VisualServer::instance_set_visible(RID rid, bool visible) {
    return edit().with_instance("instance_set_visible", rid, [&](Instance&) -> Status {
        edit().instances.set_visible(rid, visible);
        return {};
    });
}

Status VisualServer::instance_set_layers(RID rid, uint32_t mask) {
    return edit().with_instance("instance_set_layers", rid, [&](Instance& instance) -> Status {
        instance.layers = mask;
        return {};
    });
}

Status VisualServer::instance_set_surface_material(RID rid, int surface, RID material) {
    return edit().with_instance("instance_set_surface_material", rid, [&](Instance& instance) -> Status {
        const Mesh* mesh = edit().storage.meshes.get(instance.base);
        const size_t count = mesh ? mesh->surfaces.size() : 0;
        if (surface < 0 || static_cast<size_t>(surface) >= count) {
            return edit().stale.refuse(fmt::format(
                "instance_set_surface_material: expected a surface below {}, found {}", count, surface));
        }
        if (Status live = edit().check_or_null("instance_set_surface_material", "a material", material,
                                               edit().storage.materials);
            !live) {
            return live;
        }
        instance.surface_materials.resize(count);
        instance.surface_materials[static_cast<size_t>(surface)] = material;
        edit().instances.touch(rid);
        return {};
    });
}

Status VisualServer::instance_set_material_override(RID rid, RID material) {
    return edit().with_instance("instance_set_material_override", rid, [&](Instance& instance) -> Status {
        if (Status live = edit().check_or_null("instance_set_material_override", "a material", material,
                                               edit().storage.materials);
            !live) {
            return live;
        }
        instance.material_override = material;
        edit().instances.touch(rid);
        return {};
    });
}

Status VisualServer::instance_set_casting(RID rid, ShadowCasting casting) {
    return edit().with_instance("instance_set_casting", rid, [&](Instance& instance) -> Status {
        instance.casting = casting;
        edit().instances.touch(rid);
        return {};
    });
}

Status VisualServer::instance_set_use_in_baked_light(RID rid, bool on) {
    return edit().with_instance("instance_set_use_in_baked_light", rid, [&](Instance& instance) -> Status {
        instance.use_in_baked_light = on;
        return {};
    });
}

Status VisualServer::instance_set_extra_margin(RID rid, float margin_m) {
    return edit().with_instance("instance_set_extra_margin", rid, [&](Instance&) -> Status {
        if (!std::isfinite(margin_m)) {
            return edit().stale.refuse("instance_set_extra_margin: expected a finite number");
        }
        edit().instances.set_extra_margin(rid, margin_m);
        return {};
    });
}

} // namespace cl
