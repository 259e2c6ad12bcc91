#pragma once

#include "servers/visual/field_job.h"
#include "servers/visual/first_error.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/rest.h"
#include "servers/visual/steady_lights.h"
#include "servers/visual/storage.h"

#include "core/threads.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace cl {

/// Keeps the GI fields of all scenarios that have probes: makes light transport when still things or probes
/// changed, solves when lights did, both on the worker, and uploads what came out between two frames.
///
/// What moves is not part of the field: an instance that changed within the last kRestSteps steps is lit by
/// the air, and the field is made without it, until it rests.
class FieldDriver {
public:
    FieldDriver(Storage& storage, InstanceStorage& instances, Rasterizer& rasterizer, WorkerQueue& worker);
    ~FieldDriver();
    FieldDriver(const FieldDriver&) = delete;
    FieldDriver& operator=(const FieldDriver&) = delete;

    /// How finely patches are cut: 128 cells along a probe's longest axis, or 64.
    void set_quality(Quality quality) noexcept { quality_ = quality; }
    /// Takes in what the worker finished and gives it what changed. Instances must be up to date.
    Status step(Rest rest = Rest::AfterSteps);
    /// Takes in what the worker has finished, and starts nothing.
    Status take_in();
    /// True while light is being worked out for transport that is there.
    [[nodiscard]] bool is_relighting() const;
    /// False while a step with Rest::AtOnce would do anything, now or once the worker is done.
    [[nodiscard]] bool is_settled();

    /// True while light transport is being made that some scenario has nothing to show without.
    [[nodiscard]] bool is_starting() const;

    /// Fills the parts of a probe's shading that tell where its light is found.
    void describe(RID probe_instance, const Instance& instance, GIProbeShading& shading) const;

    [[nodiscard]] uint64_t uploads() const noexcept { return uploads_; } ///< of light, so far
    [[nodiscard]] double bake_ms() const noexcept { return bake_ms_; }   ///< last transport made
    [[nodiscard]] double relight_ms() const noexcept {
        return relight_ms_;
    } ///< last solution, upload included
    [[nodiscard]] double upload_ms() const noexcept { return upload_ms_; }

private:
    struct Field {
        FieldGeometry geometry;
        FieldParts parts;
        radiosity::Lighting lighting;
        SteadyLights steady;
        FieldReaders readers;
        RID upload; ///< the rasteriser's
        /// What reflections see, one a probe; empty where nothing is glossy.
        std::vector<RID> volumes;
        std::vector<float> ranges;
        std::shared_ptr<FieldJob> job;
    };
    struct Restless {
        uint64_t look = 0, changed_at = 0;
    };

    [[nodiscard]] FieldGeometry wanted_geometry(RID scenario, Rest rest);
    /// All of it steady.
    [[nodiscard]] radiosity::Lighting wanted_lighting(RID scenario, const FieldGeometry& geometry) const;
    [[nodiscard]] FieldReaders wanted_readers(RID scenario, const FieldGeometry& geometry);
    Status upload_volumes(Field& field, const FieldJob& job);
    [[nodiscard]] bool rests(RID rid, uint64_t look, Rest rest);
    void start(Field& field, FieldGeometry geometry, radiosity::Lighting lighting,
               const FieldReaders& readers, Rest rest);
    Status take_in(Field& field);
    void drop(Field& field);
    /// Tells the instances of a field that they are in it.
    void mark_still(const Field& field);
    [[nodiscard]] std::vector<RID> scenarios_with_probes() const;

    Storage& storage_;
    InstanceStorage& instances_;
    Rasterizer& rasterizer_;
    WorkerQueue& worker_;
    std::unordered_map<RID, Field> fields_; ///< by scenario
    std::unordered_map<RID, Restless> seen_;
    uint64_t step_ = 0, uploads_ = 0;
    Quality quality_ = Quality::High;
    double bake_ms_ = 0.0, relight_ms_ = 0.0, upload_ms_ = 0.0;
};

} // namespace cl
