#include "servers/visual/instance_storage.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cl {

InstanceStorage::InstanceStorage(Storage& storage, Rasterizer& rasterizer)
    : storage_(storage), rasterizer_(rasterizer) {}

InstanceStorage::~InstanceStorage() {
    instances_.for_each([this](RID rid, Instance& instance) { leave(rid, instance); });
}

bool InstanceStorage::free_scenario(RID rid) {
    if (!scenarios_.owns(rid)) {
        return false;
    }
    instances_.for_each([this, rid](RID instance_rid, Instance& instance) {
        if (instance.scenario == rid) {
            set_scenario(instance_rid, {});
        }
    });
    return scenarios_.free(rid);
}

bool InstanceStorage::free(RID rid) {
    if (!instances_.owns(rid)) {
        return false;
    }
    set_base(rid, {});
    return instances_.free(rid);
}

void InstanceStorage::set_base(RID rid, RID base) {
    Instance& instance = *instances_.get(rid);
    leave(rid, instance);
    if (const auto users = instances_of_base_.find(instance.base); users != instances_of_base_.end()) {
        std::erase(users->second, rid);
        if (users->second.empty()) {
            instances_of_base_.erase(users);
        }
    }
    instance.base = base;
    instance.kind = kind_of(base);
    instance.surface_materials.clear();
    instance.version = storage_.clock.tick();
    if (base) {
        instances_of_base_[base].push_back(rid);
    }
    enter(rid, instance);
}

void InstanceStorage::set_scenario(RID rid, RID scenario) {
    Instance& instance = *instances_.get(rid);
    if (instance.scenario == scenario) {
        return;
    }
    leave(rid, instance);
    instance.scenario = scenario;
    enter(rid, instance);
}

void InstanceStorage::set_transform(RID rid, const Transform& world_from_local) {
    Instance& instance = *instances_.get(rid);
    if (instance.world_from_local == world_from_local) {
        return;
    }
    instance.world_from_local = world_from_local;
    instance.version = storage_.clock.tick();
    queue(rid, instance);
}

void InstanceStorage::set_visible(RID rid, bool visible) {
    Instance& instance = *instances_.get(rid);
    if (instance.visible == visible) {
        return;
    }
    instance.visible = visible;
    if (instance.kind == InstanceKind::GIProbe) {
        unpair(rid, instance); // at once: hidden and shown again, it goes to the end of every list
        queue(rid, instance);
    }
}

void InstanceStorage::set_extra_margin(RID rid, float margin_m) {
    Instance& instance = *instances_.get(rid);
    instance.extra_margin_m = margin_m;
    queue(rid, instance);
}

void InstanceStorage::base_changed(RID base) {
    const auto users = instances_of_base_.find(base);
    if (users == instances_of_base_.end()) {
        return;
    }
    const InstanceKind kind = kind_of(base);
    for (RID rid : users->second) {
        Instance& instance = *instances_.get(rid);
        if (instance.kind == kind) {
            queue(rid, instance);
            continue;
        }
        leave(rid, instance); // a directional light became a local one, or the other way round
        instance.kind = kind;
        enter(rid, instance);
    }
}

void InstanceStorage::probe_data_changed(RID probe) {
    const auto users = instances_of_base_.find(probe);
    if (users == instances_of_base_.end()) {
        return;
    }
    for (RID rid : users->second) {
        Instance& instance = *instances_.get(rid);
        unpair(rid, instance);
        queue(rid, instance);
    }
}

void InstanceStorage::base_freed(RID base) {
    const auto users = instances_of_base_.find(base);
    if (users == instances_of_base_.end()) {
        return;
    }
    const std::vector<RID> emptied = users->second; // set_base() edits the list itself
    for (RID rid : emptied) {
        set_base(rid, {});
    }
}

void InstanceStorage::update() {
    while (!queued_.empty()) {
        const RID rid = queued_.back();
        queued_.pop_back();
        Instance* instance = instances_.get(rid);
        if (instance && instance->queued) {
            update_one(rid, *instance);
        }
    }
}

InstanceKind InstanceStorage::kind_of(RID base) const noexcept {
    if (storage_.meshes.get(base)) {
        return InstanceKind::Mesh;
    }
    if (const Light* light = storage_.lights.get(base)) {
        return light->desc.type == LightType::Directional ? InstanceKind::DirectionalLight
                                                          : InstanceKind::LocalLight;
    }
    return storage_.gi_probes.owns(base) ? InstanceKind::GIProbe : InstanceKind::Empty;
}

void InstanceStorage::queue(RID rid, Instance& instance) {
    if (!instance.queued && instance.scenario && instance.kind != InstanceKind::Empty) {
        instance.queued = true;
        queued_.push_back(rid);
    }
}

/// Takes its place in its scenario, where both base and scenario are set.
void InstanceStorage::enter(RID rid, Instance& instance) {
    Scenario* scenario = scenarios_.get(instance.scenario);
    if (!scenario) {
        return;
    }
    if (instance.kind == InstanceKind::DirectionalLight) {
        scenario->directional_lights.push_back(rid);
    } else if (instance.kind == InstanceKind::GIProbe) {
        instance.probe = std::make_unique<ProbeMachine>(fmt::format("GI probe {}", rid.slot & 0xFFFFFFu));
        probes_.push_back(rid);
    }
    queue(rid, instance);
}

void InstanceStorage::leave(RID rid, Instance& instance) {
    unpair(rid, instance);
    instance.queued = false; // its entry in queued_, if any, is skipped
    if (Scenario* scenario = scenarios_.get(instance.scenario)) {
        std::erase(scenario->directional_lights, rid);
    }
    if (instance.probe) {
        instance.probe->release(rasterizer_);
        instance.probe.reset();
        std::erase(probes_, rid);
    }
}

} // namespace cl
