#include "drivers/gles3/texture_storage.h"

#include "core/image/mipmap.h"

#include <fmt/core.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace cl::gles3 {

namespace {

constexpr float kLargestHalf = 65504.0f;

gl::SamplerDesc sampler_of(const TextureParams& params) {
    gl::SamplerDesc sampler;
    sampler.filter = params.filter ? gl::Filter::Linear : gl::Filter::Nearest;
    if (params.mipmaps) {
        sampler.mip_filter = params.filter ? gl::MipFilter::Linear : gl::MipFilter::Nearest;
    }
    if (params.mirrored_repeat) {
        sampler.wrap = gl::Wrap::Mirror;
    } else {
        sampler.wrap = params.repeat ? gl::Wrap::Repeat : gl::Wrap::Clamp;
    }
    return sampler;
}

/// Halves of 32-bit floats. Infinity and what is too large become the largest half, NaN becomes 0: one bad
/// texel must not spread through filters and blurs.
std::vector<uint16_t> halves_of(std::span<const float> values) {
    std::vector<uint16_t> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(), [](float v) {
        return glm::packHalf1x16(std::isnan(v) ? 0.0f : std::clamp(v, -kLargestHalf, kLargestHalf));
    });
    return halves;
}

/// Uploads one level; floats as halves.
Status upload_level(gl::Texture2D& texture, int mip, const Image& level) {
    if (level.format == PixelFormat::RGBAF) {
        const std::vector<uint16_t> halves = halves_of(level.floats());
        return texture.upload(mip, glm::ivec2(0), level.size, std::as_bytes(std::span(halves)));
    }
    return texture.upload(mip, glm::ivec2(0), level.size, std::as_bytes(std::span(level.data)));
}

/// Uploads the image and, if the texture has levels for them, its mips. These are means of the stored values,
/// also of sRGB ones, as Godot 3.2.3 makes them: a checkerboard of 0 and 255 that is minified shows 128,
/// where the mean of the light would show 188 (measured). Not by the driver, so that all drivers sample the
/// same bytes.
Status upload_levels(gl::Texture2D& texture, const Image& image) {
    if (Status s = upload_level(texture, 0, image); !s || texture.mips() == 1) {
        return s;
    }
    int mip = 0;
    for (const Image& level : build_mips(image)) {
        if (Status s = upload_level(texture, ++mip, level); !s) {
            return s;
        }
    }
    return {};
}

Expected<gl::Texture2D> make_texel(std::array<uint8_t, 4> rgba, std::string_view label) {
    Expected<gl::Texture2D> texture = gl::Texture2D::create({.size = {1, 1}, .label = label});
    if (!texture) {
        return texture;
    }
    if (Status s = texture->upload(0, {0, 0}, {1, 1}, std::as_bytes(std::span(rgba))); !s) {
        return s.error();
    }
    return texture;
}

} // namespace

TextureStorage::TextureStorage(gl::Texture2D white, gl::Texture2D black, gl::Texture2D flat_normal)
    : white_(std::move(white)), black_(std::move(black)), flat_normal_(std::move(flat_normal)) {}

Expected<TextureStorage> TextureStorage::create() {
    Expected<gl::Texture2D> white = make_texel({255, 255, 255, 255}, "white");
    Expected<gl::Texture2D> black = make_texel({0, 0, 0, 255}, "black");
    Expected<gl::Texture2D> flat_normal = make_texel({128, 128, 255, 255}, "flat normal");
    for (const Expected<gl::Texture2D>* t : {&white, &black, &flat_normal}) {
        if (!*t) {
            return t->error();
        }
    }
    return TextureStorage(*std::move(white), *std::move(black), *std::move(flat_normal));
}

Expected<RID> TextureStorage::create(const Image& image, const TextureParams& params,
                                     TextureColorSpace space) {
    const size_t wanted = static_cast<size_t>(std::max(0, image.size.x)) *
                          static_cast<size_t>(std::max(0, image.size.y)) *
                          static_cast<size_t>(bytes_per_pixel(image.format));
    if (image.data.size() != wanted) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("expected {} bytes for an image of {}x{}, found {}", wanted, image.size.x,
                                 image.size.y, image.data.size())};
    }
    const bool floats = is_float_format(image.format);
    // Formats of one or two channels are not decoded, grey albedo included: Godot 3.2.3 has no sRGB form of
    // them.
    const bool decoded = space == TextureColorSpace::Srgb && channel_count(image.format) >= 3;
    gl::Format format = decoded ? gl::Format::Srgb8Alpha8 : gl::Format::RGBA8;
    if (floats) {
        format = gl::Format::RGBA16F;
    }
    Expected<gl::Texture2D> texture = gl::Texture2D::create(
        {.size = image.size,
         .format = format,
         .mips = params.mipmaps ? gl::full_mip_count(glm::ivec3(glm::max(image.size, 1), 1)) : 1,
         .sampler = sampler_of(params),
         .label = "scene texture"});
    if (!texture) {
        return texture.error();
    }
    const Image expanded = image.converted_to(floats ? PixelFormat::RGBAF : PixelFormat::RGBA8);
    if (Status s = upload_levels(*texture, expanded); !s) {
        return s.error();
    }
    return textures_.make(*std::move(texture));
}

const gl::Texture2D& TextureStorage::get_or(RID rid, DefaultTexture fallback) const noexcept {
    if (const gl::Texture2D* texture = get(rid)) {
        return *texture;
    }
    switch (fallback) {
    case DefaultTexture::Black:
        return black_;
    case DefaultTexture::FlatNormal:
        return flat_normal_;
    case DefaultTexture::White:
        break;
    }
    return white_;
}

} // namespace cl::gles3
