#include "servers/visual/texture_storage.h"

#include "servers/visual/rid_kinds.h"

#include "core/io/log.h"

#include <fmt/format.h>

namespace cl {
namespace {

size_t index_of(TextureColorSpace space) noexcept {
    return static_cast<size_t>(space);
}

} // namespace

TextureStorage::TextureStorage(Rasterizer& rasterizer)
    : rasterizer_(rasterizer), textures_(static_cast<uint32_t>(RIDKind::Texture)) {}

RID TextureStorage::make(std::shared_ptr<const Image> image, const TextureParams& params) {
    Texture texture;
    texture.size = image->size;
    texture.shared_image = image;
    texture.image = std::move(image);
    texture.params = params;
    return textures_.make(std::move(texture));
}

bool TextureStorage::free(RID rid) {
    Texture* texture = textures_.get(rid);
    if (!texture) {
        return false;
    }
    for (RID upload : texture->uploads) {
        if (upload) {
            static_cast<void>(rasterizer_.free(upload)); // a backend that lost it has nothing left to free
        }
    }
    return textures_.free(rid);
}

glm::ivec2 TextureStorage::size_of(RID rid) const noexcept {
    const Texture* texture = textures_.get(rid);
    return texture ? texture->size : glm::ivec2(0);
}

bool TextureStorage::holds_image(RID rid) const noexcept {
    const Texture* texture = textures_.get(rid);
    return texture && texture->image;
}

std::shared_ptr<const Image> TextureStorage::image(RID rid) const noexcept {
    const Texture* texture = textures_.get(rid);
    return !texture ? nullptr : (texture->image ? texture->image : texture->shared_image.lock());
}

void TextureStorage::count_use(RID rid, TextureColorSpace space, int delta) noexcept {
    if (Texture* texture = textures_.get(rid)) {
        texture->uses[index_of(space)] += delta;
    }
}

RID TextureStorage::uploaded(RID rid, TextureColorSpace space, FirstError& errors) {
    Texture* texture = textures_.get(rid);
    if (!texture || texture->failed) {
        return {};
    }
    RID& upload = texture->uploads[index_of(space)];
    if (upload) {
        return upload;
    }
    const std::shared_ptr<const Image> image = texture->image ? texture->image : texture->shared_image.lock();
    if (!image) {
        log_warning(fmt::format("texture {}: its image was released before a material first used it as {}; "
                                "create it again to use it so",
                                rid.slot & 0xFFFFFFu,
                                space == TextureColorSpace::Srgb ? "colours" : "numbers"));
        return texture->uploads[1 - index_of(space)];
    }
    Expected<RID> created = rasterizer_.texture_create(*image, texture->params, space);
    if (!created) {
        texture->failed = true;
        texture->image.reset();
        errors.note(created.error());
        return {};
    }
    upload = *created;
    release_image_if_spent(*texture);
    return upload;
}

void TextureStorage::release_image_if_spent(Texture& texture) const noexcept {
    for (size_t space = 0; space < texture.uploads.size(); ++space) {
        if (texture.uses[space] > 0 && !texture.uploads[space]) {
            return;
        }
    }
    texture.image.reset();
}

} // namespace cl
