#include "servers/visual/frame_builder.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace cl {
namespace {

/// Sorting needs an order, which NaN has not; only overflow at the ends of the world can make one.
float sortable(float depth_m) {
    return std::isnan(depth_m) ? 0.0f : depth_m;
}

/// How far in front of the camera a point is [m].
float view_depth_m(const Transform& world_from_camera, const glm::vec3& point) {
    return sortable(-glm::dot(world_from_camera.basis[2], point - world_from_camera.origin));
}

/// How far in front of the camera the nearest corner of a box is [m].
float nearest_view_depth_m(const Transform& world_from_camera, const AABB& box) {
    const float reach = glm::dot(glm::abs(world_from_camera.basis[2]), 0.5f * box.size);
    return sortable(view_depth_m(world_from_camera, box.center()) - reach);
}

GIProbeShading probe_shading(const Instance& instance, const GIProbe& probe) {
    GIProbeShading shading;
    const RID volume = instance.probe ? instance.probe->volume() : RID{};
    if (!volume) { // the null probe of spec gi-shading section 2
        shading.multiplier = 0.0f;
        shading.blend_ambient = false;
        return shading;
    }
    // The range that the texels were made with, which a relight that is under way will change.
    const int shown_range = instance.probe->shown_dynamic_range();
    shading.volume = volume;
    shading.cells_from_world = probe.cells_from_local * InstanceStorage::placement(instance).inverse();
    shading.bounds_cells = probe.bounds_cells;
    shading.size = probe.layout ? probe.layout->dims : glm::ivec3(0);
    shading.multiplier =
        static_cast<float>(shown_range > 0 ? shown_range : probe.dynamic_range) * probe.energy;
    shading.bias_cells = probe.bias_cells;
    shading.normal_bias_m = probe.normal_bias_m;
    shading.blend_ambient = !probe.interior;
    return shading;
}

} // namespace

FrameBuilder::FrameBuilder(Storage& storage, InstanceStorage& instances, const FieldDriver& fields)
    : storage_(storage), instances_(instances), fields_(fields), casters_(storage, instances) {}

const Frame& FrameBuilder::build(const View& view, const RenderSettings& settings, FirstError& errors) {
    clear(view, settings);
    Scenario* scenario = instances_.scenario(view.scenario);
    const CameraDesc* camera = storage_.cameras.get(view.camera);
    frame_.camera = camera ? *camera : CameraDesc{};
    resolve_environment(scenario, errors);
    if (scenario && camera && view.contents == FrameContents::WholeScene) {
        add_directional_lights(*scenario);
        add_world(*scenario, errors);
    } else if (scenario && camera) {
        add_directional_lights(*scenario);
        const glm::mat4 view_from_world = camera->world_from_camera.inverse().to_mat4();
        add_visible_instances(
            *scenario, frustum_from_clip(projection_matrix(*camera, view.size) * view_from_world), errors);
        sort_items();
        add_casters(*scenario, errors);
    }
    frame_.opaque = opaque_;
    frame_.transparent = transparent_;
    frame_.lights = lights_;
    frame_.gi_probes = probes_;
    frame_.world = world_;
    frame_.casters_bounds = casters_.directional_bounds();
    return frame_;
}

void FrameBuilder::clear(const View& view, const RenderSettings& settings) {
    ++frame_number_;
    items_.clear();
    keys_.clear();
    opaque_.clear();
    transparent_.clear();
    lights_.clear();
    probes_.clear();
    world_.clear();
    casters_.clear();
    frame_ = {};
    frame_.size = view.size;
    frame_.clear_color = settings.clear_color;
    frame_.gi_mode = settings.gi_mode;
    frame_.quality = settings.quality;
    frame_.shadow_filter = settings.shadow_filter;
    frame_.shadow_fit = settings.gi_mode == GIMode::Auto ? ShadowFit::ByTexel : ShadowFit::AsSet;
    frame_.shadow_atlas_size = settings.shadow_atlas_size;
    frame_.directional_shadow_size = settings.directional_shadow_size;
}

