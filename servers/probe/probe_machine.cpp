#include "servers/probe/probe_machine.h"

#include "core/assert.h"
#include "core/io/log.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace cl {
namespace {

/// Texels kept in memory after their upload, so that the next relight need not allocate. Beyond this memory
/// counts for more than the few milliseconds.
constexpr size_t kMaxKeptTexelBytes = size_t{16} << 20;

double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

ProbeMachine::ProbeMachine(std::string name) : name_(std::move(name)) {}

ProbeMachine::~ProbeMachine() {
    CL_ASSERT(!volume_, "a GI probe was destroyed before its volume was freed");
}

Status ProbeMachine::step(const ProbeWanted& wanted, Rasterizer& rasterizer, const RunJob& run) {
    Status first_error;
    for (;;) {
        LightChanges due = changes(wanted);
        const ProbeTransition& transition = probe_transition(stage_, observe(wanted, due));
        if (transition.from == transition.to) {
            if (transition.on == ProbeSignal::Unchanged) {
                applied_.lights.assign(wanted.lights.begin(),
                                       wanted.lights.end()); // remembers who is unlit, and why
            }
            return first_error;
        }
        if (transition.from == ProbeStage::Lighting && transition.on != ProbeSignal::DataChanged) {
            total_work_ms_ += cells_->work_ms;
        }
        Status done;
        switch (transition.action) {
        case ProbeAction::None:
            break;
        case ProbeAction::SetUp:
            done = set_up(wanted, rasterizer);
            break;
        case ProbeAction::Light:
            light(wanted, std::move(due.edits), run);
            break;
        case ProbeAction::Upload:
            done = upload(rasterizer);
            break;
        case ProbeAction::StartOver:
            release(rasterizer);
            break;
        }
        if (first_error.ok() && !done.ok()) {
            first_error = done;
        }
        if (transition.action == ProbeAction::SetUp && !done.ok()) {
            continue; // Unset still, and Unusable from now on
        }
        log(transition, due.causes);
        stage_ = transition.to;
        if (stage_ == ProbeStage::Lighting) {
            return first_error; // the upload belongs to a later step, however fast the worker is
        }
    }
}

bool ProbeMachine::is_pending(const ProbeWanted& wanted) const {
    if (stage_ == ProbeStage::Lighting) {
        return true;
    }
    const ProbeTransition& transition = probe_transition(stage_, observe(wanted, changes(wanted)));
    return transition.from != transition.to;
}

LightChanges ProbeMachine::changes(const ProbeWanted& wanted) const {
    if (stage_ != ProbeStage::Check) {
        return {};
    }
    LightChanges result = compare_lights(applied_.lights, wanted.lights);
    if (applied_.dynamic_range == 0) {
        result.causes = {};
        result.causes.add(ProbeCause::NeverLit);
        return result;
    }
    if (applied_.propagation != wanted.propagation) {
        result.causes.add(ProbeCause::PropagationChanged);
    }
    if (applied_.dynamic_range != wanted.dynamic_range) {
        result.causes.add(ProbeCause::DynamicRangeChanged);
    }
    return result;
}

ProbeSignal ProbeMachine::observe(const ProbeWanted& wanted, const LightChanges& due) const {
    if (stage_ == ProbeStage::Unset) {
        if (!wanted.layout) {
            return ProbeSignal::NoData;
        }
        return wanted.data_version == unusable_version_ ? ProbeSignal::Unusable : ProbeSignal::NotSetUp;
    }
    if (stage_ == ProbeStage::Uploading) {
        return ProbeSignal::VolumeReady;
    }
    if (wanted.data_version != data_version_) {
        return ProbeSignal::DataChanged;
    }
    if (stage_ == ProbeStage::Check) {
        return due.causes.any() ? ProbeSignal::RelightDue : ProbeSignal::Unchanged;
    }
    if (cells_->busy.load(std::memory_order_acquire)) {
        return ProbeSignal::WorkerBusy;
    }
    return cells_->texels.boxes.empty() ? ProbeSignal::VolumeSame : ProbeSignal::VolumeNew;
}

Status ProbeMachine::set_up(const ProbeWanted& wanted, Rasterizer& rasterizer) {
    Expected<RID> volume = rasterizer.gi_volume_create(
        {.size = wanted.layout->dims, .mip_count = gi::mip_count(*wanted.layout, wanted.coding)});
    if (!volume) {
        unusable_version_ = wanted.data_version;
        return volume.error();
    }
    volume_ = *volume;
    cells_ = std::make_shared<RelightCells>(wanted.layout, wanted.coding);
    data_version_ = wanted.data_version;
    applied_ = {};
    return {};
}

void ProbeMachine::light(const ProbeWanted& wanted, std::vector<LightEdit> edits, const RunJob& run) {
    applied_.propagation = wanted.propagation;
    applied_.dynamic_range = wanted.dynamic_range;
    applied_.lights.assign(wanted.lights.begin(), wanted.lights.end());
    cells_->busy.store(true, std::memory_order_relaxed);
    // shared: std::function wants a copyable job
    auto order = std::make_shared<const RelightOrder>(RelightOrder{
        .edits = std::move(edits), .propagation = wanted.propagation, .dynamic_range = wanted.dynamic_range});
    run([cells = cells_, order] { relight(*cells, *order); });
}

Status ProbeMachine::upload(Rasterizer& rasterizer) {
    const auto start = std::chrono::steady_clock::now();
    Status status;
    for (const gi::TexelBoxes::Box& box : cells_->texels.boxes) {
        status = rasterizer.gi_volume_upload(volume_, box.mip, box.offset, box.size,
                                             cells_->texels.texels_of(box));
        if (!status) {
            break;
        }
    }
    if (status.ok()) {
        shown_dynamic_range_ = cells_->encoded_range;
    } else {
        cells_->encoded_range = 0; // the next relight sends all texels anew
    }
    if (cells_->texels.rgba8.size() > kMaxKeptTexelBytes) {
        cells_->texels = {};
    }
    total_upload_ms_ += ms_since(start);
    ++uploads_;
    return status;
}

void ProbeMachine::release(Rasterizer& rasterizer) {
    if (cells_) {
        cells_->abandoned = true;
        cells_.reset();
    }
    if (volume_) {
        if (const Status freed = rasterizer.free(volume_); !freed) {
            log_warning(freed.error().message);
        }
        volume_ = {};
    }
    applied_ = {};
    data_version_ = 0;
    shown_dynamic_range_ = 0;
    stage_ = ProbeStage::Unset;
}

void ProbeMachine::log(const ProbeTransition& transition, const ProbeCauses& causes) const {
    if (log_level() > LogLevel::Debug) {
        return;
    }
    const std::string why = causes.any() ? causes.to_string() : std::string(to_string(transition.on));
    log_debug(
        fmt::format("{}: {} -> {} ({})", name_, to_string(transition.from), to_string(transition.to), why));
}

} // namespace cl
