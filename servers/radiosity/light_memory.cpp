#include "servers/radiosity/light_memory.h"

#include "servers/radiosity/bounces.h"
#include "servers/radiosity/for_all.h"
#include "servers/radiosity/gather.h"

#include <algorithm>

namespace cl::radiosity {
namespace {

std::vector<Rgb4> sum_of(const Transport& t, std::span<const Source> sources) {
    std::vector<Rgb4> sum(t.patches.size(), Rgb4{});
    for (const Source& source : sources) {
        const std::vector<float> unit = unit_light(t, source);
        const Rgb4 radiance = rgb4(source.radiance);
        for_all(sum.size(), [&](size_t p) { sum[p] += radiance * gi::splat(unit[p]); });
    }
    return sum;
}

/// All bounces of a part's light.
/// @param direct  of the part
LightMemory::Bounced bounce(const Transport& t, const Lighting& part, const DirectLight& direct,
                            const std::atomic<bool>& stop) {
    const bool has_surroundings = !part.sky.empty();
    std::vector<Rgb4> first =
        has_surroundings ? from_surroundings(t, part) : std::vector<Rgb4>(t.records.patch.size(), Rgb4{});
    std::vector<Rgb4> leaving(t.patches.size());
    if (!direct.empty()) {
        for_all(leaving.size(), [&](size_t p) { leaving[p] = rgb4(t.patches.albedo[p]) * direct.at(p); });
        add_bounce(t, leaving, first, first);
    }
    LightMemory::Bounced out;
    out.steps = sum_bounces(t, first, stop, out.arriving);
    // The last bounce again, from patches instead of records: what is seen has the detail.
    const std::span<const glm::vec3> detail =
        has_surroundings ? t.records.emitted_detail : std::span<const glm::vec3>{};
    for_all(leaving.size(),
            [&](size_t p) { leaving[p] = rgb4(t.patches.albedo[p]) * at_patch(t, out.arriving, detail, p); });
    add_bounce(t, leaving, first, out.arriving);
    return out;
}

/// What of the light of all sources is a part's.
DirectLight only(const DirectLight& all, const LightPart& part) {
    DirectLight light;
    for (size_t i = 0; i < part.lamps.size(); ++i) {
        if (part.lamps[i] < all.lamps.size()) {
            light.lamps.push_back({rgb4(part.of.sources[i].radiance), all.lamps[part.lamps[i]].unit});
        } else {
            light.rest = all.rest;
        }
    }
    return light;
}

} // namespace

DirectLight LightMemory::direct(const Transport& t, std::span<const Source> sources) {
    DirectLight light;
    const size_t kept = std::min(sources.size(), kMostKept);
    for (const Source& source : sources.first(kept)) {
        const Source unit = source.unit();
        light.lamps.push_back(
            {rgb4(source.radiance), unit_lights_.get(unit, [&] { return unit_light(t, unit); })});
    }
    if (sources.size() > kept) {
        std::vector<Source> others(sources.begin() + ptrdiff_t(kept), sources.end());
        for (Source& source : others) {
            source.steady = true; // changes nothing here
        }
        light.rest = rest_.get(others, [&] { return sum_of(t, others); });
    }
    unit_lights_.forget_others();
    rest_.forget_others();
    return light;
}

LightMemory::Bounced LightMemory::bounced(const Transport& t, const Lighting& lighting,
                                          const DirectLight& direct, const std::atomic<bool>& stop) {
    struct Term {
        Rgb4 weight;
        std::span<const Rgb4> arriving;
    };
    const Emission emission = t.records.emitted_detail.empty() ? Emission::None : Emission::Some;
    std::vector<Term> terms;
    Bounced sum;
    for (const LightPart& part : parts_of(lighting, emission)) {
        if (part.weight == glm::vec3(0.0f)) {
            static_cast<void>(parts_.find(part.of)); // stays for when the lamp is switched on again
            continue;
        }
        const Bounced& one =
            parts_.get(part.of, [&] { return bounce(t, part.of, only(direct, part), stop); });
        terms.push_back({rgb4(part.weight), one.arriving});
        sum.steps = std::max(sum.steps, one.steps);
        if (stop) {
            parts_.clear();
            return {};
        }
    }
    parts_.forget_others();
    sum.arriving.resize(t.records.patch.size());
    for_all(sum.arriving.size(), [&](size_t r) {
        Rgb4 light{};
        for (const Term& term : terms) {
            light += term.weight * term.arriving[r];
        }
        sum.arriving[r] = light;
    });
    return sum;
}

} // namespace cl::radiosity