/// The camera's environment, else the scenario's, else none (spec scene-classes section 13).
void FrameBuilder::resolve_environment(const Scenario* scenario, FirstError& errors) {
    const EnvironmentDesc* environment = storage_.environments.get(frame_.camera.environment);
    if (!environment && scenario) {
        environment = storage_.environments.get(scenario->environment);
    }
    frame_.camera.environment = {}; // the server's own RIDs mean nothing to a rasteriser
    frame_.has_environment = environment != nullptr;
    if (environment) {
        frame_.environment = *environment;
        frame_.environment.sky = storage_.skies.uploaded(environment->sky, errors);
    }
}

void FrameBuilder::add_directional_lights(const Scenario& scenario) {
    for (RID rid : scenario.directional_lights) {
        if (lights_.size() < static_cast<size_t>(kMaxDirectionalLights) && instances_.get(rid)->visible) {
            light_index(rid);
        }
    }
    frame_.directional_count = static_cast<int>(lights_.size());
}

void FrameBuilder::add_visible_instances(const Scenario& scenario, const Frustum& frustum,
                                         FirstError& errors) {
    seen_.clear();
    scenario.meshes.seen_by(frustum, [this](RID rid) { seen_.push_back(rid); });
    std::sort(seen_.begin(), seen_.end());
    for (RID rid : seen_) {
        Instance& instance = *instances_.get(rid);
        if (instance.visible && instance.casting != ShadowCasting::ShadowsOnly &&
            (instance.layers & frame_.camera.cull_mask) != 0) {
            add_instance(rid, instance, errors);
        }
    }
}

void FrameBuilder::add_instance(RID rid, Instance& instance, FirstError& errors) {
    const Mesh* mesh = storage_.meshes.get(instance.base);
    const RID uploaded = storage_.meshes.uploaded(instance.base, errors);
    if (!mesh || !uploaded) {
        return;
    }
    DrawItem item;
    item.mesh = uploaded;
    item.world_from_local = instance.world_from_local;
    item.mirrored = glm::determinant(instance.world_from_local.basis) < 0.0f;
    item.receives_baked_light = instance.use_in_baked_light;
    item.view_depth_m = view_depth_m(frame_.camera.world_from_camera, instance.world_from_local.origin);
    choose_lights(instance, item);
    choose_probes(instance, item);
    const float nearest_m = nearest_view_depth_m(frame_.camera.world_from_camera, instance.world_bounds);
    const uint64_t look = instance.still_version != 0 ? look_of(storage_, instance) : 0;
    for (int surface = 0; surface < static_cast<int>(mesh->surfaces.size()); ++surface) {
        const MaterialStorage::Resolved material =
            surface_material(storage_, instance, *mesh, surface, errors);
        item.surface = surface;
        item.material = material.desc;
        item.is_still =
            instance.still_version != 0 && instance.still_version == look && is_solid(*material.desc);
        items_.push_back(item);
        keys_.push_back({nearest_m, rid, material.rid});
    }
}

/// The first 8 omni and 8 spot lights in pair order (spec scene-classes section 8), of those that light it at
/// all.
void FrameBuilder::choose_lights(const Instance& instance, DrawItem& item) {
    item.directional_mask = 0;
    for (int i = 0; i < frame_.directional_count; ++i) {
        if ((lights_[static_cast<size_t>(i)].desc->cull_mask & instance.layers) != 0) {
            item.directional_mask = static_cast<uint16_t>(item.directional_mask | (1u << i));
        }
    }
    for (RID rid : instance.lights) {
        const Instance& light_instance = *instances_.get(rid);
        const Light* light = storage_.lights.get(light_instance.base);
        if (!light || !light_instance.visible || (light->desc.cull_mask & instance.layers) == 0) {
            continue;
        }
        const bool omni = light->desc.type == LightType::Omni;
        uint16_t& count = omni ? item.omni_count : item.spot_count;
        auto& chosen = omni ? item.omnis : item.spots;
        const int index = count < chosen.size() ? light_index(rid) : -1;
        if (index >= 0) {
            chosen[count++] = static_cast<uint16_t>(index);
        }
    }
}

