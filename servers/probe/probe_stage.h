#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cl {

// The life of a GI probe, in one table (spec gi-update section 2). ProbeMachine walks it; nothing else
// decides.

/// Where a probe is in its life.
enum class ProbeStage : uint8_t {
    Unset,     ///< no volume: no data yet, or data that no volume could be made for
    Check,     ///< its volume shows what it was last lit by; each step looks for a reason to light it again
    Lighting,  ///< a worker lights the cells
    Uploading, ///< lit bytes are on their way to the rasteriser
};

/// What a step finds when it looks at a probe: exactly one of these, the first that holds in its stage.
enum class ProbeSignal : uint8_t {
    NoData,      ///< nothing was baked or assigned
    Unusable,    ///< a volume for this very data was refused: wait for other data
    NotSetUp,    ///< there is data and no volume
    DataChanged, ///< other data than the volume was made from
    Unchanged,   ///< lights and parameters are those it was lit with
    RelightDue,  ///< some are not (ProbeCause names them)
    WorkerBusy,  ///< the worker has not finished
    VolumeNew,   ///< the worker has finished and some texels may differ
    VolumeSame,  ///< the worker has finished and no texel differs
    VolumeReady, ///< the bytes of a new volume are in memory
};

/// What a transition does on its way.
enum class ProbeAction : uint8_t {
    None,
    SetUp,     ///< make an empty volume
    Light,     ///< hand the changes to the worker
    Upload,    ///< give the rasteriser all texels that changed, in this step: a volume is never half new
    StartOver, ///< free the volume, let the worker's result go
};

struct ProbeTransition {
    ProbeStage from;
    ProbeSignal on;
    ProbeStage to;
    ProbeAction action;
};

/// All transitions. A pair of stage and signal that is not here cannot occur: a step passes through Uploading
/// without looking at the data again.
inline constexpr std::array<ProbeTransition, 11> kProbeTransitions{{
    {ProbeStage::Unset, ProbeSignal::NoData, ProbeStage::Unset, ProbeAction::None},
    {ProbeStage::Unset, ProbeSignal::Unusable, ProbeStage::Unset, ProbeAction::None},
    {ProbeStage::Unset, ProbeSignal::NotSetUp, ProbeStage::Check, ProbeAction::SetUp},
    {ProbeStage::Check, ProbeSignal::Unchanged, ProbeStage::Check, ProbeAction::None},
    {ProbeStage::Check, ProbeSignal::RelightDue, ProbeStage::Lighting, ProbeAction::Light},
    {ProbeStage::Check, ProbeSignal::DataChanged, ProbeStage::Unset, ProbeAction::StartOver},
    {ProbeStage::Lighting, ProbeSignal::WorkerBusy, ProbeStage::Lighting, ProbeAction::None},
    {ProbeStage::Lighting, ProbeSignal::VolumeNew, ProbeStage::Uploading, ProbeAction::None},
    {ProbeStage::Lighting, ProbeSignal::VolumeSame, ProbeStage::Check, ProbeAction::None},
    {ProbeStage::Lighting, ProbeSignal::DataChanged, ProbeStage::Unset, ProbeAction::StartOver},
    {ProbeStage::Uploading, ProbeSignal::VolumeReady, ProbeStage::Check, ProbeAction::Upload},
}};

/// The transition for `on` in stage `from`; asserts that the table has it.
[[nodiscard]] const ProbeTransition& probe_transition(ProbeStage from, ProbeSignal on);

[[nodiscard]] std::string_view to_string(ProbeStage stage) noexcept;
[[nodiscard]] std::string_view to_string(ProbeSignal signal) noexcept;

} // namespace cl
