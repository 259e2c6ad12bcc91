#include "core/utf8.h"

namespace cl {

void append_utf8(std::string& out, uint32_t code_point) {
    if (code_point > 0x10ffff || (code_point >= 0xd800 && code_point < 0xe000)) {
        code_point = 0xfffd;
    }
    const auto byte = [&](uint32_t bits) { out += static_cast<char>(bits); };
    const auto tail = [&](int shift) { byte(0x80 | ((code_point >> shift) & 0x3f)); };
    if (code_point < 0x80) {
        byte(code_point);
    } else if (code_point < 0x800) {
        byte(0xc0 | (code_point >> 6));
        tail(0);
    } else if (code_point < 0x10000) {
        byte(0xe0 | (code_point >> 12));
        tail(6);
        tail(0);
    } else {
        byte(0xf0 | (code_point >> 18));
        tail(12);
        tail(6);
        tail(0);
    }
}

size_t utf8_sequence_length(std::string_view text) noexcept {
    if (text.empty()) {
        return 0;
    }
    const auto at = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = at(0);
    if (lead < 0x80) {
        return 1;
    }
    const size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < length) {
        return 0;
    }
    for (size_t i = 1; i < length; i++) {
        if (!is_utf8_continuation(text[i])) {
            return 0;
        }
    }
    // The second byte decides about overlong forms, surrogates and what lies beyond U+10FFFF.
    const bool refused = (lead == 0xe0 && at(1) < 0xa0) || (lead == 0xed && at(1) > 0x9f) ||
                         (lead == 0xf0 && at(1) < 0x90) || (lead == 0xf4 && at(1) > 0x8f);
    return refused ? 0 : length;
}

bool is_utf8(std::string_view text) noexcept {
    while (!text.empty()) {
        const size_t length = utf8_sequence_length(text);
        if (length == 0) {
            return false;
        }
        text.remove_prefix(length);
    }
    return true;
}

std::string utf8_repaired(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const size_t length = utf8_sequence_length(text);
        if (length == 0) {
            append_utf8(out, 0xfffd);
            text.remove_prefix(1);
        } else {
            out += text.substr(0, length);
            text.remove_prefix(length);
        }
    }
    return out;
}

} // namespace cl
