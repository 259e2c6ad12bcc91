#pragma once

#include "servers/mesh_surface.h"
#include "servers/render_types.h"

#include "core/expected.h"
#include "core/image.h"
#include "core/rid.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cl {

// What a backend must do, and all that the VisualServer knows of one. It makes sense without opening
// drivers/. The server owns everything with a meaning (instances, lights, materials, cameras, probes' state);
// a rasteriser owns only what lives near the hardware (textures, vertex data, volumes, targets) and draws one
// Frame at a time.

struct RasterizerInfo {
    std::string driver;        ///< "osmesa", "egl", "window", "dummy"
    std::string renderer;      ///< what the driver calls itself: "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string api_version;   ///< "OpenGL ES 3.2 Mesa 22.3.6"
    bool draws_on_cpu = false; ///< on all its cores, that is
};

enum class TextureColorSpace : uint8_t { Linear, Srgb };

struct TextureParams {
    bool mipmaps = true;
    bool repeat = true;
    bool mirrored_repeat = false;
    bool filter = true;
};

/// Who looks into a volume: cones of GI probes, or reflections of a GI field.
enum class GIVolumeUse : uint8_t { Cones, Reflections };

struct GIVolumeDesc {
    glm::ivec3 size{0}; ///< mip 0 [cells], powers of two
    int mip_count = 1;
    GIVolumeUse use = GIVolumeUse::Cones;
};

/// A scenario's light as patches of surface and points of air in its probes receive it
/// (servers/radiosity/field_map.h has the layout of the words).
struct GIFieldDesc {
    std::span<const uint32_t> brick_words; ///< four a brick
    std::span<const uint32_t> joints;      ///< two a slot
    glm::ivec3 air{0};                     ///< texels of the air's light
};

/// One surface to draw.
struct DrawItem {
    RID mesh;
    int surface = 0;
    const MaterialDesc* material = nullptr; ///< never null; lives as long as the Frame
    Transform world_from_local;
    bool mirrored = false;             ///< negative determinant: front faces turn the other way
    bool receives_baked_light = false; ///< use_in_baked_light: GI biases apply (spec gi-shading section 2)
    std::array<int16_t, 2> gi_probes{-1, -1}; ///< into Frame::gi_probes, first and second; -1 = none
    uint16_t omni_count = 0, spot_count = 0;
    std::array<uint16_t, 8> omnis{}, spots{}; ///< into Frame::lights
    uint16_t directional_mask = 0xFFFFu;      ///< bit i: directional light i of the frame lights this item
    bool is_still = false;     ///< its surface is in the GI fields; else it is lit by the air's light
    float view_depth_m = 0.0f; ///< of the instance's origin, for sorting
};

/// One surface in a shadow map.
struct CasterItem {
    RID mesh;
    int surface = 0;
    const MaterialDesc* material = nullptr;
    Transform world_from_local;
    AABB world_bounds;
    bool mirrored = false;
    bool double_sided = false;
    uint64_t version = 0; ///< changes when the item would cast another shadow
};

/// One surface as it stands in the world, in view or not.
struct WorldItem {
    RID mesh;
    int surface = 0;
    const MaterialDesc* material = nullptr; ///< never null; lives as long as the Frame
    Transform world_from_local;
    bool mirrored = false; ///< as in DrawItem
    uint32_t layers = 1;   ///< for the cull masks of camera and lights
    ShadowCasting casting = ShadowCasting::On;
};

struct LightItem {
    RID key; ///< the light's instance: stable between frames, for caches
    const LightDesc* desc = nullptr;
    Transform world_from_light;          ///< orthonormal
    std::span<const CasterItem> casters; ///< empty unless desc->shadow
    uint64_t casters_version = 0; ///< equal to last frame's: the shadow map may be kept (omni and spot)
};

inline constexpr int kMaxDirectionalLights = 16; ///< spec scene-classes section 8

/// What a rasteriser wants in its Frames.
enum class FrameContents : uint8_t {
    InView,     ///< sorted items in the camera's view, what lights them, their casters and GI probes
    WholeScene, ///< every surface (Frame::world) and every light: for backends that follow light themselves
};

