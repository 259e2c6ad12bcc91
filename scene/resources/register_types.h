#pragma once

namespace cl {
class ClassRegistry;
}

namespace cl::scene {

/// Registers the resource classes of the scene layer. Needs register_core_types() first; calling it twice is
/// fine.
void register_resource_types(ClassRegistry& registry);

} // namespace cl::scene
