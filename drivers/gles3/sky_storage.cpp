#include "drivers/gles3/sky_storage.h"

#include "drivers/gles3/sky_filter.h"

#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace cl::gles3 {

namespace {

// A layer more than 512 wide would take 100 MB and look no sharper on a surface.
constexpr int kMaxRadianceWidth = 512;
constexpr int kMinRadianceWidth = 8;

void append_halves(std::span<const glm::vec3> texels, std::vector<uint64_t>& out) {
    constexpr float kMaxHalf = 65504.0f;
    for (const glm::vec3& t : texels) {
        out.push_back(glm::packHalf4x16(glm::vec4(glm::clamp(t, -kMaxHalf, kMaxHalf), 1.0f)));
    }
}

/// What is not a finite number becomes 0: one bad texel must not spread over the picture.
std::vector<glm::vec3> finite_texels(std::span<const float> rgb) {
    std::vector<glm::vec3> out(rgb.size() / 3);
    for (size_t i = 0; i < rgb.size(); ++i) {
        out[i / 3][static_cast<glm::length_t>(i % 3)] = std::isfinite(rgb[i]) ? rgb[i] : 0.0f;
    }
    return out;
}

Expected<gl::Texture2D> upload_2d(const gl::Texture2DDesc& desc, std::span<const glm::vec3> texels) {
    Expected<gl::Texture2D> texture = gl::Texture2D::create(desc);
    if (!texture) {
        return texture.error();
    }
    std::vector<uint64_t> halves;
    append_halves(texels, halves);
    if (Status s = texture->upload(0, {0, 0}, desc.size, std::as_bytes(std::span(halves))); !s) {
        return s.error();
    }
    if (desc.mips > 1) {
        texture->generate_mips();
    }
    return texture;
}

Expected<gl::Texture2D> upload_panorama(glm::ivec2 size, std::span<const glm::vec3> texels) {
    gl::Texture2DDesc desc;
    desc.size = size;
    desc.format = gl::Format::RGBA16F;
    desc.mips = gl::full_mip_count({size, 1});
    desc.sampler = {gl::Filter::Linear, gl::MipFilter::Linear, gl::Wrap::Repeat};
    desc.label = "sky panorama";
    return upload_2d(desc, texels);
}

Expected<gl::Texture2D> upload_irradiance(const ParaboloidMap& map) {
    gl::Texture2DDesc desc;
    desc.size = {map.width, 2 * map.width};
    desc.format = gl::Format::RGBA16F;
    desc.label = "sky irradiance";
    return upload_2d(desc, map.texels);
}

Expected<gl::Texture3D> upload_radiance(std::span<const ParaboloidMap> layers) {
    gl::Texture3DDesc desc;
    const int width = layers.front().width;
    desc.size = {width, 2 * width, static_cast<int>(layers.size())};
    desc.format = gl::Format::RGBA16F;
    desc.label = "sky radiance";
    Expected<gl::Texture3D> texture = gl::Texture3D::create(desc);
    if (!texture) {
        return texture.error();
    }
    std::vector<uint64_t> halves;
    for (const ParaboloidMap& layer : layers) {
        append_halves(layer.texels, halves);
    }
    if (Status s = texture->upload(0, {0, 0, 0}, desc.size, std::as_bytes(std::span(halves))); !s) {
        return s.error();
    }
    return texture;
}

Expected<StoredSky> store(glm::ivec2 size, std::span<const glm::vec3> panorama,
                          const ParaboloidMap& irradiance, std::span<const ParaboloidMap> radiance) {
    Expected<gl::Texture2D> picture = upload_panorama(size, panorama);
    if (!picture) {
        return picture.error();
    }
    Expected<gl::Texture2D> diffuse = upload_irradiance(irradiance);
    if (!diffuse) {
        return diffuse.error();
    }
    Expected<gl::Texture3D> gloss = upload_radiance(radiance);
    if (!gloss) {
        return gloss.error();
    }
    return StoredSky{*std::move(picture), *std::move(diffuse), *std::move(gloss), size.x};
}

} // namespace

Expected<SkyStorage> SkyStorage::create() {
    const ParaboloidMap black{1, std::vector<glm::vec3>(2)};
    const glm::vec3 texel(0.0f);
    Expected<StoredSky> none = store({1, 1}, std::span(&texel, 1), black, std::span(&black, 1));
    if (!none) {
        return none.error();
    }
    return SkyStorage(*std::move(none));
}

Expected<RID> SkyStorage::create(const SkyDesc& desc) {
    if (desc.size.x < 1 || desc.size.y < 1 ||
        desc.radiance.size() != static_cast<size_t>(desc.size.x) * static_cast<size_t>(desc.size.y) * 3) {
        return Error{ErrorCode::InvalidArgument,
                     "sky: expected 3 numbers a texel of " + std::to_string(desc.size.x) + "x" +
                         std::to_string(desc.size.y) + ", found " + std::to_string(desc.radiance.size())};
    }
    const Panorama panorama(desc.size, finite_texels(desc.radiance));
    const int width = std::clamp(desc.radiance_map_size, kMinRadianceWidth, kMaxRadianceWidth);
    Expected<StoredSky> sky =
        store(desc.size, panorama.texels(), filter_irradiance(panorama), filter_radiance(panorama, width));
    if (!sky) {
        return sky.error();
    }
    return skies_.make(*std::move(sky));
}

} // namespace cl::gles3
