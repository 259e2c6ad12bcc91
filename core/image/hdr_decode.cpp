// Radiance HDR pictures. Source: the description of the file format in the Radiance reference manual, section
// "Picture file format", with both ways of run lengths. Not stb_image, which loops forever on a truncated
// file.

#include "core/image/codecs.h"

#include <charconv>
#include <cmath>
#include <optional>

namespace cl {

namespace {

// Widths whose scanlines may be stored as four channels of runs.
constexpr int kMinChannelWidth = 8;
constexpr int kMaxChannelWidth = 32767;

struct HdrHeader {
    int64_t width = 0;
    int64_t height = 0;
    size_t pixels_at = 0; ///< offset of the first scanline
};

/// The line at `at`, which moves behind it; std::nullopt if there is no whole line.
std::optional<std::string_view> next_line(std::string_view text, size_t& at) {
    const size_t end = text.find('\n', at);
    if (end == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    return line;
}

bool take_text(std::string_view& line, std::string_view text) {
    if (line.substr(0, text.size()) != text) {
        return false;
    }
    line.remove_prefix(text.size());
    return true;
}

bool take_number(std::string_view& line, int64_t& value) {
    const auto result = std::from_chars(line.data(), line.data() + line.size(), value);
    line.remove_prefix(static_cast<size_t>(result.ptr - line.data()));
    return result.ec == std::errc();
}

/// Lines up to an empty one, then "-Y height +X width", the only orientation that is in use.
Expected<HdrHeader> read_header(std::string_view text, std::string_view name) {
    HdrHeader header;
    std::optional<std::string_view> line;
    while ((line = next_line(text, header.pixels_at)) && !line->empty()) {
        if (take_text(*line, "FORMAT=") && *line != "32-bit_rle_rgbe") {
            return Error{ErrorCode::Unsupported,
                         "expected the HDR format 32-bit_rle_rgbe, found another",
                         {std::string(name)}};
        }
    }
    std::optional<std::string_view> size = next_line(text, header.pixels_at);
    if (!size) {
        return damaged_image(name, "HDR", "the header ends early");
    }
    if (!take_text(*size, "-Y ") || !take_number(*size, header.height) || !take_text(*size, " +X ") ||
        !take_number(*size, header.width) || !size->empty()) {
        return damaged_image(name, "HDR", "expected \"-Y height +X width\" after the header");
    }
    return header;
}

/// Decodes scanlines one after the other to bytes r, g, b, exponent.
class ScanlineReader {
public:
    ScanlineReader(std::span<const uint8_t> bytes, size_t width) : rest_(bytes), width_(width) {}

    /// Fills `out`, 4 bytes a pixel. nullptr, or what is wrong.
    const char* read(std::span<uint8_t> out) {
        const bool has_channels = width_ >= kMinChannelWidth && width_ <= kMaxChannelWidth &&
                                  rest_.size() >= 4 && rest_[0] == 2 && rest_[1] == 2 && rest_[2] < 128;
        return has_channels ? read_channels(out) : read_pixels(out);
    }

private:
    static constexpr const char* kEndsEarly = "the data ends early";

    /// Each channel on its own: a count above 128 repeats the next byte, another is followed by that many
    /// bytes.
    const char* read_channels(std::span<uint8_t> out) {
        if (size_t{rest_[2]} * 256 + rest_[3] != width_) {
            return "a scanline of another width";
        }
        rest_ = rest_.subspan(4);
        for (size_t channel = 0; channel < 4; ++channel) {
            for (size_t x = 0; x < width_;) {
                if (rest_.size() < 2) {
                    return kEndsEarly;
                }
                const bool repeats = rest_[0] > 128;
                const size_t count = repeats ? rest_[0] - size_t{128} : rest_[0];
                const size_t bytes = repeats ? 1 : count;
                if (count == 0 || count > width_ - x) {
                    return "a run longer than its scanline";
                }
                if (rest_.size() < 1 + bytes) {
                    return kEndsEarly;
                }
                for (size_t i = 0; i < count; ++i, ++x) {
                    out[x * 4 + channel] = rest_[1 + (repeats ? 0 : i)];
                }
                rest_ = rest_.subspan(1 + bytes);
            }
        }
        return nullptr;
    }

    /// Whole pixels; 1, 1, 1, n repeats the one before n times, and the next such mark 256 n times, and so
    /// on.
    const char* read_pixels(std::span<uint8_t> out) {
        unsigned shift = 0;
        for (size_t x = 0; x < width_;) {
            if (rest_.size() < 4) {
                return kEndsEarly;
            }
            const std::span<const uint8_t> pixel = rest_.first(4);
            rest_ = rest_.subspan(4);
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                std::copy(pixel.begin(), pixel.end(), out.begin() + static_cast<std::ptrdiff_t>(x * 4));
                ++x;
                shift = 0;
                continue;
            }
            const size_t count = shift < 32 ? size_t{pixel[3]} << shift : width_;
            if (x == 0 || count > width_ - x) {
                return "a run longer than its scanline";
            }
            for (size_t i = 0; i < count * 4; ++i) {
                out[x * 4 + i] = out[(x - 1) * 4 + i % 4];
            }
            x += count;
            shift += 8;
        }
        return nullptr;
    }

    std::span<const uint8_t> rest_;
    size_t width_;
};

void store_rgb(std::span<const uint8_t> rgbe, std::span<float> rgb) {
    for (size_t x = 0; x < rgb.size() / 3; ++x) {
        const int exponent = rgbe[x * 4 + 3];
        const float scale = exponent == 0 ? 0.0f : std::ldexp(1.0f, exponent - (128 + 8));
        for (size_t c = 0; c < 3; ++c) {
            rgb[x * 3 + c] = static_cast<float>(rgbe[x * 4 + c]) * scale;
        }
    }
}

} // namespace

Expected<Image> decode_hdr(std::span<const uint8_t> bytes, std::string_view name) {
    const Expected<HdrHeader> header =
        read_header({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
    if (!header) {
        return header.error();
    }
    // At best a scanline is one pixel and a few marks that repeat it.
    const uint64_t least_bytes = header->height > 0 ? static_cast<uint64_t>(header->height) * 4 : 0;
    Expected<Image> image =
        allocate_image(header->width, header->height, PixelFormat::RGBF, name, least_bytes, bytes.size());
    if (!image) {
        return image.error();
    }
    const auto width = static_cast<size_t>(header->width);
    ScanlineReader reader(bytes.subspan(header->pixels_at), width);
    std::vector<uint8_t> scanline(width * 4);
    for (size_t y = 0; y < static_cast<size_t>(header->height); ++y) {
        if (const char* fault = reader.read(scanline)) {
            return damaged_image(name, "HDR", fault);
        }
        store_rgb(scanline, image->floats().subspan(y * width * 3, width * 3));
    }
    return image;
}

} // namespace cl
