#include "scene/register_types.h"

#include "scene/3d/camera.h"
#include "scene/3d/directional_light.h"
#include "scene/3d/geometry_instance.h"
#include "scene/3d/gi_probe.h"
#include "scene/3d/light.h"
#include "scene/3d/mesh_instance.h"
#include "scene/3d/omni_light.h"
#include "scene/3d/spatial.h"
#include "scene/3d/spot_light.h"
#include "scene/3d/visual_instance.h"
#include "scene/3d/world_environment.h"
#include "scene/main/node.h"
#include "scene/main/script_instance.h"
#include "scene/resources/register_types.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void register_scene_types(ClassRegistry& registry) {
    register_core_types(registry);
    register_resource_types(registry);
    registry.add<ScriptInstance, Object>();
    registry.add<Node, Object>();
    registry.add<Spatial, Node>();
    registry.add<VisualInstance, Spatial>();
    registry.add<GeometryInstance, VisualInstance>();
    registry.add<MeshInstance, GeometryInstance>();
    registry.add<Camera, Spatial>();
    registry.add<Light, VisualInstance>();
    registry.add<DirectionalLight, Light>();
    registry.add<OmniLight, Light>();
    registry.add<SpotLight, Light>();
    registry.add<GIProbe, VisualInstance>();
    registry.add<WorldEnvironment, Node>();
}

} // namespace cl::scene
