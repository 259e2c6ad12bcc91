#pragma once

#include "servers/radiosity/field_map.h"
#include "servers/radiosity/radiance_volume.h"
#include "servers/radiosity/solver.h"
#include "servers/radiosity/transport.h"
#include "servers/visual/first_error.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/still_items.h"
#include "servers/visual/storage.h"

#include "core/threads.h"

#include <atomic>
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
    static constexpr uint64_t kRestSteps = 30;

    FieldDriver(Storage& storage, InstanceStorage& instances, Rasterizer& rasterizer, WorkerQueue& worker);
    ~FieldDriver();
    FieldDriver(const FieldDriver&) = delete;
    FieldDriver& operator=(const FieldDriver&) = delete;

    /// When things count as resting.
    enum class Rest : uint8_t { AfterSteps, AtOnce };
    /// How finely patches are cut: 128 cells along a probe's longest axis, or 64.
    void set_quality(Quality quality) noexcept { quality_ = quality; }
    /// Takes in what the worker finished and gives it what changed. Instances must be up to date.
    Status step(Rest rest = Rest::AfterSteps);
    /// False while a step with Rest::AtOnce would do anything, now or once the worker is done.
    [[nodiscard]] bool is_settled();

    /// Fills the parts of a probe's shading that tell where its light is found.
    void describe(RID probe_instance, const Instance& instance, GIProbeShading& shading) const;

    [[nodiscard]] double bake_ms() const noexcept { return bake_ms_; } ///< last transport made
    [[nodiscard]] double relight_ms() const noexcept {
        return relight_ms_;
    } ///< last solution, upload included
    [[nodiscard]] double upload_ms() const noexcept { return upload_ms_; }

private:
    /// A probe's place in the field.
    struct ProbeKey {
        RID instance;
        Transform world_from_probe;
        AABB box;
        friend bool operator==(const ProbeKey& a, const ProbeKey& b) {
            return a.instance == b.instance && a.world_from_probe == b.world_from_probe &&
                   a.box.position == b.box.position && a.box.size == b.box.size;
        }
    };
    /// A still instance and the newest version of its looks.
    struct ItemKey {
        RID instance;
        uint64_t look = 0;
        friend bool operator==(const ItemKey&, const ItemKey&) = default;
    };
    struct Geometry {
        std::vector<ProbeKey> probes;
        std::vector<ItemKey> items;
        Quality quality = Quality::High;
        friend bool operator==(const Geometry&, const Geometry&) = default;
    };
    /// Work for the worker and what comes of it. Shared, so that neither side waits when the other goes.
    struct Job;
    struct Field {
        Geometry geometry;
        std::shared_ptr<const radiosity::Transport> transport;
        std::shared_ptr<const radiosity::FieldMap> map;
        std::shared_ptr<radiosity::DirectCache> direct; ///< of the transport; the job's while there is one
        radiosity::Lighting lighting;
        RID upload; ///< the rasteriser's
        /// What reflections see, one a probe; empty where nothing is glossy.
        std::vector<RID> volumes;
        std::vector<float> ranges;
        bool glossy = false; ///< volumes are wanted
        std::shared_ptr<Job> job;
    };
    struct Restless {
        uint64_t look = 0, changed_at = 0;
    };

    [[nodiscard]] Geometry wanted_geometry(RID scenario, Rest rest);
    [[nodiscard]] radiosity::Lighting wanted_lighting(RID scenario, const Geometry& geometry) const;
    [[nodiscard]] bool has_gloss(RID scenario);
    Status upload_volumes(Field& field, const Job& job);
    [[nodiscard]] bool rests(RID rid, uint64_t look, Rest rest);
    void start(Field& field, Geometry geometry, radiosity::Lighting lighting, bool glossy);
    Status take_in(Field& field);
    void drop(Field& field);
    [[nodiscard]] std::vector<RID> scenarios_with_probes() const;

    Storage& storage_;
    InstanceStorage& instances_;
    Rasterizer& rasterizer_;
    WorkerQueue& worker_;
    std::unordered_map<RID, Field> fields_; ///< by scenario
    std::unordered_map<RID, Restless> seen_;
    uint64_t step_ = 0;
    Quality quality_ = Quality::High;
    double bake_ms_ = 0.0, relight_ms_ = 0.0, upload_ms_ = 0.0;
};

} // namespace cl
