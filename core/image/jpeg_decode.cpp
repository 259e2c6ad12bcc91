#include "core/image/codecs.h"

#include <fmt/core.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>

namespace cl {

namespace {

struct CloseHandle {
    void operator()(void* handle) const noexcept { tjDestroy(handle); }
};
using JpegHandle = std::unique_ptr<void, CloseHandle>;

/// Every 8x8 block takes at least one bit; a quarter of that leaves room for odd sampling and arithmetic
/// coding.
uint64_t least_file_bytes(int width, int height) {
    return static_cast<uint64_t>(width) * static_cast<uint64_t>(height) / (8 * 8 * 8 * 4);
}

} // namespace

Expected<Image> decode_jpeg(std::span<const uint8_t> bytes, std::string_view name) {
    const JpegHandle jpeg(tjInitDecompress());
    if (!jpeg) {
        return Error{ErrorCode::OutOfMemory, "no memory for a JPEG reader", {std::string(name)}};
    }
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int color_space = 0;
    if (tjDecompressHeader3(jpeg.get(), bytes.data(), bytes.size(), &width, &height, &subsampling,
                            &color_space) != 0) {
        return damaged_image(name, "JPEG", tjGetErrorStr2(jpeg.get()));
    }
    if (color_space == TJCS_CMYK || color_space == TJCS_YCCK) {
        return Error{ErrorCode::Unsupported, "expected a grey or RGB JPEG, found CMYK", {std::string(name)}};
    }
    const bool is_grey = color_space == TJCS_GRAY;
    Expected<Image> image = allocate_image(width, height, is_grey ? PixelFormat::L8 : PixelFormat::RGB8, name,
                                           least_file_bytes(width, height), bytes.size());
    if (!image) {
        return image.error();
    }
    // A warning is corrupt or missing data, filled with grey. The scan limit stops files that are small and
    // slow.
    constexpr int kFlags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
    if (tjDecompress2(jpeg.get(), bytes.data(), bytes.size(), image->data.data(), width, /*pitch=*/0, height,
                      is_grey ? TJPF_GRAY : TJPF_RGB, kFlags) != 0) {
        return damaged_image(name, "JPEG", tjGetErrorStr2(jpeg.get()));
    }
    return image;
}

} // namespace cl
