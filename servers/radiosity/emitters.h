#pragma once

#include "servers/radiosity/links.h"
#include "servers/radiosity/patches.h"
#include "servers/radiosity/ray_scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cl::radiosity {

/// The patches that shine by themselves, to be chosen from by the light they send out. A small lamp far away
/// is met by few of a record's rays; points chosen on it find it for sure.
class Emitters {
public:
    explicit Emitters(const Patches& patches);
    [[nodiscard]] bool empty() const noexcept { return patch_.empty(); }

    /// Mean radiance that a point of a surface gets from all emitters: its own rays that met some, and points
    /// on emitters that it sees, each weighted by how well it finds them (balance heuristic, Veach
    /// 1997, 9.2.2).
    /// @param fan    cosine-distributed rays from `origin`
    /// @param start  differs between neighbours, 0..1
    [[nodiscard]] glm::vec3 light_at(const Patches& patches, const RayScene& rays, const glm::vec3& origin,
                                     const glm::vec3& normal, const RayFan& fan, float start) const noexcept;

private:
    static constexpr size_t kPoints = 64; ///< chosen per gather point
    std::vector<uint32_t> patch_;         ///< emitters, each surface once
    std::vector<float> cumulative_;       ///< of the shares of light of `patch_`, ending at 1
    std::vector<float> density_;          ///< of all patches [1/m^2]; 0 where none is chosen
};

} // namespace cl::radiosity
