#include "servers/visual/probe_driver.h"

#include "servers/visual/finite.h"
#include "servers/visual/first_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cl {

ProbeDriver::ProbeDriver(Storage& storage, InstanceStorage& instances, Rasterizer& rasterizer,
                         WorkerQueue& worker)
    : storage_(storage), instances_(instances), rasterizer_(rasterizer),
      run_([&worker](std::function<void()> job) { worker.push(std::move(job)); }) {}

Status ProbeDriver::step() {
    FirstError errors;
    const bool was_at_rest = !any_in_flight();
    const double relight_before = total_relight_ms_, upload_before = total_upload_ms_;
    for (RID rid : instances_.probes()) {
        const Instance& instance = *instances_.get(rid);
        ProbeMachine& machine = *instance.probe;
        const uint64_t uploads_before = machine.uploads();
        const double work_before_ms = machine.total_work_ms(), upload_before_ms = machine.total_upload_ms();
        errors.note(machine.step(wanted(instance), rasterizer_, run_));
        const double uploaded = machine.total_upload_ms() - upload_before_ms;
        total_upload_ms_ += uploaded;
        uploads_ += machine.uploads() - uploads_before;
        total_relight_ms_ += machine.total_work_ms() - work_before_ms + uploaded;
    }
    if (was_at_rest && any_in_flight()) {
        round_start_relight_ms_ = relight_before;
        round_start_upload_ms_ = upload_before;
    }
    return errors.status();
}

bool ProbeDriver::is_settled() {
    const std::vector<RID>& probes = instances_.probes();
    return std::none_of(probes.begin(), probes.end(), [this](RID rid) {
        const Instance& instance = *instances_.get(rid);
        return instance.probe->is_pending(wanted(instance));
    });
}

bool ProbeDriver::any_in_flight() {
    const std::vector<RID>& probes = instances_.probes();
    return std::any_of(probes.begin(), probes.end(), [this](RID rid) {
        const ProbeStage stage = instances_.get(rid)->probe->stage();
        return stage == ProbeStage::Lighting || stage == ProbeStage::Uploading;
    });
}

ProbeWanted ProbeDriver::wanted(const Instance& instance) {
    lights_.clear();
    const GIProbe* probe = storage_.gi_probes.get(instance.base);
    if (!probe) {
        return {};
    }
    gather_lights(instance, *probe);
    return {.layout = probe->layout,
            .coding = probe->coding,
            .data_version = probe->data_version,
            .propagation = probe->propagation,
            .dynamic_range = probe->dynamic_range,
            .lights = lights_};
}

/// All directional lights of the scenario, and local ones whose box overlaps or touches the probe's (spec
/// gi-update section 4). Departs: a hidden probe keeps its local lights, so that it is right on the first
/// frame it is shown.
void ProbeDriver::gather_lights(const Instance& instance, const GIProbe& probe) {
    Scenario* scenario = instances_.scenario(instance.scenario);
    const std::optional<AABB> bounds = instances_.world_bounds_of(instance);
    const Transform cells_from_world =
        probe.cells_from_local * InstanceStorage::placement(instance).inverse();
    if (!scenario || !bounds || !is_finite(cells_from_world)) {
        return;
    }
    for (RID light : scenario->directional_lights) {
        add_light(light, cells_from_world);
    }
    scenario->local_lights.overlapping(*bounds, [&](RID light) { add_light(light, cells_from_world); });
    std::sort(lights_.begin(), lights_.end(),
              [](const ProbeLight& a, const ProbeLight& b) { return a.key < b.key; });
}

void ProbeDriver::add_light(RID rid, const Transform& cells_from_world) {
    const Instance& instance = *instances_.get(rid);
    const Light* light = storage_.lights.get(instance.base);
    if (!light) {
        return;
    }
    ProbeLight candidate = make_probe_light(rid, light->desc, instance.visible,
                                            InstanceStorage::placement(instance), cells_from_world);
    // Finite factors may still have a product that is not.
    if (is_finite(candidate.light.cells_from_light) && std::isfinite(candidate.light.energy)) {
        lights_.push_back(candidate);
    }
}

} // namespace cl
