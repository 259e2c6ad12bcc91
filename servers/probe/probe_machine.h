#pragma once

#include "servers/probe/probe_light.h"
#include "servers/probe/probe_stage.h"
#include "servers/probe/relight_job.h"
#include "servers/rasterizer.h"

#include "core/expected.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cl {

/// What a probe should be, looked at afresh on each step. The machine compares it with what it last did, so a
/// change is noticed whenever it comes, in whatever stage, and cannot be lost.
struct ProbeWanted {
    std::shared_ptr<const gi::CellLayout> layout;    ///< null: no data
    gi::TexelCoding coding = gi::TexelCoding::Plain; ///< changes with the data version only
    uint64_t data_version = 0;                       ///< another number for each assignment of data
    float propagation = 1.0f;
    int dynamic_range = 1;              ///< >= 1
    std::span<const ProbeLight> lights; ///< sorted by key
};

/// Runs a job now or later, in the order given, one at a time.
using RunJob = std::function<void(std::function<void()>)>;

/// One GI probe's way through kProbeTransitions: owns its volume and its cells.
/// Main thread only; the relighting itself goes to `run`.
class ProbeMachine {
public:
    /// @param name  for the log: "GI probe 3"
    explicit ProbeMachine(std::string name);
    ProbeMachine(const ProbeMachine&) = delete;
    ProbeMachine& operator=(const ProbeMachine&) = delete;
    /// release() must have been called if there is a volume.
    ~ProbeMachine();

    /// Goes as far as it can without waiting: at most once around the table.
    /// @return an error of the rasteriser; the machine is in a stage of the table all the same.
    Status step(const ProbeWanted& wanted, Rasterizer& rasterizer, const RunJob& run);
    /// True if step() would do anything, now or once the worker is done.
    [[nodiscard]] bool is_pending(const ProbeWanted& wanted) const;
    /// Frees the volume and forgets everything.
    void release(Rasterizer& rasterizer);

    [[nodiscard]] ProbeStage stage() const noexcept { return stage_; }
    /// Null while unset. Black until it was first lit.
    [[nodiscard]] RID volume() const noexcept { return volume_; }
    /// Dynamic range of the texels that the rasteriser holds; 0 before the first upload.
    [[nodiscard]] int shown_dynamic_range() const noexcept { return shown_dynamic_range_; }
    /// Time of the relights that have ended: work on the cells, and upload. Never reset.
    [[nodiscard]] double total_work_ms() const noexcept { return total_work_ms_; }
    [[nodiscard]] double total_upload_ms() const noexcept { return total_upload_ms_; }
    [[nodiscard]] uint64_t uploads() const noexcept { return uploads_; } ///< so far

private:
    [[nodiscard]] LightChanges changes(const ProbeWanted& wanted) const;
    [[nodiscard]] ProbeSignal observe(const ProbeWanted& wanted, const LightChanges& changes) const;
    Status set_up(const ProbeWanted& wanted, Rasterizer& rasterizer);
    void light(const ProbeWanted& wanted, std::vector<LightEdit> edits, const RunJob& run);
    Status upload(Rasterizer& rasterizer);
    void log(const ProbeTransition& transition, const ProbeCauses& causes) const;

    /// What the cells were last ordered to be lit with.
    struct Applied {
        float propagation = 0.0f;
        int dynamic_range = 0; ///< 0: never lit
        std::vector<ProbeLight> lights;
    };

    std::string name_;
    ProbeStage stage_ = ProbeStage::Unset;
    std::shared_ptr<RelightCells> cells_;
    RID volume_;
    uint64_t data_version_ = 0;     ///< of cells_
    uint64_t unusable_version_ = 0; ///< data that no volume could be made for
    Applied applied_;
    int shown_dynamic_range_ = 0;
    uint64_t uploads_ = 0;
    double total_work_ms_ = 0.0, total_upload_ms_ = 0.0;
};

} // namespace cl
