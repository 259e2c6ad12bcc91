#pragma once

#include <png.h>

#include <array>
#include <cstring>

namespace cl {

/// What libpng said last. libpng reports errors by longjmp, so every function that calls setjmp() holds only
/// plain values, and what owns memory lives in its caller.
struct PngMessage {
    std::array<char, 160> text{};
};

/// libpng's error callback; its error pointer is a PngMessage.
[[noreturn]] inline void png_keep_error(png_structp png, png_const_charp text) {
    auto* message = static_cast<PngMessage*>(png_get_error_ptr(png));
    std::strncpy(message->text.data(), text, message->text.size() - 1);
    png_longjmp(png, 1);
}

/// Warnings are about ancillary chunks, which are not read.
inline void png_ignore_warning(png_structp, png_const_charp) {}

} // namespace cl
