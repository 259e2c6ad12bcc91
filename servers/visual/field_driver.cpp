#include "servers/visual/field_driver.h"

#include "servers/visual/field_lighting.h"

#include "core/io/log.h"
#include "core/stopwatch.h"

#include <algorithm>
#include <utility>

namespace cl {
FieldDriver::FieldDriver(Storage& storage, InstanceStorage& instances, Rasterizer& rasterizer,
                         WorkerQueue& worker)
    : storage_(storage), instances_(instances), rasterizer_(rasterizer), worker_(worker) {}

FieldDriver::~FieldDriver() {
    for (auto& [scenario, field] : fields_) {
        drop(field);
    }
}

void FieldDriver::drop(Field& field) {
    if (field.job) {
        field.job->stop = true;
    }
    if (field.upload) {
        static_cast<void>(rasterizer_.free(field.upload)); // a backend that lost it has nothing left to free
    }
    for (RID volume : field.volumes) {
        static_cast<void>(rasterizer_.free(volume));
    }
    field.volumes.clear();
    for (const FieldGeometry::Item& item : field.geometry.items) {
        if (Instance* instance = instances_.get(item.instance)) {
            instance->still_version = 0;
        }
    }
}

void FieldDriver::mark_still(const Field& field) {
    for (const FieldGeometry::Item& item : field.geometry.items) {
        if (Instance* instance = instances_.get(item.instance)) {
            instance->still_version = item.look;
        }
    }
}

bool FieldDriver::is_starting() const {
    return std::any_of(fields_.begin(), fields_.end(),
                       [](const auto& known) { return known.second.job && !known.second.upload; });
}

std::vector<RID> FieldDriver::scenarios_with_probes() const {
    std::vector<RID> found;
    for (RID rid : instances_.probes()) {
        const Instance& instance = *instances_.get(rid);
        const GIProbe* probe = storage_.gi_probes.get(instance.base);
        const bool counts = probe && probe->has_data && instance.visible && probe->bounds.size.x > 0.0f;
        if (counts && std::find(found.begin(), found.end(), instance.scenario) == found.end()) {
            found.push_back(instance.scenario);
        }
    }
    return found;
}

bool FieldDriver::rests(RID rid, uint64_t look, Rest rest) {
    const auto [known, is_new] = seen_.try_emplace(rid, Restless{look, 0});
    if (!is_new && known->second.look != look) {
        known->second = {look, step_};
    }
    return rest == Rest::AtOnce || known->second.changed_at == 0 ||
           step_ >= known->second.changed_at + kRestSteps;
}

FieldGeometry FieldDriver::wanted_geometry(RID scenario, Rest rest) {
    FieldGeometry geometry;
    geometry.quality = quality_;
    for (RID rid : instances_.probes()) {
        const Instance& instance = *instances_.get(rid);
        const GIProbe* probe = storage_.gi_probes.get(instance.base);
        if (instance.scenario == scenario && probe && probe->has_data && instance.visible &&
            probe->bounds.size.x > 0.0f) {
            geometry.probes.push_back({rid, InstanceStorage::placement(instance), probe->bounds});
        }
    }
    instances_.for_each([&](RID rid, const Instance& instance) {
        if (instance.kind != InstanceKind::Mesh || instance.scenario != scenario || !instance.visible ||
            !instance.use_in_baked_light || instance.casting == ShadowCasting::ShadowsOnly) {
            return;
        }
        const uint64_t look = look_of(storage_, instance);
        if (rests(rid, look, rest)) {
            geometry.items.push_back({rid, look});
        }
    });
    return geometry;
}

radiosity::Lighting FieldDriver::wanted_lighting(RID scenario, const FieldGeometry& geometry) const {
    radiosity::Lighting lighting = lighting_of(storage_, instances_, scenario);
    for (const FieldGeometry::Probe& key : geometry.probes) {
        const GIProbe* probe = storage_.gi_probes.get(instances_.get(key.instance)->base);
        lighting.interior.push_back(probe && probe->interior);
    }
    return lighting;
}

Status FieldDriver::step(Rest rest) {
    ++step_;
    FirstError errors;
    const std::vector<RID> scenarios = scenarios_with_probes();
    for (auto at = fields_.begin(); at != fields_.end();) {
        const bool lives = std::find(scenarios.begin(), scenarios.end(), at->first) != scenarios.end();
        if (!lives) {
            drop(at->second);
        }
        at = lives ? std::next(at) : fields_.erase(at);
    }
    errors.note(take_in());
    for (RID scenario : scenarios) {
        Field& field = fields_[scenario];
        if (field.job) {
            continue; // a change that comes meanwhile is found by comparison when it is done
        }
        FieldGeometry geometry = wanted_geometry(scenario, rest);
        radiosity::Lighting lighting = wanted_lighting(scenario, geometry);
        field.steady.mark(lighting, step_, rest);
        const FieldReaders readers = wanted_readers(scenario, geometry);
        if (!field.parts.transport || geometry != field.geometry || lighting != field.lighting ||
            !field.readers.include(readers)) {
            start(field, std::move(geometry), std::move(lighting), readers, rest);
        }
    }
    return errors.status();
}

Status FieldDriver::take_in() {
    FirstError errors;
    for (auto& [scenario, field] : fields_) {
        if (field.job && field.job->done) {
            errors.note(take_in(field));
        }
    }
    return errors.status();
}

bool FieldDriver::is_relighting() const {
    return std::any_of(fields_.begin(), fields_.end(),
                       [](const auto& field) { return field.second.job && !field.second.job->is_new; });
}

void FieldDriver::start(Field& field, FieldGeometry geometry, radiosity::Lighting lighting,
                        const FieldReaders& readers, Rest rest) {
    auto job = std::make_shared<FieldJob>();
    job->readers = readers;
    job->is_new = !field.parts.transport || geometry != field.geometry;
    if (job->is_new) {
        for (const FieldGeometry::Item& item : geometry.items) {
            job->items.push_back(describe_still(storage_, item.instance, *instances_.get(item.instance)));
        }
        log_debug("GI field: light transport of " + std::to_string(job->items.size()) + " still instances");
    } else {
        job->parts = field.parts;
        if (field.readers.air < readers.air) {
            job->parts.air = nullptr; // what is shown meanwhile is coarse, but nobody waits
        } else {
            job->readers.air = field.readers.air; // kept: things that come and go cost no more than that
        }
    }
    if (!field.upload) {
        // No light is there to be read from surfaces or the air; but which of the two it will be decides
        // about shaders, which may be compiled meanwhile.
        field.geometry = geometry;
        mark_still(field);
    }
    job->geometry = std::move(geometry);
    job->lighting = std::move(lighting);
    field.job = job;
    // Frames that are drawn meanwhile should take as long as any.
    const bool draws_meanwhile = rest == Rest::AfterSteps && field.upload && job->is_new;
    worker_.push([job, draws_meanwhile] {
        if (draws_meanwhile) {
            leave_one_core([&job] { job->run(); });
        } else {
            job->run();
        }
    });
}

Status FieldDriver::take_in(Field& field) {
    const std::shared_ptr<FieldJob> job = std::exchange(field.job, nullptr);
    ++uploads_;
    const Stopwatch uploading;
    FirstError errors;
    if (!job->error.empty()) {
        errors.note(Error{ErrorCode::Unsupported, job->error, {}});
    }
    if (job->is_new) {
        drop(field);
        field.upload = {};
        field.geometry = job->geometry;
        bake_ms_ = job->bake_ms;
    }
    field.parts = job->parts;
    field.lighting = job->lighting;
    field.readers = job->readers;
    if (!field.parts.map) {
        return errors.status();
    }
    if (job->is_new) {
        const radiosity::FieldMap& map = *field.parts.map;
        const Expected<RID> made = rasterizer_.gi_field_create(
            {.brick_words = map.brick_words, .joints = map.joints, .air = map.air});
        if (!made) {
            return made.error();
        }
        field.upload = *made;
        mark_still(field);
    }
    errors.note(rasterizer_.gi_field_upload(field.upload, job->light, job->air));
    errors.note(upload_volumes(field, *job));
    upload_ms_ = uploading.elapsed_ms();
    relight_ms_ = job->solve_ms + upload_ms_;
    log_debug("GI field: " + std::to_string(field.parts.transport->patches.size()) + " patches, " +
              std::to_string(field.parts.transport->records.patch.size()) + " records, " +
              std::to_string(job->bounces) + " bounces, " + std::to_string(relight_ms_) + " ms");
    return errors.status();
}

Status FieldDriver::upload_volumes(Field& field, const FieldJob& job) {
    field.ranges.clear();
    for (size_t i = 0; i < job.volumes.size(); ++i) {
        const std::vector<radiosity::RadianceVolume::Level>& levels = job.volumes[i].levels;
        if (i == field.volumes.size()) {
            const Expected<RID> made = rasterizer_.gi_volume_create(
                {.size = levels[0].size, .mip_count = int(levels.size()), .use = GIVolumeUse::Reflections});
            if (!made) {
                return made.error();
            }
            field.volumes.push_back(*made);
        }
        for (size_t mip = 0; mip < levels.size(); ++mip) {
            if (Status s = rasterizer_.gi_volume_upload(field.volumes[i], int(mip), glm::ivec3(0),
                                                        levels[mip].size, levels[mip].rgba8);
                !s) {
                return s;
            }
        }
        field.ranges.push_back(job.volumes[i].range);
    }
    return {};
}

/// What anything that may be drawn reads: nothing is made that nobody looks at.
FieldReaders FieldDriver::wanted_readers(RID scenario, const FieldGeometry& geometry) {
    FieldReaders readers;
    auto still = geometry.items.begin(); // in the order of the instances
    instances_.for_each([&](RID rid, const Instance& instance) {
        if (instance.kind != InstanceKind::Mesh || instance.scenario != scenario || !instance.visible) {
            return;
        }
        const bool is_still = still != geometry.items.end() && still->instance == rid;
        still += is_still ? 1 : 0;
        readers.glossy = readers.glossy || is_glossy(storage_, instance);
        if (readers.air == radiosity::AirUse::Gaps && reads_air(storage_, instance, is_still)) {
            readers.air = radiosity::AirUse::Things;
        }
    });
    return readers;
}

bool FieldDriver::is_settled() {
    const std::vector<RID> scenarios = scenarios_with_probes();
    return std::all_of(scenarios.begin(), scenarios.end(), [this](RID scenario) {
        const auto found = fields_.find(scenario);
        if (found == fields_.end() || found->second.job) {
            return false;
        }
        const FieldGeometry geometry = wanted_geometry(scenario, Rest::AtOnce);
        return geometry == found->second.geometry &&
               found->second.readers.include(wanted_readers(scenario, geometry)) &&
               wanted_lighting(scenario, geometry) == found->second.lighting;
    });
}

void FieldDriver::describe(RID rid, const Instance& instance, GIProbeShading& shading) const {
    shading.volume = {};
    const auto found = fields_.find(instance.scenario);
    if (found == fields_.end() || !found->second.upload) {
        return;
    }
    const Field& field = found->second;
    for (size_t i = 0; i < field.geometry.probes.size(); ++i) {
        if (field.geometry.probes[i].instance == rid) {
            const radiosity::CellGrid& cells = field.parts.transport->patches.grids[i].cells;
            shading.field = field.upload;
            shading.field_cells_from_world = cells.cells_from_world;
            shading.field_cells = glm::vec3(cells.dims);
            shading.field_bricks = field.parts.map->probes[i].bricks;
            shading.field_first_brick = int(field.parts.map->probes[i].first_brick);
            shading.field_air_at = field.parts.map->probes[i].air_at;
            if (i < field.ranges.size()) {
                shading.volume = field.volumes[i];
                shading.size = radiosity::radiance_volume_size(cells);
                shading.field_range = field.ranges[i];
            }
        }
    }
}

} // namespace cl
