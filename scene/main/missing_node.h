#pragma once

#include "scene/main/node.h"

#include <cstdint>
#include <memory>

namespace cl {
class ClassRegistry;
}

namespace cl::scene {

/// How a class that a scene file names is represented.
enum class NodeSupport : uint8_t {
    Full,    ///< it is one of ours
    StandIn, ///< a Godot 3.2 class that we do not have: the nearest of its bases that we have takes its place
    Unknown, ///< never heard of: a Spatial if it is given a transform, else a plain Node
};

/// Whether the file assigns a Transform to the node: tells what an unknown class is.
enum class TransformHint : uint8_t { None, HasTransform };

struct CreatedNode {
    std::unique_ptr<Node> node; ///< never null
    NodeSupport support = NodeSupport::Full;
};

/// Makes a node for a class name of a scene file. A stand-in keeps its class name and all properties for
/// saving, and moves, hides and groups what is below it; what else the class does is left out. The name of a
/// class that is no node gives a plain Node, as in Godot (spec tscn section 6).
[[nodiscard]] CreatedNode create_node(const ClassRegistry& registry, const StringName& class_name,
                                      TransformHint hint = TransformHint::None);

} // namespace cl::scene
