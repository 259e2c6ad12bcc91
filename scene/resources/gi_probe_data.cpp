#include "scene/resources/gi_probe_data.h"

#include "servers/visual_server.h"

#include "core/io/log.h"
#include "core/object/class_registry.h"

#include <atomic>
#include <utility>

namespace cl::scene {

void GIProbeData::bind(ClassBuilder<GIProbeData>& c) {
    c.doc("What a GI bake made, and how it is shown.");
    // The first three start probes over; the order of saving is that of spec gi-probe-data section 2.
    c.property(
         "bounds", [](const GIProbeData& d) { return d.data_.bounds; },
         [](GIProbeData& d, const AABB& box) {
             d.data_.bounds = box;
             d.data_changed();
         })
        .doc("The probe's box, probe-local [m].");
    c.property(
         "cell_size", [](const GIProbeData& d) { return d.data_.cell_size_m; },
         [](GIProbeData& d, float size_m) {
             d.data_.cell_size_m = size_m;
             d.data_changed();
         })
        .doc("Edge of a leaf cell [m].");
    c.property(
         "to_cell_xform", [](const GIProbeData& d) { return d.data_.cells_from_local; },
         [](GIProbeData& d, const Transform& cells_from_local) {
             d.data_.cells_from_local = cells_from_local;
         })
        .doc("Probe-local metres to cells.");
    c.property(
         "dynamic_data", [](const GIProbeData& d) { return PoolIntArray(d.data_.dynamic_data); },
         &GIProbeData::set_dynamic_data)
        .doc("Header and octree cells; empty: not baked.");
    const auto field = [&c](std::string_view name, auto member, auto set) {
        return c.property(
            name, [member](const GIProbeData& d) { return d.data_.*member; }, set);
    };
    using D = gi::ProbeData;
    field("dynamic_range", &D::dynamic_range, &GIProbeData::set_dynamic_range)
        .doc("Radiance that a texel of 1 stands for.");
    field("energy", &D::energy, &GIProbeData::set_energy).doc("Factor on the probe's light.");
    field("bias", &D::bias_cells, &GIProbeData::set_bias).doc("Distance at which cones start [cells].");
    field("normal_bias", &D::normal_bias_m, &GIProbeData::set_normal_bias)
        .doc("Offset of cones along the normal [m].");
    field("propagation", &D::propagation, &GIProbeData::set_propagation)
        .doc("How much light survives upwards in the tree.");
    field("interior", &D::interior, &GIProbeData::set_interior).doc("No sky light where cones find nothing.");
    field("compress", &D::compress, &GIProbeData::set_compress)
        .doc("Shows the texture as S3TC blocks would keep it.");
}

void GIProbeData::set_data(gi::ProbeData data) {
    data_ = std::move(data);
    cells_changed();
}

SetResult GIProbeData::set_dynamic_data(const PoolIntArray& cells) {
    refusal_.clear();
    if (!cells.empty()) {
        if (const Expected<gi::Octree> octree = gi::decode_octree(cells.span()); !octree) {
            refusal_ = octree.error().message;
            return SetResult::Refused;
        }
    }
    data_.dynamic_data.assign(cells.span().begin(), cells.span().end());
    cells_changed();
    return SetResult::Done;
}

void GIProbeData::set_energy(float energy) {
    data_.energy = energy;
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->gi_probe_set_energy(rid_.get(), energy));
    }
}

void GIProbeData::set_bias(float bias_cells) {
    data_.bias_cells = bias_cells;
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->gi_probe_set_bias(rid_.get(), bias_cells));
    }
}

void GIProbeData::set_normal_bias(float normal_bias_m) {
    data_.normal_bias_m = normal_bias_m;
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->gi_probe_set_normal_bias(rid_.get(), normal_bias_m));
    }
}

void GIProbeData::set_propagation(float propagation) {
    data_.propagation = propagation;
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->gi_probe_set_propagation(rid_.get(), propagation));
    }
}

void GIProbeData::set_interior(bool interior) {
    data_.interior = interior;
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->gi_probe_set_interior(rid_.get(), interior));
    }
}

void GIProbeData::set_dynamic_range(int dynamic_range) {
    data_.dynamic_range = dynamic_range;
    if (VisualServer* server = rid_.server()) {
        static_cast<void>(server->gi_probe_set_dynamic_range(rid_.get(), dynamic_range));
    }
}

void GIProbeData::set_compress(bool compress) {
    if (compress != data_.compress) {
        data_.compress = compress;
        data_changed();
    }
}

RID GIProbeData::rid(VisualServer& server) const {
    if (const RID made = rid_.in(server)) {
        return made;
    }
    rid_.adopt(server, server.gi_probe_create());
    if (const Status set = server.gi_probe_set_data(rid_.get(), data_); !set) {
        log_error(path().empty() ? set.error().to_string() : path() + ": " + set.error().to_string());
    }
    return rid_.get();
}

void GIProbeData::cells_changed() {
    static std::atomic<uint64_t> newest{0};
    cells_version_ = ++newest;
    data_changed();
}

void GIProbeData::data_changed() {
    if (VisualServer* server = rid_.server()) {
        if (const Status set = server->gi_probe_set_data(rid_.get(), data_); !set) {
            log_error(set.error().to_string());
        }
    }
    emit_changed();
}

} // namespace cl::scene
