#include "servers/visual/field_driver.h"

#include "servers/visual/field_lighting.h"

#include "core/io/log.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace cl {
namespace {

class Timer {
public:
    [[nodiscard]] double elapsed_ms() const {
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin_;
        return took.count();
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace

struct FieldDriver::Job {
    // Given.
    Geometry geometry;
    radiosity::Lighting lighting;
    std::vector<StillItem> items; ///< of a new transport; else empty
    std::shared_ptr<const radiosity::Transport> transport;
    std::shared_ptr<const radiosity::FieldMap> map;
    std::shared_ptr<radiosity::DirectCache> direct = std::make_shared<radiosity::DirectCache>();
    bool is_new = false; ///< transport and map are to be made
    bool glossy = false; ///< volumes are to be made
    // Made.
    std::vector<uint32_t> light;
    std::vector<uint16_t> air;
    std::vector<radiosity::RadianceVolume> volumes;
    std::string error;
    int bounces = 0;
    double bake_ms = 0.0, solve_ms = 0.0;
    std::atomic<bool> done{false};
    std::atomic<bool> stop{false}; ///< not wanted any more

    void run() {
        const Timer bake;
        if (is_new && !make_transport()) {
            done = true;
            return;
        }
        bake_ms = is_new ? bake.elapsed_ms() : 0.0;
        const Timer solving;
        const radiosity::Solution solution = radiosity::solve(*transport, lighting, stop, direct.get());
        if (!stop) {
            bounces = solution.bounces;
            light = radiosity::encode_field(*map, solution);
            air = radiosity::encode_air(*transport, *map, solution);
            for (size_t i = 0; glossy && i < transport->probe_count; ++i) {
                volumes.push_back(radiosity::make_radiance_volume(*transport, i, solution));
            }
        }
        solve_ms = solving.elapsed_ms();
        done = true;
    }

    bool make_transport() {
        auto scene = std::make_shared<const radiosity::StillScene>(make_still_scene(items));
        items.clear();
        std::vector<radiosity::ProbeBox> boxes;
        for (const ProbeKey& p : geometry.probes) {
            boxes.push_back({p.world_from_probe, p.box, geometry.quality == Quality::High ? 128 : 64});
        }
        auto made = radiosity::make_transport(scene, boxes, stop);
        if (!made) {
            error = made.error().message;
            return false;
        }
        transport = *made;
        map = std::make_shared<const radiosity::FieldMap>(radiosity::make_field_map(*transport));
        return true;
    }
};

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
    for (const ItemKey& item : field.geometry.items) {
        if (Instance* instance = instances_.get(item.instance)) {
            instance->still_version = 0;
        }
    }
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

FieldDriver::Geometry FieldDriver::wanted_geometry(RID scenario, Rest rest) {
    Geometry geometry;
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

radiosity::Lighting FieldDriver::wanted_lighting(RID scenario, const Geometry& geometry) const {
    radiosity::Lighting lighting = lighting_of(storage_, instances_, scenario);
    for (const ProbeKey& key : geometry.probes) {
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
    for (RID scenario : scenarios) {
        Field& field = fields_[scenario];
        if (field.job && field.job->done) {
            errors.note(take_in(field));
        }
        if (field.job) {
            continue; // a change that comes meanwhile is found by comparison when it is done
        }
        Geometry geometry = wanted_geometry(scenario, rest);
        radiosity::Lighting lighting = wanted_lighting(scenario, geometry);
        const bool glossy = has_gloss(scenario);
        if (!field.transport || geometry != field.geometry || lighting != field.lighting ||
            glossy != field.glossy) {
            start(field, std::move(geometry), std::move(lighting), glossy);
        }
    }
    return errors.status();
}

void FieldDriver::start(Field& field, Geometry geometry, radiosity::Lighting lighting, bool glossy) {
    auto job = std::make_shared<Job>();
    job->glossy = glossy;
    job->is_new = !field.transport || geometry != field.geometry;
    if (job->is_new) {
        for (const ItemKey& item : geometry.items) {
            job->items.push_back(describe_still(storage_, item.instance, *instances_.get(item.instance)));
        }
        log_debug("GI field: light transport of " + std::to_string(job->items.size()) + " still instances");
    } else {
        job->transport = field.transport;
        job->map = field.map;
        job->direct = field.direct;
    }
    job->geometry = std::move(geometry);
    job->lighting = std::move(lighting);
    field.job = job;
    worker_.push([job] { job->run(); });
}

Status FieldDriver::take_in(Field& field) {
    const std::shared_ptr<Job> job = std::exchange(field.job, nullptr);
    const Timer uploading;
    FirstError errors;
    if (!job->error.empty()) {
        errors.note(Error{ErrorCode::Unsupported, job->error, {}});
    }
    if (job->is_new) {
        drop(field);
        field.upload = {};
        field.transport = job->transport;
        field.map = job->map;
        field.direct = job->direct;
        field.geometry = job->geometry;
        bake_ms_ = job->bake_ms;
    }
    field.lighting = job->lighting;
    field.glossy = job->glossy;
    if (!field.map) {
        return errors.status();
    }
    if (job->is_new) {
        const Expected<RID> made = rasterizer_.gi_field_create(
            {.brick_words = field.map->brick_words, .joints = field.map->joints, .air = field.map->air});
        if (!made) {
            return made.error();
        }
        field.upload = *made;
        for (const ItemKey& item : field.geometry.items) {
            if (Instance* instance = instances_.get(item.instance)) {
                instance->still_version = item.look;
            }
        }
    }
    errors.note(rasterizer_.gi_field_upload(field.upload, job->light, job->air));
    errors.note(upload_volumes(field, *job));
    upload_ms_ = uploading.elapsed_ms();
    relight_ms_ = job->solve_ms + upload_ms_;
    log_debug("GI field: " + std::to_string(field.transport->patches.size()) + " patches, " +
              std::to_string(field.transport->records.patch.size()) + " records, " +
              std::to_string(job->bounces) + " bounces, " + std::to_string(relight_ms_) + " ms");
    return errors.status();
}

Status FieldDriver::upload_volumes(Field& field, const Job& job) {
    field.ranges.clear();
    for (size_t i = 0; i < job.volumes.size(); ++i) {
        const std::vector<radiosity::RadianceVolume::Level>& levels = job.volumes[i].levels;
        if (i == field.volumes.size()) {
            const Expected<RID> made =
                rasterizer_.gi_volume_create({.size = levels[0].size, .mip_count = int(levels.size())});
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

/// True if anything that may be drawn reflects more than a haze: else nobody looks at the volumes.
bool FieldDriver::has_gloss(RID scenario) {
    bool found = false;
    instances_.for_each([&](RID, const Instance& instance) {
        if (!found && instance.kind == InstanceKind::Mesh && instance.scenario == scenario &&
            instance.visible) {
            found = is_glossy(storage_, instance);
        }
    });
    return found;
}

bool FieldDriver::is_settled() {
    const std::vector<RID> scenarios = scenarios_with_probes();
    return std::all_of(scenarios.begin(), scenarios.end(), [this](RID scenario) {
        const auto found = fields_.find(scenario);
        if (found == fields_.end() || found->second.job) {
            return false;
        }
        const Geometry geometry = wanted_geometry(scenario, Rest::AtOnce);
        return has_gloss(scenario) == found->second.glossy && geometry == found->second.geometry &&
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
            const radiosity::CellGrid& cells = field.transport->patches.grids[i].cells;
            shading.field = field.upload;
            shading.field_cells_from_world = cells.cells_from_world;
            shading.field_cells = glm::vec3(cells.dims);
            shading.field_bricks = field.map->probes[i].bricks;
            shading.field_first_brick = int(field.map->probes[i].first_brick);
            shading.field_air_z = field.map->probes[i].air_z;
            if (i < field.ranges.size()) {
                shading.volume = field.volumes[i];
                shading.size = radiosity::radiance_volume_size(cells);
                shading.field_range = field.ranges[i];
            }
        }
    }
}

} // namespace cl
