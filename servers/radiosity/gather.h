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

/// How many of a point's links are read: all for what is seen, some for what only feeds later bounces.
enum class Detail : uint8_t { All, Some };

/// Mean radiance that the rays of each record meet, and what emitters send it.
/// @param leaving  radiance that each patch sends on, without its emission
[[nodiscard]] std::vector<glm::vec3> gather_records(const Transport& transport, const Lighting& lighting,
                                                    std::span<const glm::vec3> leaving, Detail detail);

/// One more bounce at all records: next = first + exchange * now. The fourth lane is not used.
/// @param next  one a record; must not alias `now`
void step_bounce(const Transport& transport, std::span<const glm::vec3> first,
                 std::span<const gi::float4> now, std::span<gi::float4> next);

/// What the records have, interpolated at each patch.
[[nodiscard]] std::vector<glm::vec3> at_patches(const Transport& transport,
                                                std::span<const glm::vec3> at_records);

} // namespace cl::radiosity
