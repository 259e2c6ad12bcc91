#include "servers/probe/probe_light.h"

#include <array>
#include <string_view>
#include <utility>

namespace cl {
namespace {

constexpr std::array<std::pair<ProbeCause, std::string_view>, 14> kCauseNames{{
    {ProbeCause::NeverLit, "never lit"},
    {ProbeCause::PropagationChanged, "propagation changed"},
    {ProbeCause::DynamicRangeChanged, "dynamic range changed"},
    {ProbeCause::ProbeMoved, "probe moved"},
    {ProbeCause::LightAdded, "light added"},
    {ProbeCause::LightRemoved, "light removed"},
    {ProbeCause::LightHidden, "light hidden"},
    {ProbeCause::LightShown, "light shown"},
    {ProbeCause::LightRemoded, "light re-moded"},
    {ProbeCause::LightRetyped, "light re-typed"},
    {ProbeCause::LightMoved, "light moved"},
    {ProbeCause::LightRecoloured, "light recoloured"},
    {ProbeCause::LightReenergised, "light re-energised"},
    {ProbeCause::LightReshaped, "light reshaped"},
}};

bool is_lit(const ProbeLight* light) noexcept {
    return light && light->presence == LightPresence::Lit;
}

/// Why a light is lit now that was not, or the other way round. @param unlit  null: not a candidate
ProbeCause cause_of_turning(const ProbeLight* unlit, bool on) noexcept {
    if (!unlit) {
        return on ? ProbeCause::LightAdded : ProbeCause::LightRemoved;
    }
    if (unlit->presence == LightPresence::BakeDisabled) {
        return ProbeCause::LightRemoded;
    }
    return on ? ProbeCause::LightShown : ProbeCause::LightHidden;
}

ProbeCauses causes_between(const ProbeLight& before, const ProbeLight& now) {
    const gi::CachedLight &a = before.light, &b = now.light;
    ProbeCauses causes;
    if (a.type != b.type) {
        causes.add(ProbeCause::LightRetyped);
    }
    if (!(before.world_from_light == now.world_from_light)) {
        causes.add(ProbeCause::LightMoved);
    } else if (!(a.cells_from_light == b.cells_from_light)) {
        causes.add(ProbeCause::ProbeMoved);
    }
    if (a.color != b.color) {
        causes.add(ProbeCause::LightRecoloured);
    }
    if (a.energy != b.energy) {
        causes.add(ProbeCause::LightReenergised);
    }
    if (a.range_m != b.range_m || a.attenuation != b.attenuation || a.spot_angle_deg != b.spot_angle_deg ||
        a.spot_attenuation != b.spot_attenuation) {
        causes.add(ProbeCause::LightReshaped);
    }
    return causes;
}

/// Adds what became of one light. Either may be null: not a candidate then.
void compare_light(const ProbeLight* before, const ProbeLight* now, LightChanges& changes) {
    if (is_lit(before) && is_lit(now)) {
        if (before->light == now->light) {
            return; // also when light and probe moved together: the cells see no difference
        }
        changes.causes |= causes_between(*before, *now);
        changes.edits.push_back({before->light, -1});
        changes.edits.push_back({now->light, +1});
    } else if (is_lit(before)) {
        changes.causes.add(cause_of_turning(now, false));
        changes.edits.push_back({before->light, -1});
    } else if (is_lit(now)) {
        changes.causes.add(cause_of_turning(before, true));
        changes.edits.push_back({now->light, +1});
    }
}

} // namespace

std::string ProbeCauses::to_string() const {
    std::string text;
    for (const auto& entry : kCauseNames) {
        if (has(entry.first)) {
            text += text.empty() ? "" : ", ";
            text += entry.second;
        }
    }
    return text;
}

ProbeLight make_probe_light(RID key, const LightDesc& desc, bool visible, const Transform& world_from_light,
                            const Transform& cells_from_world) {
    ProbeLight result;
    result.key = key;
    result.world_from_light = world_from_light;
    if (desc.bake_mode == LightBakeMode::Disabled) {
        result.presence = LightPresence::BakeDisabled;
    } else if (!visible) {
        result.presence = LightPresence::Hidden;
    }
    gi::CachedLight& light = result.light;
    light.type = desc.type;
    light.cells_from_light = cells_from_world * world_from_light;
    light.color = desc.color.rgb();
    light.energy = desc.energy * desc.indirect_energy;
    light.visible = result.presence == LightPresence::Lit;
    // A parameter that the type lacks keeps its default: changing it is no change.
    if (desc.type != LightType::Directional) {
        light.range_m = desc.range_m;
        light.attenuation = desc.attenuation;
    }
    if (desc.type == LightType::Spot) {
        light.spot_angle_deg = desc.spot_angle_deg;
        light.spot_attenuation = desc.spot_angle_attenuation;
    }
    return result;
}

LightChanges compare_lights(std::span<const ProbeLight> before, std::span<const ProbeLight> now) {
    LightChanges changes;
    size_t b = 0, n = 0;
    while (b < before.size() || n < now.size()) {
        const bool old_first = n == now.size() || (b < before.size() && before[b].key <= now[n].key);
        const bool new_first = b == before.size() || (n < now.size() && now[n].key <= before[b].key);
        const ProbeLight* old = old_first ? &before[b] : nullptr;
        const ProbeLight* fresh = new_first ? &now[n] : nullptr;
        compare_light(old, fresh, changes);
        b += old ? 1 : 0;
        n += fresh ? 1 : 0;
    }
    return changes;
}

} // namespace cl
