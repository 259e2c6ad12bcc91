#pragma once

#include "servers/gi/float4.h"
#include "servers/radiosity/solver.h"
#include "servers/radiosity/transport.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

// The loops of a solution that move most memory. Results do not depend on the number of threads.

// Colours have four lanes there, of which the last is not used: a sum is one addition, a read one load.
using Rgb4 = gi::float4;
[[nodiscard]] inline Rgb4 rgb4(const glm::vec3& v) noexcept {
    return Rgb4{v.x, v.y, v.z, 0.0f};
}
[[nodiscard]] inline glm::vec3 rgb(const Rgb4& v) noexcept {
    return {v[0], v[1], v[2]};
}

/// Mean radiance that the rays of each record meet, and what emitters send it.
/// @param leaving  radiance that each patch sends on, without its emission
[[nodiscard]] std::vector<Rgb4> gather_records(const Transport& transport, const Lighting& lighting,
                                               std::span<const Rgb4> leaving);

/// One more bounce, by way of patches: arriving = first + what the links gather.
/// @param leaving  radiance that each patch sends on of light that has bounced
void add_bounce(const Transport& transport, std::span<const Rgb4> leaving, std::span<const Rgb4> first,
                std::span<Rgb4> arriving);

/// One more bounce at all records: next = first + exchange * now.
/// @param next  one a record; must not alias `now`
void step_bounce(const Transport& transport, std::span<const Rgb4> first, std::span<const Rgb4> now,
                 std::span<Rgb4> next);

/// What the records have, interpolated at each patch.
[[nodiscard]] std::vector<Rgb4> at_patches(const Transport& transport, std::span<const Rgb4> at_records);

/// Radiance of each sky bin.
[[nodiscard]] std::vector<Rgb4> sky_lanes(const Lighting& lighting);

} // namespace cl::radiosity
