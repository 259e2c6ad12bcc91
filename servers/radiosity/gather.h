#pragma once

#include "servers/radiosity/lighting.h"
#include "servers/radiosity/rgb4.h"
#include "servers/radiosity/transport.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

// The loops of a solution that move most memory. Results do not depend on the number of threads.

/// Mean radiance that each record gets from the sky and from what shines by itself.
[[nodiscard]] std::vector<Rgb4> from_surroundings(const Transport& transport, const Lighting& lighting);

/// One more bounce, by way of patches: arriving = first + what the links gather.
/// @param leaving  radiance that each patch sends on
/// @param arriving  may be `first`
void add_bounce(const Transport& transport, std::span<const Rgb4> leaving, std::span<const Rgb4> first,
                std::span<Rgb4> arriving);

/// What a record gets of the light that all have by one more bounce, by way of the exchanges.
[[nodiscard]] inline Rgb4 exchanged(const Transport& transport, std::span<const Rgb4> now,
                                    size_t record) noexcept {
    Rgb4 sum{};
    for (uint32_t e = transport.exchange_first[record]; e < transport.exchange_first[record + 1]; ++e) {
        const Transport::Exchange& x = transport.exchanges[e];
        sum += rgb4(x.albedo) * now[x.record];
    }
    return sum;
}

/// What the records have, interpolated at a patch.
/// @param detail  what interpolation blurs (Records::emitted_detail); empty: nothing
[[nodiscard]] inline Rgb4 at_patch(const Transport& transport, std::span<const Rgb4> at_records,
                                   std::span<const glm::vec3> detail, size_t patch) noexcept {
    Rgb4 sum = detail.empty() ? Rgb4{} : rgb4(detail[patch]);
    for (const Records::Share& s : transport.records.of_patch(uint32_t(patch))) {
        sum += gi::splat(s.weight) * at_records[s.record];
    }
    return sum;
}

/// Radiance of each sky bin.
[[nodiscard]] std::vector<Rgb4> sky_lanes(const Lighting& lighting);

} // namespace cl::radiosity
