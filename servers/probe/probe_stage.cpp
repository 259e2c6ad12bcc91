#include "servers/probe/probe_stage.h"

#include "core/assert.h"

#include <algorithm>

namespace cl {

const ProbeTransition& probe_transition(ProbeStage from, ProbeSignal on) {
    const auto found =
        std::find_if(kProbeTransitions.begin(), kProbeTransitions.end(),
                     [from, on](const ProbeTransition& t) { return t.from == from && t.on == on; });
    CL_ASSERT(found != kProbeTransitions.end(), "a probe met a signal that its stage has no transition for");
    return *found;
}

std::string_view to_string(ProbeStage stage) noexcept {
    switch (stage) {
    case ProbeStage::Unset:
        return "Unset";
    case ProbeStage::Check:
        return "Check";
    case ProbeStage::Lighting:
        return "Lighting";
    case ProbeStage::Uploading:
        return "Uploading";
    }
    return "?";
}

std::string_view to_string(ProbeSignal signal) noexcept {
    switch (signal) {
    case ProbeSignal::NoData:
        return "no data";
    case ProbeSignal::Unusable:
        return "unusable";
    case ProbeSignal::NotSetUp:
        return "not set up";
    case ProbeSignal::DataChanged:
        return "data changed";
    case ProbeSignal::Unchanged:
        return "nothing changed";
    case ProbeSignal::RelightDue:
        return "relight due";
    case ProbeSignal::WorkerBusy:
        return "worker busy";
    case ProbeSignal::VolumeNew:
        return "lit";
    case ProbeSignal::VolumeSame:
        return "lit, no texel changed";
    case ProbeSignal::VolumeReady:
        return "uploaded";
    }
    return "?";
}

} // namespace cl
