#pragma once

#include "servers/radiosity/patches.h"
#include "servers/radiosity/polygon.h"
#include "servers/radiosity/ray_scene.h"
#include "servers/radiosity/still_scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace cl::radiosity {

/// All that shines by itself, cut at the cells and gathered in a tree: from afar a branch counts as one
/// point, from nearby each piece as the polygon that it is. Source: Walter et al. 2005 ("Lightcuts"), with a
/// bound on angles instead of errors; Lambert's form factor of a polygon (Baum, Rushmeier and Winget 1989,
/// eq. 13).
class EmitterTree {
public:
    /// @param patches  for their grids
    EmitterTree(const StillScene& scene, const Patches& patches);
    /// True if nothing shines, or so much does that its light is smooth and looking at it piece by piece
    /// would take longer than all else.
    [[nodiscard]] bool empty() const noexcept { return nodes_.empty(); }

    /// Mean radiance over the cosine-weighted hemisphere that a point of a surface gets straight from
    /// emitters; shadows by rays.
    /// @param lift_m  how far off surfaces rays begin and end
    /// @param start  differs between neighbours, 0..1: shadows of large emitters get grain instead of bands
    [[nodiscard]] glm::vec3 light_at(const RayScene& rays, const glm::vec3& position, const glm::vec3& normal,
                                     float lift_m, float start) const noexcept;

private:
    struct Piece {
        Polygon outline; ///< [m]
        glm::vec3 centroid, normal, emission;
        float area_m2 = 0.0f;
    };
    /// Pieces [first, first + count) that face about one way; its children follow it, the second at `second`.
    struct Node {
        glm::vec3 centroid{0.0f},
            normal{0.0f};      ///< means, weighted by area; `normal` shorter where they differ
        glm::vec3 power{0.0f}; ///< sum of emission times area
        float radius_m = 0.0f;
        uint32_t first = 0, count = 0, second = 0;
    };
    struct Receiver;

    void add_pieces(const StillScene& scene, const Patches& patches);
    void build(uint32_t first, uint32_t count);
    [[nodiscard]] glm::vec3 from_afar(const Receiver& at, const Node& node) const noexcept;
    [[nodiscard]] static glm::vec3 from_nearby(const Receiver& at, const Piece& piece) noexcept;

    std::vector<Piece> pieces_;
    std::vector<float> light_before_; ///< sum over the pieces before each, and over all
    std::vector<Node> nodes_;
    std::vector<uint32_t> roots_;
};

} // namespace cl::radiosity
