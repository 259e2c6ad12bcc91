#pragma once

#include "servers/probe/probe_machine.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/storage.h"

#include "core/expected.h"
#include "core/threads.h"

#include <vector>

namespace cl {

/// Steps the machines of all probes that stand in a scenario, and finds the lights that each may receive.
class ProbeDriver {
public:
    /// All must outlive the driver; `worker` also the instances, whose jobs it runs.
    ProbeDriver(Storage& storage, InstanceStorage& instances, Rasterizer& rasterizer, WorkerQueue& worker);

    /// One step of each machine; instances must be up to date. @return the first error.
    Status step();
    /// False if a step would do anything, now or once the worker is done.
    [[nodiscard]] bool is_settled();

    /// Of the last round: from the first probe that was lit while all were at rest, to the last that came to
    /// rest. Work on the cells and upload, summed over the probes.
    [[nodiscard]] double relight_ms() const noexcept { return total_relight_ms_ - round_start_relight_ms_; }
    [[nodiscard]] double upload_ms() const noexcept { return total_upload_ms_ - round_start_upload_ms_; }
    [[nodiscard]] uint64_t uploads() const noexcept { return uploads_; } ///< of light, so far

private:
    [[nodiscard]] ProbeWanted wanted(const Instance& instance);
    void gather_lights(const Instance& instance, const GIProbe& probe);
    void add_light(RID light, const Transform& cells_from_world);
    [[nodiscard]] bool any_in_flight();

    Storage& storage_;
    InstanceStorage& instances_;
    Rasterizer& rasterizer_;
    RunJob run_;
    std::vector<ProbeLight> lights_; ///< of the probe being looked at; kept for its memory
    uint64_t uploads_ = 0;
    double total_relight_ms_ = 0.0, total_upload_ms_ = 0.0;
    double round_start_relight_ms_ = 0.0, round_start_upload_ms_ = 0.0;
};

} // namespace cl
