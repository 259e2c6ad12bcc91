#pragma once

#include <cstdint>

namespace cl {

/// Kinds of RID that the VisualServer hands out; an owner of one kind refuses the RIDs of another.
/// The rasteriser's RIDs are another family: they never leave the server.
enum class RIDKind : uint32_t {
    Texture = 1,
    Material,
    Mesh,
    Light,
    Sky,
    Environment,
    Camera,
    GIProbe,
    Scenario,
    Instance,
    Viewport,
};

} // namespace cl
