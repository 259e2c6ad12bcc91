#pragma once

namespace cl {
class ClassRegistry;
}

namespace cl::scene {

/// Registers every class of the scene layer, nodes and resources. Calls register_core_types() first; calling
/// it twice is fine.
void register_scene_types(ClassRegistry& registry);

} // namespace cl::scene
