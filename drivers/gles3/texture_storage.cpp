#include "drivers/gles3/texture_storage.h"

#include "drivers/gles3/mip_chain.h"

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

bool is_float(PixelFormat format) {
    return format >= PixelFormat::RF;
}

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

Status upload_levels_rgba8(gl::Texture2D& texture, std::vector<uint8_t> level) {
    glm::ivec2 size(texture.size());
    for (int mip = 0;; ++mip) {
        if (Status s = texture.upload(mip, glm::ivec2(0), size, std::as_bytes(std::span(level))); !s) {
            return s;
        }
        if (mip + 1 == texture.mips()) {
            return {};
        }
        const glm::ivec2 half = next_mip_size(size);
        std::vector<uint8_t> coarse(static_cast<size_t>(half.x) * static_cast<size_t>(half.y) * 4);
        downsample_rgba8(level, size, coarse);
        level = std::move(coarse);
        size = half;
    }
}

Status upload_levels_rgba16f(gl::Texture2D& texture, std::vector<float> level) {
    glm::ivec2 size(texture.size());
    for (int mip = 0;; ++mip) {
        const std::vector<uint16_t> halves = halves_of(level);
        if (Status s = texture.upload(mip, glm::ivec2(0), size, std::as_bytes(std::span(halves))); !s) {
            return s;
        }
        if (mip + 1 == texture.mips()) {
            return {};
        }
        const glm::ivec2 half = next_mip_size(size);
        std::vector<float> coarse(static_cast<size_t>(half.x) * static_cast<size_t>(half.y) * 4);
        downsample_rgba32f(level, size, coarse);
        level = std::move(coarse);
        size = half;
    }
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
    const bool floats = is_float(image.format);
    gl::Format format = space == TextureColorSpace::Srgb ? gl::Format::Srgb8Alpha8 : gl::Format::RGBA8;
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
    Image expanded = image.converted_to(floats ? PixelFormat::RGBAF : PixelFormat::RGBA8);
    Status uploaded;
    if (floats) {
        const std::span<const float> values = expanded.floats();
        uploaded = upload_levels_rgba16f(*texture, std::vector<float>(values.begin(), values.end()));
    } else {
        uploaded = upload_levels_rgba8(*texture, std::move(expanded.data));
    }
    if (!uploaded) {
        return uploaded.error();
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
