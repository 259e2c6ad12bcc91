#pragma once

#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/rasterizer.h"

#include "core/expected.h"
#include "core/rid.h"

#include <cstdint>
#include <span>
#include <utility>

namespace cl::gles3 {

/// A scenario's GI field: lists in rows of kFieldRow texels, air as a volume.
struct StoredField {
    gl::Texture2D bricks;   ///< RGBA32UI
    gl::Texture2D joints;   ///< RG32UI
    gl::Texture2D light;    ///< RGB9E5
    gl::Texture3D air;      ///< RGBA16F
    glm::ivec3 air_size{0}; ///< what of it is in use [texels]
    size_t slots = 0;
};

/// Entries a row in the list textures (shaders/lib/gi_field.glsl has the same number).
inline constexpr int kFieldRow = 1024;

class GIFieldStorage {
public:
    /// An empty field for unused samplers: every sampler of a draw must have a texture.
    [[nodiscard]] static Expected<GIFieldStorage> create();
    /// @return Unsupported beyond the driver's limits.
    [[nodiscard]] Expected<RID> create(const GIFieldDesc& desc);
    Status upload(RID field, std::span<const uint32_t> light, std::span<const uint16_t> air);
    /// nullptr if stale.
    [[nodiscard]] const StoredField* get(RID field) const noexcept { return fields_.get(field); }
    [[nodiscard]] const StoredField& empty() const noexcept { return empty_; }
    bool free(RID field) { return fields_.free(field); }

private:
    explicit GIFieldStorage(StoredField empty) : empty_(std::move(empty)) {}
    RID_Owner<StoredField> fields_{static_cast<uint32_t>(RIDKind::GIField)};
    StoredField empty_;
};

} // namespace cl::gles3
