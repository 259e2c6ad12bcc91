// The part of RasterizerChecked that looks at a Frame before it is drawn.
#include "servers/rasterizer_checked.h"
#include "servers/visual/texture_storage.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace cl {
namespace {

Error wrong(std::string message) {
    return {ErrorCode::InvalidArgument, "draw: " + std::move(message), {}};
}

} // namespace

Status RasterizerChecked::check_frame(const Frame& frame) const {
    if (frame.size.x <= 0 || frame.size.y <= 0) {
        return wrong(fmt::format("expected a size above 0, found {}x{}", frame.size.x, frame.size.y));
    }
    if (frame.shadow_atlas_size <= 0 || frame.directional_shadow_size <= 0) {
        return wrong(fmt::format("expected shadow map sizes above 0, found {} and {}",
                                 frame.shadow_atlas_size, frame.directional_shadow_size));
    }
    if (frame.has_environment && frame.environment.sky && !find(frame.environment.sky, Kind::Sky)) {
        return wrong("expected a live sky or the null RID in the environment");
    }
    if (frame.directional_count < 0 || frame.directional_count > kMaxDirectionalLights ||
        static_cast<size_t>(frame.directional_count) > frame.lights.size()) {
        return wrong(fmt::format("expected a directional_count of at most {} and {} lights, found {}",
                                 kMaxDirectionalLights, frame.lights.size(), frame.directional_count));
    }
    for (size_t i = 0; i < frame.lights.size(); ++i) {
        if (Status valid = check_light(frame, i); !valid) {
            return valid;
        }
    }
    for (const WorldItem& item : frame.world) {
        if (Status valid = check_surface(item.mesh, item.surface, item.material); !valid) {
            return valid;
        }
    }
    for (const GIProbeShading& probe : frame.gi_probes) {
        if (Status valid = check_probe(probe); !valid) {
            return valid;
        }
    }
    for (std::span<const DrawItem> items : {frame.opaque, frame.transparent}) {
        for (const DrawItem& item : items) {
            if (Status valid = check_item(frame, item); !valid) {
                return valid;
            }
            if (item.material->is_transparent() != (items.data() == frame.transparent.data())) {
                return wrong("expected each item in the list that its material belongs to");
            }
        }
    }
    return {};
}

Status RasterizerChecked::check_surface(RID mesh, int surface, const MaterialDesc* material) const {
    const Thing* thing = find(mesh, Kind::Mesh);
    if (!thing) {
        return wrong("expected a live mesh in each item");
    }
    if (surface < 0 || static_cast<size_t>(surface) >= thing->surfaces) {
        return wrong(fmt::format("expected a surface below {}, found {}", thing->surfaces, surface));
    }
    if (!material) {
        return wrong("expected a material in each item");
    }
    Status status;
    for_each_texture(*material, [this, &status](RID texture, TextureColorSpace) {
        if (texture && !find(texture, Kind::Texture)) {
            status = wrong("expected live textures or null RIDs in each material");
        }
    });
    return status;
}

Status RasterizerChecked::check_item(const Frame& frame, const DrawItem& item) const {
    if (Status valid = check_surface(item.mesh, item.surface, item.material); !valid) {
        return valid;
    }
    for (int probe : item.gi_probes) {
        if (probe < -1 || probe >= static_cast<int>(frame.gi_probes.size())) {
            return wrong(fmt::format("expected a probe below {}, found {}", frame.gi_probes.size(), probe));
        }
    }
    if (item.gi_probes[0] < 0 && item.gi_probes[1] >= 0) {
        return wrong("expected a first probe wherever there is a second");
    }
    if (item.omni_count > item.omnis.size() || item.spot_count > item.spots.size()) {
        return wrong(fmt::format("expected at most {} omni and spot lights, found {} and {}",
                                 item.omnis.size(), item.omni_count, item.spot_count));
    }
    const auto check = [&frame](std::span<const uint16_t> indices, LightType type) -> Status {
        for (uint16_t index : indices) {
            if (index >= frame.lights.size() || frame.lights[index].desc->type != type) {
                return wrong(fmt::format("expected an index of a light of the right type, found {}", index));
            }
        }
        return {};
    };
    if (Status omnis = check(std::span(item.omnis).first(item.omni_count), LightType::Omni); !omnis) {
        return omnis;
    }
    return check(std::span(item.spots).first(item.spot_count), LightType::Spot);
}

Status RasterizerChecked::check_light(const Frame& frame, size_t index) const {
    const LightItem& light = frame.lights[index];
    if (!light.desc) {
        return wrong("expected a description of each light");
    }
    const bool in_front = index < static_cast<size_t>(frame.directional_count);
    if ((light.desc->type == LightType::Directional) != in_front) {
        return wrong("expected the directional lights, and only those, to come first");
    }
    for (const CasterItem& caster : light.casters) {
        if (Status valid = check_surface(caster.mesh, caster.surface, caster.material); !valid) {
            return valid;
        }
    }
    return {};
}

Status RasterizerChecked::check_probe(const GIProbeShading& probe) const {
    if (!probe.volume) {
        return {};
    }
    const Thing* thing = find(probe.volume, Kind::Volume);
    if (!thing) {
        return wrong("expected a live GI volume or the null RID in each probe");
    }
    if (probe.size != thing->volume.size) {
        return wrong(fmt::format("expected the probe to have its volume's size {}x{}x{}, found {}x{}x{}",
                                 thing->volume.size.x, thing->volume.size.y, thing->volume.size.z,
                                 probe.size.x, probe.size.y, probe.size.z));
    }
    return {};
}

} // namespace cl
