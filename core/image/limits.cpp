#include "core/image/codecs.h"

#include <fmt/core.h>

#include <new>

namespace cl {

Error damaged_image(std::string_view name, std::string_view kind, std::string_view what) {
    return {ErrorCode::ParseError, fmt::format("damaged {}: {}", kind, what), {std::string(name)}};
}

Expected<Image> allocate_image(int64_t width, int64_t height, PixelFormat format, std::string_view name,
                               uint64_t least_bytes, uint64_t file_bytes) {
    const auto fail = [&](ErrorCode code, std::string message) {
        return Error{code, std::move(message), {std::string(name)}};
    };
    if (width < 1 || height < 1) {
        return fail(ErrorCode::ParseError,
                    fmt::format("expected at least 1x1 pixels, found {}x{}", width, height));
    }
    if (width > kMaxImageEdge || height > kMaxImageEdge) {
        return fail(ErrorCode::OutOfMemory, fmt::format("expected at most {0}x{0} pixels, found {1}x{2}",
                                                        kMaxImageEdge, width, height));
    }
    const auto bytes = static_cast<uint64_t>(width * height * bytes_per_pixel(format));
    if (bytes > kMaxImageBytes) {
        return fail(ErrorCode::OutOfMemory,
                    fmt::format("expected an image of at most {} bytes, found {}x{} {} of {}", kMaxImageBytes,
                                width, height, format_name(format), bytes));
    }
    if (file_bytes < least_bytes) {
        return fail(ErrorCode::ParseError,
                    fmt::format("expected at least {} bytes for {}x{} pixels, found {}", least_bytes, width,
                                height, file_bytes));
    }
    Image image{glm::ivec2(width, height), format, {}};
    try {
        image.data.resize(bytes);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::OutOfMemory, fmt::format("no memory for {}x{} pixels", width, height));
    }
    return image;
}

Status check_image_data(const Image& image) {
    if (image.size.x < 1 || image.size.y < 1 ||
        image.data.size() !=
            size_t(image.size.x) * size_t(image.size.y) * size_t(bytes_per_pixel(image.format))) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("expected the data of {}x{} {} pixels, found {} bytes", image.size.x,
                                 image.size.y, format_name(image.format), image.data.size())};
    }
    return {};
}

} // namespace cl
