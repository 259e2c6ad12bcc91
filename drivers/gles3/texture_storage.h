#pragma once

#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/rasterizer.h"

#include "core/expected.h"
#include "core/image.h"
#include "core/rid.h"

namespace cl::gles3 {

/// Stand-ins where a material has no texture (spec scene-classes section 15, missing-texture defaults).
enum class DefaultTexture : uint8_t {
    White,
    Black,      ///< emission
    FlatNormal, ///< (0.5, 0.5, 1), not sRGB
};

/// The images behind texture RIDs. Row 0 of an image is at t = 0: sample with the scene's UVs as they are.
class TextureStorage {
public:
    [[nodiscard]] static Expected<TextureStorage> create();

    /// Makes RGBA8 (sRGB-decoded on sampling if `space` says so; alpha never) or RGBA16F of float images;
    /// grey and alpha are expanded here, as GLES 3.0 has no luminance formats that can be sRGB. Floats beyond
    /// half's range become its largest value.
    /// @return InvalidArgument if the data does not fill the size, Unsupported beyond the driver's limit.
    [[nodiscard]] Expected<RID> create(const Image& image, const TextureParams& params,
                                       TextureColorSpace space);
    /// nullptr if stale.
    [[nodiscard]] const gl::Texture2D* get(RID rid) const noexcept { return textures_.get(rid); }
    /// The texture, or the stand-in where the RID is null or stale.
    [[nodiscard]] const gl::Texture2D& get_or(RID rid, DefaultTexture fallback) const noexcept;
    bool free(RID rid) { return textures_.free(rid); }

private:
    TextureStorage(gl::Texture2D white, gl::Texture2D black, gl::Texture2D flat_normal);
    RID_Owner<gl::Texture2D> textures_{static_cast<uint32_t>(RIDKind::Texture)};
    gl::Texture2D white_, black_, flat_normal_;
};

} // namespace cl::gles3
