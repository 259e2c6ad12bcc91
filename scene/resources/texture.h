#pragma once

#include "scene/resources/explains_refusal.h"
#include "scene/resources/server_rid.h"

#include "servers/rasterizer.h"

#include "core/image.h"
#include "core/object/resource.h"

#include <cstdint>
#include <memory>
#include <string>

namespace cl::scene {

/// Bits of a texture's `flags`.
namespace texture_flag {
inline constexpr uint32_t kMipmaps = 1, kRepeat = 2, kFilter = 4, kAnisotropic = 8, kConvertToLinear = 16;
inline constexpr uint32_t kMirroredRepeat = 32, kVideo = 64;
inline constexpr uint32_t kDefault = kMipmaps | kRepeat | kFilter;
} // namespace texture_flag

/// A picture for materials and skies. Abstract.
class Texture : public Resource {
public:
    static constexpr std::string_view kClassName = "Texture";

    /// The pixels; null if there are none. Shared, never changed in place.
    [[nodiscard]] const std::shared_ptr<const Image>& image() const noexcept { return image_; }
    void set_image(std::shared_ptr<const Image> image);
    [[nodiscard]] uint32_t flags() const noexcept { return flags_; }
    void set_flags(uint32_t flags);
    [[nodiscard]] glm::ivec2 size() const noexcept { return image_ ? image_->size : glm::ivec2(0); }

    /// The texture in `server`, made on the first call; null RID if there is no image. A new image or new
    /// flags make a new RID: users ask again when on_changed() calls them.
    [[nodiscard]] RID rid(VisualServer& server) const;

protected:
    explicit Texture(uint32_t default_flags) : flags_(default_flags) {}

private:
    std::shared_ptr<const Image> image_;
    uint32_t flags_;
    mutable ServerRID rid_;
};

/// The resource class "Image": pixels inside a scene file, as {width, height, format, mipmaps, data}.
class ImageResource final : public Resource, public ExplainsRefusal {
public:
    static constexpr std::string_view kClassName = "Image";
    static void bind(ClassBuilder<ImageResource>& c);

    /// The base level converted to one of our formats; null if there is none or its format is not supported.
    [[nodiscard]] const std::shared_ptr<const Image>& image() const noexcept { return image_; }
    void set_image(std::shared_ptr<const Image> image);
    /// As stored: kept as it was read, so that saving writes the same.
    [[nodiscard]] Dictionary data() const;
    SetResult set_data(const Dictionary& data);
    [[nodiscard]] const std::string& refusal() const noexcept override { return refusal_; }
    /// Why there is data but no image: a format that we do not read. Empty otherwise.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

private:
    std::shared_ptr<const Image> image_;
    Dictionary data_;
    std::string refusal_;
    std::string problem_;
};

/// A texture whose pixels stand in the scene file or were made by code.
class ImageTexture final : public Texture {
public:
    static constexpr std::string_view kClassName = "ImageTexture";
    static void bind(ClassBuilder<ImageTexture>& c);
    ImageTexture() : Texture(texture_flag::kDefault) {}

    [[nodiscard]] const Ref<ImageResource>& image_resource() const noexcept { return image_resource_; }
    void set_image_resource(Ref<ImageResource> image);
    [[nodiscard]] int storage() const noexcept { return storage_; }
    void set_storage(int storage) { storage_ = storage; }
    [[nodiscard]] float lossy_quality() const noexcept { return lossy_quality_; }
    void set_lossy_quality(float quality) { lossy_quality_ = quality; }
    [[nodiscard]] glm::vec2 display_size() const;
    void set_display_size(glm::vec2 size) { display_size_ = size; }

private:
    Ref<ImageResource> image_resource_;
    int storage_ = 0;
    float lossy_quality_ = 0.7f;
    glm::vec2 display_size_{0.0f}; ///< 0: the image's own
};

/// A texture imported from an image file; its path is that of the source image.
class StreamTexture final : public Texture {
public:
    static constexpr std::string_view kClassName = "StreamTexture";
    static void bind(ClassBuilder<StreamTexture>& c);
    StreamTexture() : Texture(0) {}

    [[nodiscard]] const std::string& load_path() const noexcept { return load_path_; }
    void set_load_path(std::string path) { load_path_ = std::move(path); }

private:
    std::string load_path_;
};

} // namespace cl::scene
