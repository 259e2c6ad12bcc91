#pragma once

#include "servers/rasterizer.h"
#include "servers/visual/gi_probe_storage.h"
#include "servers/visual/material_storage.h"
#include "servers/visual/mesh_storage.h"
#include "servers/visual/rid_kinds.h"
#include "servers/visual/sky_storage.h"
#include "servers/visual/texture_storage.h"
#include "servers/visual/version_clock.h"

#include "core/rid.h"

namespace cl {

struct Light {
    LightDesc desc;
    uint64_t version = 0;
};

/// Everything that can be shown, by kind, before it stands anywhere.
struct Storage {
    explicit Storage(Rasterizer& rasterizer);

    VersionClock clock;
    TextureStorage textures;
    MaterialStorage materials;
    MeshStorage meshes;
    SkyStorage skies;
    RID_Owner<Light> lights{static_cast<uint32_t>(RIDKind::Light)};
    RID_Owner<EnvironmentDesc> environments{static_cast<uint32_t>(RIDKind::Environment)};
    RID_Owner<CameraDesc> cameras{static_cast<uint32_t>(RIDKind::Camera)};
    RID_Owner<GIProbe> gi_probes{static_cast<uint32_t>(RIDKind::GIProbe)};
};

inline Storage::Storage(Rasterizer& rasterizer)
    : textures(rasterizer), materials(textures, clock), meshes(rasterizer, clock), skies(rasterizer) {}

} // namespace cl
