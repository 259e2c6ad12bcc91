#pragma once

#include "servers/rasterizer.h"
#include "servers/visual/first_error.h"

#include "core/image.h"
#include "core/rid.h"

#include <array>
#include <memory>
#include <utility>

namespace cl {

/// Calls f(RID& texture, TextureColorSpace) for each texture slot of a material. The rule of colour spaces:
/// albedo and emission hold colours and are decoded from sRGB; metallic, roughness, normal and ao hold
/// numbers. (Spec scene-classes section 18, "Sampler".)
template <typename Material, typename F>
void for_each_texture(Material& material, F&& f) {
    f(material.albedo_texture, TextureColorSpace::Srgb);
    f(material.emission_texture, TextureColorSpace::Srgb);
    f(material.metallic_texture, TextureColorSpace::Linear);
    f(material.roughness_texture, TextureColorSpace::Linear);
    f(material.normal_texture, TextureColorSpace::Linear);
    f(material.ao_texture, TextureColorSpace::Linear);
}

/// Images until they are first drawn, rasteriser textures from then on.
///
/// One image may be sampled as colours by one material and as numbers by another; it is uploaded for each
/// use, when first drawn. The image in memory is let go once it is uploaded in every space that living
/// materials use. If a later material wants the other space, whoever shares the image may still hold it; else
/// it is drawn in the space it has, with a warning.
class TextureStorage {
public:
    explicit TextureStorage(Rasterizer& rasterizer);

    RID make(std::shared_ptr<const Image> image, const TextureParams& params);
    bool free(RID texture);
    [[nodiscard]] bool owns(RID texture) const noexcept { return textures_.owns(texture); }
    [[nodiscard]] size_t size() const noexcept { return textures_.size(); }
    /// {0, 0} if not a texture.
    [[nodiscard]] glm::ivec2 size_of(RID texture) const noexcept;
    /// True while the server itself holds the pixels.
    [[nodiscard]] bool holds_image(RID texture) const noexcept;

    /// The pixels, while the server or anybody else still holds them; else null.
    [[nodiscard]] std::shared_ptr<const Image> image(RID texture) const noexcept;

    /// A living material samples `texture` in `space` (delta +1), or no longer does (-1). Any RID will do.
    void count_use(RID texture, TextureColorSpace space, int delta) noexcept;
    /// The rasteriser's texture, uploaded now if need be; null if `texture` is not one or cannot be uploaded.
    RID uploaded(RID texture, TextureColorSpace space, FirstError& errors);

private:
    struct Texture {
        std::shared_ptr<const Image> image;      ///< until released
        std::weak_ptr<const Image> shared_image; ///< others may hold it longer
        TextureParams params;
        glm::ivec2 size{0};
        std::array<RID, 2> uploads; ///< by TextureColorSpace
        std::array<int, 2> uses{};  ///< living materials, by TextureColorSpace
        bool failed = false;        ///< refused by the rasteriser: not tried again
    };
    void release_image_if_spent(Texture& texture) const noexcept;

    Rasterizer& rasterizer_;
    RID_Owner<Texture> textures_;
};

} // namespace cl
