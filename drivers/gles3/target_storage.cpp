#include "drivers/gles3/target_storage.h"

#include "drivers/gles3/gl/state.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace cl::gles3 {

namespace {

enum class Output { Picture, Window };

Expected<RenderTarget> make_target(glm::ivec2 size, Output output) {
    if (!gl::State::current().capabilities().color_buffer_float) {
        return Error{ErrorCode::Unsupported, "the driver cannot draw to RGBA16F (EXT_color_buffer_float)"};
    }
    const gl::SamplerDesc nearest{.filter = gl::Filter::Nearest};
    Expected<gl::Texture2D> radiance = gl::Texture2D::create(
        {.size = size, .format = gl::Format::RGBA16F, .sampler = nearest, .label = "radiance"});
    if (!radiance) {
        return radiance.error();
    }
    Expected<gl::Texture2D> depth = gl::Texture2D::create(
        {.size = size, .format = gl::Format::Depth24, .sampler = nearest, .label = "depth"});
    if (!depth) {
        return depth.error();
    }
    Expected<gl::Framebuffer> scene =
        gl::Framebuffer::create({.colors = {{{&*radiance}}}, .depth = {&*depth}, .label = "scene"});
    if (!scene) {
        return scene.error();
    }
    Expected<gl::Framebuffer> depth_only =
        gl::Framebuffer::create({.depth = {&*depth}, .label = "depth only"});
    if (!depth_only) {
        return depth_only.error();
    }
    std::optional<gl::Texture2D> picture;
    gl::Framebuffer out = gl::Framebuffer::window(size);
    if (output == Output::Picture) {
        Expected<gl::Texture2D> made = gl::Texture2D::create(
            {.size = size, .format = gl::Format::RGBA8, .sampler = nearest, .label = "picture"});
        if (!made) {
            return made.error();
        }
        picture.emplace(*std::move(made));
        Expected<gl::Framebuffer> framebuffer =
            gl::Framebuffer::create({.colors = {{{&*picture}}}, .label = "picture"});
        if (!framebuffer) {
            return framebuffer.error();
        }
        out = *std::move(framebuffer);
    }
    return RenderTarget{size,
                        *std::move(radiance),
                        *std::move(depth),
                        *std::move(scene),
                        *std::move(depth_only),
                        std::move(picture),
                        std::move(out),
                        {}};
}

/// GL reads from the bottom row up, images have their top row first.
template <typename Value>
void flip_rows(std::vector<Value>& pixels, glm::ivec2 size, size_t values_per_pixel) {
    const size_t row = static_cast<size_t>(size.x) * values_per_pixel;
    for (size_t top = 0, bottom = static_cast<size_t>(size.y); top + 1 < bottom; ++top) {
        --bottom;
        std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(top * row),
                         pixels.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
                         pixels.begin() + static_cast<std::ptrdiff_t>(bottom * row));
    }
}

Image read_radiance(const RenderTarget& target) {
    std::vector<float> rgba = target.scene.read_rgba32f({glm::ivec2(0), target.size});
    flip_rows(rgba, target.size, 4);
    std::vector<float> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (size_t i = 0; i < rgba.size(); i += 4) {
        rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    }
    Image image{target.size, PixelFormat::RGBF, std::vector<uint8_t>(rgb.size() * sizeof(float))};
    std::memcpy(image.data.data(), rgb.data(), image.data.size());
    return image;
}

Image read_picture(const RenderTarget& target) {
    std::vector<uint8_t> rgba = target.output.read_rgba8({glm::ivec2(0), target.size});
    flip_rows(rgba, target.size, 4);
    return Image{target.size, PixelFormat::RGBA8, std::move(rgba)};
}

} // namespace

bool cone_buffers_fit(const RenderTarget& target) noexcept {
    const int most = gl::State::current().capabilities().max_texture_size;
    return target.size.x <= most && 2 * target.size.y <= most;
}

Status make_cone_buffers(RenderTarget& target) {
    if (target.cones) {
        return {};
    }
    const auto floats = [](glm::ivec2 size, std::string_view label) {
        return gl::Texture2D::create({.size = size,
                                      .format = gl::Format::RGBA32F,
                                      .sampler = {.filter = gl::Filter::Nearest},
                                      .label = label});
    };
    Expected<gl::Texture2D> places = floats(target.size, "cone places");
    Expected<gl::Texture2D> shapes = floats(target.size, "cone shapes");
    Expected<gl::Texture2D> light = floats({target.size.x, 2 * target.size.y}, "cone light");
    for (const Expected<gl::Texture2D>* texture : {&places, &shapes, &light}) {
        if (!*texture) {
            return texture->error();
        }
    }
    Expected<gl::Framebuffer> points = gl::Framebuffer::create(
        {.colors = {{{&*places}, {&*shapes}}}, .depth = {&target.depth}, .label = "cone points"});
    if (!points) {
        return points.error();
    }
    const size_t pixels = static_cast<size_t>(target.size.x) * static_cast<size_t>(target.size.y);
    target.cones.emplace(ConeBuffers{*std::move(places), *std::move(shapes), *std::move(points),
                                     *std::move(light), std::vector<glm::vec4>(pixels),
                                     std::vector<glm::vec4>(pixels), std::vector<glm::vec4>(2 * pixels)});
    return {};
}

Expected<RID> TargetStorage::create(glm::ivec2 size) {
    Expected<RenderTarget> target = make_target(size, Output::Picture);
    if (!target) {
        return target.error();
    }
    return targets_.make(*std::move(target));
}

Expected<RenderTarget*> TargetStorage::window(glm::ivec2 size) {
    if (!window_ || window_->size != size) {
        Expected<RenderTarget> target = make_target(size, Output::Window);
        if (!target) {
            return target.error();
        }
        window_.emplace(*std::move(target));
    }
    return &*window_;
}

Expected<Image> TargetStorage::read(RID rid, TargetFormat format) {
    const RenderTarget* target = rid ? get(rid) : (window_ ? &*window_ : nullptr);
    if (!target) {
        return Error{ErrorCode::InvalidArgument,
                     "expected a live render target, found a stale or foreign RID"};
    }
    return format == TargetFormat::LinearFloat ? read_radiance(*target) : read_picture(*target);
}

} // namespace cl::gles3
