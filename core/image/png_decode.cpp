#include "core/image/codecs.h"
#include "core/image/png_error.h"

#include <png.h>

#include <csetjmp>
#include <cstring>

namespace cl {

namespace {

constexpr uint64_t kMaxDeflateRatio = 1032; // deflate makes at most so many bytes of one

void read_bytes(png_structp png, png_bytep out, size_t count) {
    auto* rest = static_cast<std::span<const uint8_t>*>(png_get_io_ptr(png));
    if (count > rest->size()) {
        png_error(png, "the data ends early");
    }
    std::memcpy(out, rest->data(), count);
    *rest = rest->subspan(count);
}

/// Owns libpng's reading state.
class PngReader {
public:
    explicit PngReader(std::span<const uint8_t> bytes)
        : rest_(bytes),
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, png_keep_error, png_ignore_warning)),
          info_(png_ ? png_create_info_struct(png_) : nullptr) {
        if (info_) {
            png_set_read_fn(png_, &rest_, read_bytes);
        }
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    [[nodiscard]] bool is_open() const noexcept { return info_ != nullptr; }
    [[nodiscard]] const char* message() const noexcept { return message_.text.data(); }

    /// Reads up to the pixels and asks for 8-bit grey, grey-alpha, RGB or RGBA rows. False on an error.
    [[nodiscard]] bool read_header() {
        if (setjmp(png_jmpbuf(png_))) { // NOLINT(cert-err52-cpp): libpng returns errors this way
            return false;
        }
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // allocate_image() has ours
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_read_info(png_, info_);
        file_row_bytes_ = png_get_rowbytes(png_, info_);
        png_set_expand(png_); // palettes, 1, 2 and 4 bit, transparent colours
        png_set_scale_16(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    /// Reads all rows and what follows them. False on an error.
    [[nodiscard]] bool read_rows(uint8_t** rows) {
        if (setjmp(png_jmpbuf(png_))) { // NOLINT(cert-err52-cpp)
            return false;
        }
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }

    // Valid after read_header().
    [[nodiscard]] uint32_t width() const { return png_get_image_width(png_, info_); }
    [[nodiscard]] uint32_t height() const { return png_get_image_height(png_, info_); }
    [[nodiscard]] uint64_t least_file_bytes() const { return file_row_bytes_ * height() / kMaxDeflateRatio; }
    [[nodiscard]] PixelFormat format() const {
        constexpr PixelFormat kFormats[] = {PixelFormat::L8, PixelFormat::LA8, PixelFormat::RGB8,
                                            PixelFormat::RGBA8};
        const int channels = png_get_channels(png_, info_);
        CL_ASSERT(channels >= 1 && channels <= 4, "libpng gives 1 to 4 channels");
        return kFormats[channels - 1];
    }

private:
    PngMessage message_;
    std::span<const uint8_t> rest_;
    png_structp png_;
    png_infop info_;
    uint64_t file_row_bytes_ = 0;
};

} // namespace

Expected<Image> decode_png(std::span<const uint8_t> bytes, std::string_view name) {
    PngReader reader(bytes);
    if (!reader.is_open()) {
        return Error{ErrorCode::OutOfMemory, "no memory for a PNG reader", {std::string(name)}};
    }
    if (!reader.read_header()) {
        return damaged_image(name, "PNG", reader.message());
    }
    Expected<Image> image = allocate_image(reader.width(), reader.height(), reader.format(), name,
                                           reader.least_file_bytes(), bytes.size());
    if (!image) {
        return image.error();
    }
    const size_t row_bytes = image->data.size() / static_cast<size_t>(image->size.y);
    std::vector<uint8_t*> rows(static_cast<size_t>(image->size.y));
    for (size_t y = 0; y < rows.size(); ++y) {
        rows[y] = image->data.data() + y * row_bytes;
    }
    if (!reader.read_rows(rows.data())) {
        return damaged_image(name, "PNG", reader.message());
    }
    return image;
}

} // namespace cl
