#include "servers/radiosity/light_parts.h"

#include <algorithm>
#include <utility>

namespace cl::radiosity {
namespace {

bool is_dark(const Lighting& lighting) {
    return std::all_of(lighting.sky.begin(), lighting.sky.end(),
                       [](const glm::vec3& radiance) { return radiance == glm::vec3(0.0f); });
}

} // namespace

std::vector<LightPart> parts_of(const Lighting& lighting, Emission emission) {
    std::vector<LightPart> parts;
    LightPart others;
    if (emission == Emission::Some || !is_dark(lighting)) {
        LightPart surroundings{{{}, lighting.sky, lighting.interior}, {}};
        if (lighting.sky_steady) {
            parts.push_back(std::move(surroundings));
        } else {
            others = std::move(surroundings);
        }
    }
    for (size_t i = 0; i < lighting.sources.size(); ++i) {
        const Source& source = lighting.sources[i];
        if (source.steady && i < kMostLampsApart) {
            parts.push_back({{{source.unit()}, {}, {}}, {i}, source.radiance});
        } else {
            others.of.sources.push_back(source);
            others.of.sources.back().steady = true; // how it came here changes nothing
            others.lamps.push_back(i);
        }
    }
    if (!others.of.sources.empty() || !others.of.sky.empty()) {
        parts.push_back(std::move(others));
    }
    return parts;
}

} // namespace cl::radiosity
