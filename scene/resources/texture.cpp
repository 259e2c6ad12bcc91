#include "scene/resources/texture.h"

#include "servers/visual_server.h"

#include "core/object/class_registry.h"

#include <utility>

namespace cl::scene {

void Texture::set_image(std::shared_ptr<const Image> image) {
    image_ = std::move(image);
    rid_.reset();
    emit_changed();
}

void Texture::set_flags(uint32_t flags) {
    flags_ = flags;
    rid_.reset();
    emit_changed();
}

RID Texture::rid(VisualServer& server) const {
    if (const RID made = rid_.in(server)) {
        return made;
    }
    if (!image_ || image_->data.empty()) {
        return {};
    }
    const TextureParams params{
        .mipmaps = (flags_ & texture_flag::kMipmaps) != 0,
        .repeat = (flags_ & texture_flag::kRepeat) != 0,
        .mirrored_repeat = (flags_ & texture_flag::kMirroredRepeat) != 0,
        .filter = (flags_ & texture_flag::kFilter) != 0,
    };
    rid_.adopt(server, server.texture_create(*image_, params));
    return rid_.get();
}

void ImageTexture::bind(ClassBuilder<ImageTexture>& c) {
    c.doc("A texture whose pixels stand in the scene file.");
    c.property("flags", &ImageTexture::flags, &ImageTexture::set_flags)
        .hint(PropertyHint::Flags,
              "Mipmaps,Repeat,Filter,Anisotropic,Convert to Linear,Mirrored Repeat,Video")
        .doc("How the texture is sampled.");
    c.property("storage", &ImageTexture::storage, &ImageTexture::set_storage)
        .enumeration("Raw,Lossy,Lossless")
        .doc("How Godot keeps the pixels; stored only.");
    c.property("lossy_quality", &ImageTexture::lossy_quality, &ImageTexture::set_lossy_quality)
        .range("0,1,0.01")
        .doc("Quality of lossy storage; stored only.");
    c.property("image", &ImageTexture::image_resource, &ImageTexture::set_image_resource).doc("The pixels.");
    c.property("size", &ImageTexture::display_size, &ImageTexture::set_display_size)
        .doc("Size it is shown at in two dimensions [pixels]; stored only.");
}

void ImageTexture::set_image_resource(Ref<ImageResource> image) {
    image_resource_ = std::move(image);
    display_size_ = glm::vec2(0.0f);
    set_image(image_resource_ ? image_resource_->image() : nullptr);
}

glm::vec2 ImageTexture::display_size() const {
    return display_size_ == glm::vec2(0.0f) ? glm::vec2(size()) : display_size_;
}

void StreamTexture::bind(ClassBuilder<StreamTexture>& c) {
    c.doc("A texture imported from an image file.");
    c.property("flags", &StreamTexture::flags, &StreamTexture::set_flags)
        .hint(PropertyHint::Flags,
              "Mipmaps,Repeat,Filter,Anisotropic,Convert to Linear,Mirrored Repeat,Video")
        .doc("How the texture is sampled.");
    c.property("load_path", &StreamTexture::load_path, &StreamTexture::set_load_path)
        .doc("Path of the imported .stex file.");
}

} // namespace cl::scene
