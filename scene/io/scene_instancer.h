#pragma once

#include "scene/resources/packed_scene.h"

#include "core/diagnostics.h"
#include "core/expected.h"

#include <cstddef>
#include <memory>

namespace cl::scene {

class Node;

/// What instances within instances share: an input must not make more nodes than fit.
struct InstancingBudget {
    size_t nodes_left = 1u << 20;
    int depth_left = 64; ///< scenes inside scenes
};

/// Makes the nodes of a scene: see PackedScene::instance().
[[nodiscard]] Expected<std::unique_ptr<Node>>
instance_scene(const PackedScene& scene, Diagnostics& diagnostics, InstancingBudget& budget);

} // namespace cl::scene
