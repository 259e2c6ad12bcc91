#include "drivers/dummy/dummy_rasterizer.h"

namespace cl::dummy {
namespace {

template <typename Item>
std::vector<MaterialDesc> materials_of(std::span<const Item> items) {
    std::vector<MaterialDesc> materials;
    for (const Item& item : items) {
        materials.push_back(*item.material);
    }
    return materials;
}

} // namespace

RecordedFrame::RecordedFrame(RID drawn_to, const Frame& drawn)
    : target(drawn_to), frame(drawn), opaque(drawn.opaque.begin(), drawn.opaque.end()),
      transparent(drawn.transparent.begin(), drawn.transparent.end()),
      lights(drawn.lights.begin(), drawn.lights.end()),
      gi_probes(drawn.gi_probes.begin(), drawn.gi_probes.end()),
      world(drawn.world.begin(), drawn.world.end()), opaque_materials(materials_of(drawn.opaque)),
      transparent_materials(materials_of(drawn.transparent)), world_materials(materials_of(drawn.world)) {
    for (const LightItem& light : drawn.lights) {
        casters.emplace_back(light.casters.begin(), light.casters.end());
        light_descs.push_back(*light.desc);
    }
    // What would dangle once the server goes on must not be there to be followed.
    for (std::vector<DrawItem>* items : {&opaque, &transparent}) {
        for (DrawItem& item : *items) {
            item.material = nullptr;
        }
    }
    for (WorldItem& item : world) {
        item.material = nullptr;
    }
    for (LightItem& light : lights) {
        light.desc = nullptr;
        light.casters = {};
    }
    for (std::vector<CasterItem>& list : casters) {
        for (CasterItem& caster : list) {
            caster.material = nullptr;
        }
    }
    frame.opaque = frame.transparent = {};
    frame.lights = {};
    frame.gi_probes = {};
    frame.world = {};
}

} // namespace cl::dummy
