// The part of InstanceStorage that keeps pairs: see the rules at its class.
#include "servers/visual/instance_storage.h"

#include <algorithm>

namespace cl {
namespace {

BoxTree& tree_of(Scenario& scenario, InstanceKind kind) {
    switch (kind) {
    case InstanceKind::LocalLight:
        return scenario.local_lights;
    case InstanceKind::GIProbe:
        return scenario.gi_probes;
    default:
        break;
    }
    return scenario.meshes;
}

/// The list of a mesh that partners of this kind are in.
std::vector<RID>& partners_of(Instance& mesh, InstanceKind kind) {
    return kind == InstanceKind::GIProbe ? mesh.probes : mesh.lights;
}

} // namespace

Transform InstanceStorage::placement(const Instance& instance) noexcept {
    return instance.kind == InstanceKind::Mesh ? instance.world_from_local
                                               : instance.world_from_local.orthonormalized();
}

std::optional<AABB> InstanceStorage::world_bounds_of(const Instance& instance) const {
    switch (instance.kind) {
    case InstanceKind::Mesh: {
        const Mesh* mesh = storage_.meshes.get(instance.base);
        if (!mesh || mesh->surfaces.empty()) {
            return std::nullopt;
        }
        return transformed(placement(instance), mesh->bounds).grown(instance.extra_margin_m);
    }
    case InstanceKind::LocalLight: {
        const Light* light = storage_.lights.get(instance.base);
        return light ? std::optional(transformed(placement(instance), light_bounds(light->desc)))
                     : std::nullopt;
    }
    case InstanceKind::GIProbe: {
        const GIProbe* probe = storage_.gi_probes.get(instance.base);
        return probe && probe->has_data ? std::optional(transformed(placement(instance), probe->bounds))
                                        : std::nullopt;
    }
    case InstanceKind::Empty:
    case InstanceKind::DirectionalLight:
        break;
    }
    return std::nullopt;
}

void InstanceStorage::update_one(RID rid, Instance& instance) {
    instance.queued = false;
    Scenario* scenario = scenarios_.get(instance.scenario);
    const bool hidden_probe = instance.kind == InstanceKind::GIProbe && !instance.visible;
    const std::optional<AABB> bounds = hidden_probe ? std::nullopt : world_bounds_of(instance);
    if (!scenario || !bounds) {
        unpair(rid, instance);
        return;
    }
    BoxTree& tree = tree_of(*scenario, instance.kind);
    std::optional<AABB> old_bounds;
    if (instance.tree_entry) {
        old_bounds = instance.world_bounds;
        tree.move(*instance.tree_entry, *bounds);
    } else {
        instance.tree_entry = tree.insert(*bounds, rid);
        instance.pair_sequence = scenario->next_pair_sequence++;
    }
    instance.world_bounds = *bounds;
    if (instance.kind == InstanceKind::Mesh) {
        pair_mesh(instance, *scenario);
    } else {
        pair_partner(rid, instance, *scenario, old_bounds);
    }
}

/// Brings a mesh's lists in line with its new box; partners that stay keep their places.
void InstanceStorage::pair_mesh(Instance& mesh, Scenario& scenario) {
    for (InstanceKind kind : {InstanceKind::LocalLight, InstanceKind::GIProbe}) {
        std::vector<RID>& partners = partners_of(mesh, kind);
        std::vector<RID> found;
        tree_of(scenario, kind).overlapping(mesh.world_bounds, [&found](RID partner) {
            found.push_back(partner);
        });
        const auto lacks = [](const std::vector<RID>& list, RID rid) {
            return std::find(list.begin(), list.end(), rid) == list.end();
        };
        std::erase_if(partners, [&](RID partner) { return lacks(found, partner); });
        std::erase_if(found, [&](RID partner) { return !lacks(partners, partner); });
        std::sort(found.begin(), found.end(), [this](RID a, RID b) {
            return instances_.get(a)->pair_sequence < instances_.get(b)->pair_sequence;
        });
        partners.insert(partners.end(), found.begin(), found.end());
    }
}

/// Brings the meshes around a light or probe in line with its new box. No list of them is kept: they are
/// always just those that the tree finds in its box.
void InstanceStorage::pair_partner(RID rid, Instance& partner, Scenario& scenario,
                                   const std::optional<AABB>& old_bounds) {
    const AABB& bounds = partner.world_bounds;
    if (old_bounds) {
        scenario.meshes.overlapping(*old_bounds, [&](RID mesh_rid) {
            Instance& mesh = *instances_.get(mesh_rid);
            if (!BoxTree::touching(mesh.world_bounds, bounds)) {
                std::erase(partners_of(mesh, partner.kind), rid);
            }
        });
    }
    scenario.meshes.overlapping(bounds, [&](RID mesh_rid) {
        Instance& mesh = *instances_.get(mesh_rid);
        if (!old_bounds || !BoxTree::touching(mesh.world_bounds, *old_bounds)) {
            partners_of(mesh, partner.kind).push_back(rid);
        }
    });
}

void InstanceStorage::unpair(RID rid, Instance& instance) {
    Scenario* scenario = scenarios_.get(instance.scenario);
    if (!instance.tree_entry || !scenario) {
        return;
    }
    if (instance.kind == InstanceKind::Mesh) {
        instance.lights.clear();
        instance.probes.clear();
    } else {
        scenario->meshes.overlapping(instance.world_bounds, [&](RID mesh_rid) {
            std::erase(partners_of(*instances_.get(mesh_rid), instance.kind), rid);
        });
    }
    tree_of(*scenario, instance.kind).remove(*instance.tree_entry);
    instance.tree_entry.reset();
}

} // namespace cl
