#include "servers/visual/field_job.h"

#include "servers/radiosity/air_light.h"

#include "core/stopwatch.h"

namespace cl {

void FieldJob::run() {
    const Stopwatch baking;
    const bool made = make_parts();
    bake_ms = is_new ? baking.elapsed_ms() : 0.0;
    if (made) {
        const Stopwatch solving;
        solve();
        solve_ms = solving.elapsed_ms();
    }
    done = true;
}

bool FieldJob::make_parts() {
    if (is_new) {
        auto scene = std::make_shared<const radiosity::StillScene>(make_still_scene(items));
        items.clear();
        std::vector<radiosity::ProbeBox> boxes;
        for (const FieldGeometry::Probe& p : geometry.probes) {
            boxes.push_back({p.world_from_probe, p.box, geometry.quality == Quality::High ? 128 : 64});
        }
        auto made = radiosity::make_transport(scene, boxes, stop);
        if (!made) {
            error = made.error().message;
            return false;
        }
        parts.transport = *made;
        parts.map = std::make_shared<const radiosity::FieldMap>(radiosity::make_field_map(*parts.transport));
        parts.memory = std::make_shared<radiosity::LightMemory>();
    }
    if (!parts.air) {
        parts.air = std::make_shared<const std::vector<radiosity::AirPoints>>(
            radiosity::make_air(*parts.transport, readers.air, stop));
    }
    return true;
}

void FieldJob::solve() {
    const radiosity::Solution solution =
        radiosity::solve(*parts.transport, lighting, stop, parts.memory.get());
    if (stop) {
        return;
    }
    bounces = solution.bounces;
    light = radiosity::encode_field(*parts.map, solution);
    air = radiosity::encode_air(*parts.air, *parts.map, radiosity::light_air(*parts.air, lighting, solution));
    for (size_t i = 0; readers.glossy && i < parts.transport->probe_count; ++i) {
        volumes.push_back(radiosity::make_radiance_volume(*parts.transport, i, solution));
    }
}

} // namespace cl
