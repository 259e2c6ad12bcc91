#pragma once

#include "servers/rasterizer.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cl::dummy {

enum class CallKind : uint8_t {
    TextureCreate,
    MeshCreate,
    SkyCreate,
    VolumeCreate,
    VolumeUpload,
    FieldCreate,
    FieldUpload,
    TargetCreate,
    Free,
    Draw,
    TargetRead,
    Present,
};
[[nodiscard]] std::string_view to_string(CallKind kind) noexcept;

/// One call a server made, as far as it went.
struct Call {
    CallKind kind = CallKind::Draw;
    RID rid;                 ///< made, used or freed
    glm::ivec3 size{0};      ///< of the image, box or target; mesh: x = surfaces; draw: items, lights, probes
    int mip = 0;             ///< of an upload
    uint64_t bytes_hash = 0; ///< of the texels, vertices or radiance
};

/// A Frame that outlives draw(): the spans and pointers lead into copies.
struct RecordedFrame {
    RecordedFrame(RID target, const Frame& frame);

    RID target;
    Frame frame; ///< its spans are empty: see below
    std::vector<DrawItem> opaque, transparent;
    std::vector<LightItem> lights;                ///< casters: spans are empty, see below
    std::vector<std::vector<CasterItem>> casters; ///< of each light
    std::vector<GIProbeShading> gi_probes;
    std::vector<WorldItem> world;
    /// Copies of what the items point to, one for one.
    std::vector<MaterialDesc> opaque_materials, transparent_materials, world_materials;
    std::vector<LightDesc> light_descs;
};

/// How many things of each kind are alive: all 0 when a server has freed all it made.
struct LiveCounts {
    size_t textures = 0, meshes = 0, skies = 0, volumes = 0, targets = 0, fields = 0;
    friend bool operator==(const LiveCounts&, const LiveCounts&) = default;
};

/// Draws nothing and remembers everything: what tests of scene and server look at, and what runs where no
/// graphics are wanted. A target reads as the clear colour of the last frame drawn to it.
class DummyRasterizer final : public Rasterizer {
public:
    DummyRasterizer();

    [[nodiscard]] RasterizerInfo info() const override;
    [[nodiscard]] FrameContents frame_contents() const override { return contents_; }
    Expected<RID> texture_create(const Image& image, const TextureParams& params,
                                 TextureColorSpace space) override;
    Expected<RID> mesh_create(std::span<const MeshSurface> surfaces) override;
    Expected<RID> sky_create(const SkyDesc& sky) override;
    Expected<RID> gi_volume_create(const GIVolumeDesc& desc) override;
    Status gi_volume_upload(RID volume, int mip, glm::ivec3 offset, glm::ivec3 size,
                            std::span<const uint8_t> rgba8) override;
    Expected<RID> gi_field_create(const GIFieldDesc& desc) override;
    Status gi_field_upload(RID field, std::span<const uint32_t> light,
                           std::span<const uint16_t> air) override;
    Expected<RID> target_create(glm::ivec2 size) override;
    Status free(RID rid) override;
    Status draw(RID target, const Frame& frame) override;
    Expected<Image> target_read(RID target, TargetFormat format) override;
    [[nodiscard]] FrameStats last_stats() const override { return stats_; }
    void present() override;

    // --- what it remembers -----------------------------------------------------------------------
    [[nodiscard]] const std::vector<Call>& calls() const noexcept { return calls_; }
    [[nodiscard]] size_t count(CallKind kind) const noexcept;
    void forget_calls() { calls_.clear(); }
    [[nodiscard]] LiveCounts live() const noexcept;
    /// The GI volumes that are alive, oldest slot first.
    [[nodiscard]] std::vector<RID> volumes();
    /// Texels of one mip of a volume, x fastest, then y, then z; empty if there is no such volume or mip.
    [[nodiscard]] std::span<const uint8_t> volume_texels(RID volume, int mip) const noexcept;
    [[nodiscard]] const GIVolumeDesc* volume_desc(RID volume) const noexcept;
    [[nodiscard]] std::optional<TextureColorSpace> texture_space(RID texture) const noexcept;
    /// The last frame drawn; null before the first.
    [[nodiscard]] const RecordedFrame* last_frame() const noexcept { return frame_ ? &*frame_ : nullptr; }

    /// As if frames were drawn on the CPU, each in so much time; 0: as if not.
    void set_draws_on_cpu(double frame_ms) { cpu_frame_ms_ = frame_ms; }
    /// What the next frames are to hold.
    void set_frame_contents(FrameContents contents) { contents_ = contents; }

    /// The next call of this kind fails with `error` and does nothing.
    void fail_next(CallKind kind, Error error) { failure_ = Failure{kind, std::move(error)}; }

private:
    struct Texture {
        glm::ivec2 size{0};
        TextureColorSpace space = TextureColorSpace::Linear;
    };
    struct Mesh {
        std::vector<int64_t> triangles; ///< of each surface
    };
    struct Sky {};
    struct Volume {
        GIVolumeDesc desc;
        std::vector<std::vector<uint8_t>> mips;
    };
    struct Field {};
    struct Target {
        glm::ivec2 size{0};
        Color clear_color{0, 0, 0, 1};
    };
    struct Failure {
        CallKind kind;
        Error error;
    };
    /// The error that fail_next() asked for, once.
    std::optional<Error> take_failure(CallKind kind);
    void record(CallKind kind, RID rid, glm::ivec3 size, int mip, std::span<const uint8_t> bytes);

    RID_Owner<Texture> textures_;
    RID_Owner<Mesh> meshes_;
    RID_Owner<Sky> skies_;
    RID_Owner<Volume> volumes_;
    RID_Owner<Target> targets_;
    RID_Owner<Field> fields_;
    std::vector<Call> calls_;
    std::optional<RecordedFrame> frame_;
    std::optional<Failure> failure_;
    FrameStats stats_;
    double cpu_frame_ms_ = 0.0; ///< 0: not drawn on the CPU
    FrameContents contents_ = FrameContents::InView;
    Target window_;
};

} // namespace cl::dummy
