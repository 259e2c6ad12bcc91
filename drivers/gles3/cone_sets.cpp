#include "drivers/gles3/cone_sets.h"

#include "drivers/gles3/draw_block.h"
#include "drivers/gles3/frame_block.h"

namespace cl::gles3 {

namespace {

cones::ConeProbe cone_probe(const GIProbeShading& probe, const Transform& world_from_view, bool biased,
                            GIVolumeStorage& volumes) {
    const shaders::GIProbe uniforms = make_gi_probe(probe, world_from_view, biased);
    if (uniforms.reach <= 0.0f) {
        return {}; // not set up: no point lies inside
    }
    return {.volume = volumes.cpu_volume(probe.volume),
            .cells_from_view = uniforms.cells_from_view,
            .bounds = uniforms.bounds,
            .uv_from_cells = uniforms.uv_from_cells,
            .multiplier = uniforms.multiplier,
            .bias = uniforms.bias,
            .normal_bias = uniforms.normal_bias,
            .reach = uniforms.reach,
            .blend_ambient = uniforms.blend_ambient != 0};
}

} // namespace

void ConeSets::clear() {
    numbers_.clear();
    keys_.clear();
}

int ConeSets::number_of(const DrawItem& item) {
    if (probe_count(item) == 0 || item.material->unshaded) {
        return 0;
    }
    const Key key{item.gi_probes, item.receives_baked_light};
    if (!keys_.empty() && keys_.back() == key) {
        return int(keys_.size());
    }
    const auto [at, is_new] = numbers_.try_emplace(key, int(keys_.size()) + 1);
    if (is_new) {
        keys_.push_back(key);
    }
    return at->second;
}

std::vector<cones::ConeSet> ConeSets::resolve(const Frame& frame, GIVolumeStorage& volumes) const {
    std::vector<cones::ConeSet> sets(keys_.size());
    for (size_t i = 0; i < sets.size(); ++i) {
        for (size_t k = 0; k < 2; ++k) {
            const int probe = keys_[i].probes[k];
            if (probe >= 0 && size_t(probe) < frame.gi_probes.size()) {
                sets[i].probes[k] = cone_probe(frame.gi_probes[size_t(probe)], frame.camera.world_from_camera,
                                               keys_[i].biased, volumes);
            }
        }
    }
    return sets;
}

} // namespace cl::gles3
