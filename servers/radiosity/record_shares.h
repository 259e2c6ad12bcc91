#pragma once

#include "servers/radiosity/patch_blocks.h"
#include "servers/radiosity/ray_scene.h"
#include "servers/radiosity/records.h"

#include <span>
#include <vector>

namespace cl::radiosity {

/// Weights of the records that each patch interpolates: at most 8 that it sees, adding up to 1. Empty where
/// it sees none.
/// @param records  their places and spacing are read
/// @param blocks   all patches
[[nodiscard]] std::vector<std::vector<Records::Share>>
find_shares(const RayScene& rays, const Patches& patches, const Records& records,
            std::span<const std::span<const Placed>> blocks);

} // namespace cl::radiosity
