#include "core/image/codecs.h"
#include "core/image/exr_stream.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfTestFile.h>
#include <fmt/core.h>

#include <array>
#include <mutex>
#include <optional>

namespace cl {

namespace {

// The format that packs best per block, PIZ, needs a few bytes for 32 lines of one value, and each block has
// an 8-byte place in a table and an 8-byte head.
constexpr uint64_t kLinesOfBlock = 256;
constexpr uint64_t kLeastBytesOfBlock = 16;

constexpr int kMaxTileEdge = 4096; // OpenEXR keeps a buffer of one tile, however small the picture is

/// Names of the file's channels for r, g, b and, if the image has it, a.
struct ChannelNames {
    std::array<const char*, 4> names{};
    PixelFormat format = PixelFormat::RGBF;
};

bool has_channel(const Imf::ChannelList& channels, const char* name) {
    const Imf::Channel* channel = channels.findChannel(name);
    return channel && channel->xSampling == 1 && channel->ySampling == 1;
}

/// std::nullopt if there is neither colour nor brightness at full resolution.
std::optional<ChannelNames> choose_channels(const Imf::ChannelList& channels) {
    ChannelNames chosen;
    if (has_channel(channels, "R") && has_channel(channels, "G") && has_channel(channels, "B")) {
        chosen.names = {"R", "G", "B"};
    } else if (has_channel(channels, "Y") && !channels.findChannel("RY") && !channels.findChannel("BY")) {
        chosen.names = {"Y", "Y", "Y"};
    } else {
        return std::nullopt;
    }
    if (has_channel(channels, "A")) {
        chosen.names[3] = "A";
        chosen.format = PixelFormat::RGBAF;
    }
    return chosen;
}

/// Reads the channels into the image, half and 32-bit integers as float.
void read_pixels(Imf::InputFile& file, const ChannelNames& chosen, Image& image) {
    const IMATH_NAMESPACE::Box2i window = file.header().dataWindow();
    const std::span<float> floats = image.floats();
    const auto channels = static_cast<size_t>(channel_count(image.format));
    const bool is_grey = chosen.names[0] == chosen.names[1];
    Imf::FrameBuffer frame;
    for (size_t c = 0; c < channels; ++c) {
        if (is_grey && (c == 1 || c == 2)) {
            continue; // a frame buffer takes a channel once
        }
        frame.insert(chosen.names[c],
                     Imf::Slice::Make(Imf::FLOAT, floats.data() + c, window, channels * sizeof(float),
                                      channels * sizeof(float) * static_cast<size_t>(image.size.x)));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    for (size_t i = 0; is_grey && i < floats.size(); i += channels) {
        floats[i + 1] = floats[i + 2] = floats[i];
    }
}

Expected<Image> decode(std::span<const uint8_t> bytes, std::string_view name) {
    ExrInput input(bytes, name);
    Imf::InputFile file(input, /*numThreads=*/0);
    const std::optional<ChannelNames> chosen = choose_channels(file.header().channels());
    if (!chosen) {
        return Error{ErrorCode::Unsupported,
                     "expected EXR channels R, G, B or Y at full resolution, found none",
                     {std::string(name)}};
    }
    // 64 bit: corners of a damaged window may lie anywhere.
    const IMATH_NAMESPACE::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    const uint64_t blocks = height > 0 ? static_cast<uint64_t>(height) / kLinesOfBlock : 0;
    Expected<Image> image =
        allocate_image(width, height, chosen->format, name, blocks * kLeastBytesOfBlock, bytes.size());
    if (image) {
        read_pixels(file, *chosen, *image);
    }
    return image;
}

} // namespace

Expected<Image> decode_exr(std::span<const uint8_t> bytes, std::string_view name) {
    // OpenEXR's own limits keep its buffers within ours; they are global, so they are set once.
    static std::once_flag once;
    std::call_once(once, [] {
        Imf::Header::setMaxImageSize(kMaxImageEdge, kMaxImageEdge);
        Imf::Header::setMaxTileSize(kMaxTileEdge, kMaxTileEdge);
    });
    try {
        return decode(bytes, name);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::OutOfMemory, "no memory to read EXR", {std::string(name)}};
    } catch (const std::exception& e) {
        return damaged_image(name, "EXR", e.what());
    }
}

} // namespace cl
