// VisualServer: GI probes.
#include "servers/visual_server.h"
#include "servers/visual_server_impl.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace cl {
namespace {

/// Sets a parameter that is read on every draw or step: nothing else need be told.
Status set_number(StaleRIDs& stale, Storage& storage, std::string_view call, RID rid, float GIProbe::*member,
                  float value) {
    GIProbe* probe = storage.gi_probes.get(rid);
    if (!probe) {
        return stale.refuse(call, "a GI probe", rid);
    }
    if (!std::isfinite(value)) {
        return stale.refuse(fmt::format("{}: expected a finite number, found {}", call, value));
    }
    probe->*member = value;
    return {};
}

} // namespace

RID VisualServer::gi_probe_create() {
    return edit().storage.gi_probes.make({});
}

Status VisualServer::gi_probe_set_data(RID rid, const gi::ProbeData& data) {
    GIProbe* probe = edit().storage.gi_probes.get(rid);
    if (!probe) {
        return edit().stale.refuse("gi_probe_set_data", "a GI probe", rid);
    }
    Status status = set_probe_data(*probe, data, edit().storage.clock);
    edit().instances.probe_data_changed(rid);
    return status;
}

Status VisualServer::gi_probe_set_energy(RID probe, float energy) {
    return set_number(edit().stale, edit().storage, "gi_probe_set_energy", probe, &GIProbe::energy, energy);
}

Status VisualServer::gi_probe_set_bias(RID probe, float bias_cells) {
    return set_number(edit().stale, edit().storage, "gi_probe_set_bias", probe, &GIProbe::bias_cells,
                      bias_cells);
}

Status VisualServer::gi_probe_set_normal_bias(RID probe, float normal_bias_m) {
    return set_number(edit().stale, edit().storage, "gi_probe_set_normal_bias", probe,
                      &GIProbe::normal_bias_m, normal_bias_m);
}

Status VisualServer::gi_probe_set_propagation(RID probe, float propagation) {
    return set_number(edit().stale, edit().storage, "gi_probe_set_propagation", probe, &GIProbe::propagation,
                      propagation);
}

Status VisualServer::gi_probe_set_interior(RID rid, bool interior) {
    GIProbe* probe = edit().storage.gi_probes.get(rid);
    if (!probe) {
        return edit().stale.refuse("gi_probe_set_interior", "a GI probe", rid);
    }
    probe->interior = interior;
    return {};
}

Status VisualServer::gi_probe_set_dynamic_range(RID rid, int dynamic_range) {
    GIProbe* probe = edit().storage.gi_probes.get(rid);
    if (!probe) {
        return edit().stale.refuse("gi_probe_set_dynamic_range", "a GI probe", rid);
    }
    if (dynamic_range < 1) {
        return edit().stale.refuse(
            fmt::format("gi_probe_set_dynamic_range: expected at least 1, found {}", dynamic_range));
    }
    probe->dynamic_range = dynamic_range;
    return {};
}

} // namespace cl
