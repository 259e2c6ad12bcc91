#pragma once

#include "servers/radiosity/lighting.h"
#include "servers/radiosity/rgb4.h"
#include "servers/radiosity/transport.h"

#include <cstddef>
#include <span>
#include <vector>

namespace cl::radiosity {

/// What a source of radiance 1 sends to each patch: falloff times cosine, 0 in shadow, by a ray each.
[[nodiscard]] std::vector<float> unit_light(const Transport& transport, const Source& source);

/// Light straight from sources at the patches, as a sum that is worked out where it is needed.
struct DirectLight {
    struct Lamp {
        Rgb4 radiance;
        std::span<const float> unit; ///< unit_light()
    };
    std::span<const Rgb4> rest; ///< light of further sources, one a patch; empty: none
    std::vector<Lamp> lamps;

    /// In the order of the members: the same numbers whoever asks.
    [[nodiscard]] Rgb4 at(size_t patch) const noexcept {
        Rgb4 sum = rest.empty() ? Rgb4{} : rest[patch];
        for (const Lamp& lamp : lamps) {
            sum += lamp.radiance * gi::splat(lamp.unit[patch]);
        }
        return sum;
    }
    [[nodiscard]] bool empty() const noexcept { return rest.empty() && lamps.empty(); }
};

} // namespace cl::radiosity
