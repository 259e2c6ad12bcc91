#pragma once

#include "servers/radiosity/links.h"
#include "servers/radiosity/transport.h"

#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace cl::radiosity {

/// What the light in the air is wanted for.
enum class AirUse : uint8_t {
    Gaps,  ///< pixels of still surfaces that find no patch: half the rays, and only beside surfaces
    Things ///< whatever moves or is transparent, and bent normals
};

/// Points in the free space of a probe's box at which light from all around is gathered: the centres of its
/// bricks of 4 x 4 x 4 cells.
struct AirPoints {
    glm::ivec3 dims{0};                ///< points, one a brick
    Links links;                       ///< a point each, x fastest; of points inside solids without rays
    std::vector<glm::vec3> directions; ///< of the rays, the same at each point: neighbours err alike
    std::vector<uint8_t> rays;         ///< which of them each link is, one for one with links.targets
    /// How far each point sees along the grid's axes before a surface [cells], at most kMaxReach: -x, +x, -y,
    /// +y, -z, +z. 0 for points without rays. What lies beyond is not lit by the point.
    std::vector<std::array<float, 6>> reach;
    static constexpr float kMaxReach = 7.75f;
    std::vector<uint32_t>
        stand_in; ///< for each point, the point whose light it shows: itself, or the nearest one with rays
};

/// The air of each probe of a transport. @param stop  give up with what there is as soon as it turns true
[[nodiscard]] std::vector<AirPoints> make_air(const Transport& transport, AirUse use,
                                              const std::atomic<bool>& stop);

} // namespace cl::radiosity
