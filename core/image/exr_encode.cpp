#include "core/image/codecs.h"
#include "core/image/exr_stream.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <fmt/core.h>

namespace cl {

namespace {

std::vector<uint8_t> encode(const Image& image) {
    constexpr const char* kNames[] = {"R", "G", "B", "A"};
    const auto channels = static_cast<size_t>(channel_count(image.format));
    Imf::Header header(image.size.x, image.size.y);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (size_t c = 0; c < channels; ++c) {
        header.channels().insert(kNames[c], Imf::Channel(Imf::FLOAT));
        // The slice is only read from, but its type serves reading files too.
        auto* first = const_cast<char*>(reinterpret_cast<const char*>(image.floats().data() + c));
        frame.insert(kNames[c], Imf::Slice(Imf::FLOAT, first, channels * sizeof(float),
                                           channels * sizeof(float) * static_cast<size_t>(image.size.x)));
    }
    ExrOutput output;
    {
        Imf::OutputFile file(output, header, /*numThreads=*/0);
        file.setFrameBuffer(frame);
        file.writePixels(image.size.y);
    } // writes the table of offsets
    return output.take();
}

} // namespace

Expected<std::vector<uint8_t>> encode_exr(const Image& image) {
    if (!is_float_format(image.format)) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("expected a float image for EXR, found {}", format_name(image.format))};
    }
    if (const Status valid = check_image_data(image); !valid) {
        return valid.error();
    }
    if (channel_count(image.format) < 3) { // viewers expect colour
        return encode_exr(image.converted_to(PixelFormat::RGBF));
    }
    try {
        return encode(image);
    } catch (const std::exception& e) {
        return Error{ErrorCode::IoError, fmt::format("cannot write EXR: {}", e.what())};
    }
}

} // namespace cl
