#pragma once

#include "drivers/gles3/gi_field_storage.h"
#include "drivers/gles3/gi_volume_storage.h"
#include "drivers/gles3/gl/vertex_array.h"
#include "drivers/gles3/mesh_storage.h"
#include "drivers/gles3/sky_storage.h"
#include "drivers/gles3/texture_storage.h"

namespace cl::gles3 {

/// What passes read: the storages behind RIDs. Borrowed for the length of a frame.
struct Resources {
    const TextureStorage& textures;
    const MeshStorage& meshes;
    GIVolumeStorage& volumes; ///< makes textures when asked for them
    const GIFieldStorage& fields;
    const SkyStorage& skies;
    const gl::VertexArray& no_vertices; ///< for fullscreen draws
};

} // namespace cl::gles3
