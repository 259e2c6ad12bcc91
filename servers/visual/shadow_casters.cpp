#include "servers/visual/shadow_casters.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>

namespace cl {
namespace {

/// Spots of 90 degrees and more cannot cast (spec scene-classes section 9).
bool casts(const LightDesc& light) noexcept {
    return light.shadow && !(light.type == LightType::Spot && light.spot_angle_deg >= 90.0f);
}

} // namespace

MaterialStorage::Resolved surface_material(Storage& storage, const Instance& instance, const Mesh& mesh,
                                           int surface, FirstError& errors) {
    const size_t i = static_cast<size_t>(surface);
    const RID own = i < instance.surface_materials.size() ? instance.surface_materials[i] : RID{};
    return storage.materials.resolve_first(
        std::array{instance.material_override, own, mesh.surfaces[i].material}, errors);
}

void ShadowCasters::clear() {
    casters_.clear();
    keys_.clear();
    ranges_.clear();
    directional_.reset();
    directional_bounds_ = {};
}

void ShadowCasters::add_light(Scenario& scenario, Instance& light_instance, const Light& light,
                              LightItem& item, FirstError& errors) {
    Range range;
    if (casts(light.desc) && light.desc.type == LightType::Directional) {
        if (!directional_) {
            directional_ = collect(scenario, std::nullopt, errors);
            for (size_t i = directional_->begin; i < casters_.size(); ++i) {
                directional_bounds_ = i == directional_->begin
                                          ? casters_[i].world_bounds
                                          : directional_bounds_.merged(casters_[i].world_bounds);
            }
        }
        range = *directional_;
    } else if (casts(light.desc)) {
        range = collect(scenario, light_instance.world_bounds, errors);
    }
    ranges_.push_back(range);
    CasterMemory& memory = light_instance.casters;
    if (remember(range, std::max(light.version, light_instance.version), memory)) {
        memory.version = storage_.clock.tick();
    }
    item.casters_version = memory.version;
}

void ShadowCasters::finish(std::span<LightItem> lights) {
    CL_ASSERT(lights.size() == ranges_.size(), "a light's casters were not collected");
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].casters = std::span(casters_).subspan(ranges_[i].begin, ranges_[i].count);
    }
}

ShadowCasters::Range ShadowCasters::collect(Scenario& scenario, const std::optional<AABB>& box,
                                            FirstError& errors) {
    found_.clear();
    const auto add = [this](RID rid) { found_.push_back(rid); };
    if (box) {
        scenario.meshes.overlapping(*box, add);
    } else {
        scenario.meshes.all(add);
    }
    std::sort(found_.begin(), found_.end()); // the tree's own order changes when it is rebuilt
    const size_t begin = casters_.size();
    for (RID rid : found_) {
        add_instance(rid, *instances_.get(rid), errors);
    }
    return {begin, casters_.size() - begin};
}

void ShadowCasters::add_instance(RID rid, const Instance& instance, FirstError& errors) {
    const Mesh* mesh = storage_.meshes.get(instance.base);
    if (!mesh || !instance.visible || instance.casting == ShadowCasting::Off) {
        return;
    }
    for (int surface = 0; surface < static_cast<int>(mesh->surfaces.size()); ++surface) {
        const MaterialStorage::Resolved material =
            surface_material(storage_, instance, *mesh, surface, errors);
        const RID uploaded =
            material.desc->casts_shadow() ? storage_.meshes.uploaded(instance.base, errors) : RID{};
        if (!uploaded) {
            continue;
        }
        CasterItem item;
        item.mesh = uploaded;
        item.surface = surface;
        item.material = material.desc;
        item.world_from_local = instance.world_from_local;
        item.world_bounds = instance.world_bounds;
        item.mirrored = glm::determinant(instance.world_from_local.basis) < 0.0f;
        item.double_sided = instance.casting == ShadowCasting::DoubleSided;
        item.version = std::max({instance.version, mesh->version, material.version});
        casters_.push_back(item);
        keys_.push_back({rid, surface, item.version});
    }
}

bool ShadowCasters::remember(Range range, uint64_t light_version, CasterMemory& memory) const {
    const std::span<const CasterMemory::Key> keys = std::span(keys_).subspan(range.begin, range.count);
    if (memory.version != 0 && memory.light_version == light_version &&
        std::equal(keys.begin(), keys.end(), memory.keys.begin(), memory.keys.end())) {
        return false;
    }
    memory.keys.assign(keys.begin(), keys.end());
    memory.light_version = light_version;
    return true;
}

} // namespace cl
