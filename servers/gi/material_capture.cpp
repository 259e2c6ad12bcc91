// What a bake sees of a material (spec gi-bake section 3).
#include "servers/gi/voxelizer.h"

namespace cl::gi {

namespace {

bool has_pixels(const Image& image) {
    return image.size.x > 0 && image.size.y > 0 && !image.data.empty();
}

/// The texture as kCaptureSize^2 texels of RGBA8.
Image captured_texels(const Image& texture) {
    constexpr glm::ivec2 kSize{kCaptureSize, kCaptureSize};
    const bool is_color = texture.format == PixelFormat::RGB8 || texture.format == PixelFormat::RGBA8;
    if (is_color && texture.size != kSize) {
        return resize_cubic_rgba8(texture,
                                  kSize); // reads a few texels of a large picture: no copy of it is made
    }
    const Image rgba8 = texture.converted_to(PixelFormat::RGBA8);
    return rgba8.size == kSize ? rgba8 : resize_cubic_rgba8(rgba8, kSize);
}

/// texel * scale + offset; one texel where there is no texture. A texture without pixels counts as black.
std::vector<glm::vec3> captured_map(const Image* texture, const glm::vec3& scale, const glm::vec3& offset) {
    if (!texture || !has_pixels(*texture)) {
        return {offset};
    }
    const Image texels = captured_texels(*texture);
    std::vector<glm::vec3> map(size_t(kCaptureSize) * kCaptureSize);
    for (size_t i = 0; i < map.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            // In double until the end: albedo bytes are truncated later, so the last bit decides some of
            // them.
            const double share = texels.data[i * 4 + size_t(c)] / 255.0;
            map[i][c] = float(share * double(scale[c]) + double(offset[c]));
        }
    }
    return map;
}

} // namespace

MaterialCapture capture_material(const CaptureInput& input) {
    const glm::vec3 none(0.0f);
    const glm::vec3 emission = input.emission_color * input.emission_energy;
    MaterialCapture capture;
    capture.albedo = input.albedo_texture ? captured_map(input.albedo_texture, input.albedo_color, none)
                                          : std::vector<glm::vec3>{input.albedo_color};
    capture.emission = input.emission_multiply
                           ? captured_map(input.emission_texture, emission, none)
                           : captured_map(input.emission_texture, glm::vec3(input.emission_energy), emission);
    return capture;
}

} // namespace cl::gi
