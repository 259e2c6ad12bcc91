#pragma once

#include "servers/radiosity/patches.h"
#include "servers/radiosity/ray_scene.h"
#include "servers/radiosity/records.h"
#include "servers/radiosity/still_scene.h"

#include "core/expected.h"
#include "core/math/aabb.h"

#include <atomic>
#include <memory>
#include <vector>

namespace cl::radiosity {

/// Where light goes in a still scene, whatever the lights: patches, and for the records among them where
/// their rays end. Made once, read by any thread.
struct Transport {
    std::shared_ptr<const StillScene> scene;
    RayScene rays;
    Patches patches;
    Records records;
    size_t probe_count = 0; ///< the first grids are the probes', the others surround them

    /// Light that a record gets from another one's surroundings: the sums of its links' albedos, which stand
    /// for every bounce after the first. A record has those in [first, next record's first).
    struct Exchange {
        glm::vec3 albedo; ///< sum over links / rays
        uint32_t record;
    };
    std::vector<uint32_t> exchange_first;
    std::vector<Exchange> exchanges;

    [[nodiscard]] size_t bytes() const noexcept;
};

/// A probe's box.
struct ProbeBox {
    Transform world_from_probe; ///< orthonormal
    AABB box;                   ///< [m]
    int cells = 128;            ///< of its grid along the longest axis, with kProbeMargin at either end
};

/// Cells of a probe's grid that stand out of its box at either end: there its light fades to plain ambient
/// light, so that all that the box holds has it in full.
inline constexpr int kProbeMargin = 4;

/// @param stop  give up as soon as it turns true. @return Cancelled, or what Embree says.
[[nodiscard]] Expected<std::shared_ptr<const Transport>>
make_transport(const std::shared_ptr<const StillScene>& scene, std::span<const ProbeBox> probes,
               const std::atomic<bool>& stop);

} // namespace cl::radiosity