/// All that one picture needs. Pointers and spans live until draw() returns.
struct Frame {
    glm::ivec2 size{0};
    CameraDesc camera;
    EnvironmentDesc environment;
    bool has_environment = false; ///< false: clear colour as background and ambient, no tone mapping
    Color clear_color{0.3f, 0.3f, 0.3f, 1.0f};
    std::span<const DrawItem> opaque;      ///< sorted for early depth rejection and few state changes
    std::span<const DrawItem> transparent; ///< sorted by priority, then back to front
    std::span<const LightItem> lights;     ///< directional ones first
    int directional_count = 0;             ///< at most kMaxDirectionalLights
    std::span<const WorldItem>
        world;           ///< WholeScene only, which has no opaque, transparent, casters, gi_probes
    AABB casters_bounds; ///< world bounds of what casts directional shadows
    std::span<const GIProbeShading> gi_probes;
    GIMode gi_mode = GIMode::Cones;
    Quality quality = Quality::High;
    int shadow_filter = 1; ///< 0 nearest, 1 PCF5, 2 PCF13 (project setting)
    ShadowFit shadow_fit = ShadowFit::AsSet;
    int shadow_atlas_size = 4096, directional_shadow_size = 4096; ///< [texels] (project settings)
};

enum class TargetFormat : uint8_t {
    Srgb8,       ///< RGBA8 after tone mapping, sRGB-encoded, as shown
    LinearFloat, ///< RGBF scene radiance before exposure and tone mapping
};

struct FrameStats {
    int draw_calls = 0;
    int64_t triangles = 0;
    double gpu_ms = 0.0; ///< wall time of the draw until its pixels were done
    int64_t rays = 0;    ///< followed through the scene, by backends that do
};

class Rasterizer {
public:
    virtual ~Rasterizer() = default;
    [[nodiscard]] virtual RasterizerInfo info() const = 0;
    /// What draw() is to be given. GI probes do no work for a backend that wants the whole scene.
    [[nodiscard]] virtual FrameContents frame_contents() const { return FrameContents::InView; }

    /// Uploads an image (8 bit or float). `space` says whether 8-bit texels of three or four channels are
    /// decoded from sRGB on sampling; those of one or two never are, as in Godot.
    /// @return Unsupported if the size is beyond the driver's limit.
    virtual Expected<RID> texture_create(const Image& image, const TextureParams& params,
                                         TextureColorSpace space) = 0;
    /// Uploads a mesh's surfaces; each must pass validate_surface().
    virtual Expected<RID> mesh_create(std::span<const MeshSurface> surfaces) = 0;
    /// Prepares a sky: panorama, irradiance and roughness-filtered radiance (spec scene-classes
    /// section 14.4).
    virtual Expected<RID> sky_create(const SkyDesc& sky) = 0;
    /// RGBA8 3D texture with mips, all texels 0 (so that a probe without light yet is black, not undefined).
    virtual Expected<RID> gi_volume_create(const GIVolumeDesc& desc) = 0;
    /// Replaces a box of one mip level. `rgba8`: size.x * size.y * size.z * 4 bytes, x fastest, then y, then
    /// z.
    virtual Status gi_volume_upload(RID volume, int mip, glm::ivec3 offset, glm::ivec3 size,
                                    std::span<const uint8_t> rgba8) = 0;
    /// A field, dark until it is filled. InvalidArgument if the words do not fit together.
    virtual Expected<RID> gi_field_create(const GIFieldDesc& desc) = 0;
    /// Replaces all light of a field. @param light  a shared-exponent RGB word (9, 9, 9, 5 bits) a slot
    /// @param air  RGBA half floats, x fastest, then y, then z
    virtual Status gi_field_upload(RID field, std::span<const uint32_t> light,
                                   std::span<const uint16_t> air) = 0;
    virtual Expected<RID> target_create(glm::ivec2 size) = 0;
    /// Frees any of the above. InvalidArgument if the RID is stale.
    virtual Status free(RID rid) = 0;

    /// Draws one frame into a target (0 RID: the window, where the context has one).
    virtual Status draw(RID target, const Frame& frame) = 0;
    virtual Expected<Image> target_read(RID target, TargetFormat format) = 0;
    [[nodiscard]] virtual FrameStats last_stats() const = 0;
    /// Shows the last frame drawn to the window; no effect off screen.
    virtual void present() {}
};

} // namespace cl
