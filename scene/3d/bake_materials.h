#pragma once

#include "scene/3d/bake_memory.h"
#include "scene/resources/material.h"

#include <memory>
#include <span>
#include <vector>

namespace cl::scene {

/// Captures of materials, made on all workers unless an earlier bake kept them.
class BakeMaterials {
public:
    /// @param materials  null: white
    /// @param kept       of earlier bakes; those of this one afterwards. null: none are, and no digests made
    BakeMaterials(std::span<const Material* const> materials, std::vector<KeptCapture>* kept);

    /// @param number  among the materials given
    [[nodiscard]] const gi::MaterialCapture& capture(size_t number) const { return *made_[number].capture; }
    [[nodiscard]] const Digest& digest(size_t number) const { return made_[number].digest; }

private:
    void take(std::span<const KeptCapture> kept);
    void capture_others(bool with_digests);

    std::vector<BakeMaterial> inputs_;
    std::vector<KeptCapture> made_; ///< one a material
};

} // namespace cl::scene
