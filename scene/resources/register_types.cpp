#include "scene/resources/register_types.h"

#include "scene/resources/array_mesh.h"
#include "scene/resources/environment.h"
#include "scene/resources/gi_probe_data.h"
#include "scene/resources/material.h"
#include "scene/resources/missing_resource.h"
#include "scene/resources/packed_scene.h"
#include "scene/resources/primitive_meshes.h"
#include "scene/resources/sky.h"
#include "scene/resources/spatial_material.h"
#include "scene/resources/texture.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void register_resource_types(ClassRegistry& registry) {
    registry.add<MissingResource, Resource>();

    registry.add<Material, Resource>();
    registry.add<SpatialMaterial, Material>();
    registry.add<ShaderMaterial, Material>();

    registry.add<Mesh, Resource>();
    registry.add<ArrayMesh, Mesh>();
    registry.add<PrimitiveMesh, Mesh>();
    registry.add<CubeMesh, PrimitiveMesh>();
    registry.add<SphereMesh, PrimitiveMesh>();
    registry.add<PlaneMesh, PrimitiveMesh>();
    registry.add<QuadMesh, PrimitiveMesh>();
    registry.add<PrismMesh, PrimitiveMesh>();
    registry.add<CylinderMesh, PrimitiveMesh>();
    registry.add<CapsuleMesh, PrimitiveMesh>();

    registry.add<ImageResource, Resource>();
    registry.add<Texture, Resource>();
    registry.add<ImageTexture, Texture>();
    registry.add<StreamTexture, Texture>();

    registry.add<Sky, Resource>();
    registry.add<PanoramaSky, Sky>();
    registry.add<ProceduralSky, Sky>();
    registry.add<Environment, Resource>();

    registry.add<GIProbeData, Resource>();
    registry.add<PackedScene, Resource>();
}

} // namespace cl::scene
