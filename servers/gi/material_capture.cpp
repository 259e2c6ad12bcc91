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

/// texel * scale + offset; one colour where there is no texture. A texture without pixels counts as black.
CapturedMap captured_map(const Image* texture, const glm::vec3& scale, const glm::vec3& offset) {
    return texture && has_pixels(*texture) ? CapturedMap(captured_texels(*texture), scale, offset)
                                           : CapturedMap(offset);
}

} // namespace

MaterialCapture capture_material(const CaptureInput& input) {
    const glm::vec3 none(0.0f);
    const glm::vec3 emission = input.emission_color * input.emission_energy;
    MaterialCapture capture;
    capture.albedo = input.albedo_texture ? captured_map(input.albedo_texture, input.albedo_color, none)
                                          : CapturedMap(input.albedo_color);
    capture.emission = input.emission_multiply
                           ? captured_map(input.emission_texture, emission, none)
                           : captured_map(input.emission_texture, glm::vec3(input.emission_energy), emission);
    return capture;
}

} // namespace cl::gi
