#pragma once

#include "servers/radiosity/emitters.h"
#include "servers/radiosity/links.h"
#include "servers/radiosity/patch_blocks.h"
#include "servers/radiosity/patches.h"
#include "servers/radiosity/ray_scene.h"
#include "servers/radiosity/still_scene.h"

#include "core/math/aabb.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

/// A record that is to be, with the rays traced so far.
struct RecordDraft {
    uint32_t patch = 0;
    int level = 0;
    RayFan fan;
    uint32_t rays = 0;    ///< it is to have in the end
    bool is_open = false; ///< nothing is before it but sky
};

/// Decides which patches are records, and looks around from there.
class RecordPlacer {
public:
    RecordPlacer(const RayScene& rays, const Patches& patches, const AABB& scene_bounds)
        : rays_(rays), patches_(patches), bounds_(scene_bounds) {}

    /// The records of all blocks, in order, with the few rays that placing them took.
    [[nodiscard]] std::vector<RecordDraft> place_all(std::span<const std::span<const Placed>> blocks) const;
    /// Traces the rays a record still lacks. @param share  of the full number
    /// @return what emitters send it
    [[nodiscard]] glm::vec3 finish(RecordDraft& draft, float share, const Emitters& emitters) const;

private:
    [[nodiscard]] float cell_m(uint32_t patch) const noexcept {
        return patches_.grids[patches_.grid[patch]].cells.cell_m;
    }
    void place(std::span<const Placed> run, int level, std::vector<RecordDraft>& out) const;
    void place_parts(std::span<const Placed> group, int level, std::vector<RecordDraft>& out) const;
    [[nodiscard]] bool is_open(uint32_t patch) const noexcept;
    [[nodiscard]] std::vector<std::vector<Placed>> facing_groups(std::span<const Placed> run) const;
    [[nodiscard]] uint32_t central_patch(std::span<const Placed> group) const noexcept;
    void trace(RecordDraft& draft, uint32_t from, uint32_t to) const;

    const RayScene& rays_;
    const Patches& patches_;
    AABB bounds_; ///< of the scene
};

/// Part of their full number of rays that records may have, so that all together keep to the budget.
[[nodiscard]] float ray_share(std::span<const RecordDraft> drafts) noexcept;

/// Where the rays of a patch begin in their sequence: differs between neighbours.
[[nodiscard]] glm::vec2 start_of(const Patches& patches, uint32_t patch) noexcept;

} // namespace cl::radiosity