/// The first two probes in pair order (spec gi-shading section 1), set up or not.
void FrameBuilder::choose_probes(const Instance& instance, DrawItem& item) {
    if (frame_.gi_mode == GIMode::Off) {
        return;
    }
    for (size_t i = 0; i < std::min(instance.probes.size(), item.gi_probes.size()); ++i) {
        item.gi_probes[i] = static_cast<int16_t>(probe_index(instance.probes[i]));
    }
}

/// Index of a light in the frame, added now if need be; -1 if the frame is full.
int FrameBuilder::light_index(RID rid) {
    Instance& instance = *instances_.get(rid);
    if (instance.frame == frame_number_) {
        return instance.frame_index;
    }
    const Light* light = storage_.lights.get(instance.base);
    if (!light || lights_.size() >= std::numeric_limits<uint16_t>::max()) {
        return -1;
    }
    LightItem item;
    item.key = rid;
    item.desc = &light->desc;
    item.world_from_light = InstanceStorage::placement(instance);
    instance.frame = frame_number_;
    instance.frame_index = static_cast<int>(lights_.size());
    lights_.push_back(item);
    return instance.frame_index;
}

/// Index of a probe in the frame, added now if need be; -1 if the frame is full.
int FrameBuilder::probe_index(RID rid) {
    Instance& instance = *instances_.get(rid);
    if (instance.frame == frame_number_) {
        return instance.frame_index;
    }
    const GIProbe* probe = storage_.gi_probes.get(instance.base);
    if (!probe || probes_.size() >= static_cast<size_t>(std::numeric_limits<int16_t>::max())) {
        return -1;
    }
    instance.frame = frame_number_;
    instance.frame_index = static_cast<int>(probes_.size());
    GIProbeShading shading = probe_shading(instance, *probe);
    if (frame_.gi_mode == GIMode::Auto) {
        fields_.describe(rid, instance, shading);
        shading.multiplier = probe->energy;
    }
    probes_.push_back(shading);
    return instance.frame_index;
}

void FrameBuilder::add_casters(Scenario& scenario, FirstError& errors) {
    for (LightItem& item : lights_) {
        Instance& instance = *instances_.get(item.key);
        casters_.add_light(scenario, instance, *storage_.lights.get(instance.base), item, errors);
    }
    casters_.finish(lights_);
}

/// Opaque items front to back in steps of a quarter octave, by material and mesh within a step: hidden
/// fragments cost more than state changes do. Transparent ones by priority, then back to front.
void FrameBuilder::sort_items() {
    std::vector<size_t> opaque, transparent;
    for (size_t i = 0; i < items_.size(); ++i) {
        (items_[i].material->is_transparent() ? transparent : opaque).push_back(i);
    }
    const auto step = [this](size_t i) {
        return std::floor(4.0f * std::log2(1.0f + std::max(keys_[i].nearest_depth_m, 0.0f)));
    };
    // Items stand in order of instance and surface, which a stable sort keeps where nothing else decides.
    std::stable_sort(opaque.begin(), opaque.end(), [&](size_t a, size_t b) {
        const float step_a = step(a), step_b = step(b);
        return step_a != step_b ? step_a < step_b
                                : std::tie(keys_[a].material, items_[a].mesh) <
                                      std::tie(keys_[b].material, items_[b].mesh);
    });
    std::stable_sort(transparent.begin(), transparent.end(), [this](size_t a, size_t b) {
        const int first = items_[a].material->render_priority, second = items_[b].material->render_priority;
        return first != second ? first < second : items_[a].view_depth_m > items_[b].view_depth_m;
    });
    for (size_t i : opaque) {
        opaque_.push_back(items_[i]);
    }
    for (size_t i : transparent) {
        transparent_.push_back(items_[i]);
    }
}

} // namespace cl
