// The string token: escapes and UTF-8.

#include "core/utf8.h"
#include "core/variant/tokenizer.h"

#include <algorithm>

namespace cl {
namespace {

/// 0 to 15, -1 for other characters.
int hex_digit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// Reads four hexadecimal digits at `p`; -1 if there are not four.
int hex4(const char* p, const char* end) {
    if (end - p < 4) {
        return -1;
    }
    int value = 0;
    for (int i = 0; i < 4; i++) {
        if (hex_digit(p[i]) < 0) {
            return -1;
        }
        value = value * 16 + hex_digit(p[i]);
    }
    return value;
}

} // namespace

void Tokenizer::lex_string(Token& token) {
    const char* const end = text_end();
    p_++;
    while (p_ != end && *p_ != '"') {
        const char* const stop = std::find_if(p_, end, [](char c) { return c == '"' || c == '\\'; });
        token.string.append(p_, stop);
        p_ = stop;
        if (p_ != end && *p_ == '\\' && !lex_escape(token.string, token.offset)) {
            token.kind = TokenKind::Invalid;
            return;
        }
    }
    if (p_ == end) {
        token.kind = TokenKind::Invalid;
        fail(token.offset, "expected a closing '\"' for this string, found end of text");
        return;
    }
    p_++;
    token.kind = TokenKind::String;
    token.raw = text_.substr(token.offset, offset_of(p_) - token.offset);
    if (!is_utf8(token.string)) {
        remark(token.offset, "expected UTF-8, found other bytes in a string: they are replaced");
        token.string = utf8_repaired(token.string);
    }
}

bool Tokenizer::lex_escape(std::string& out, size_t token_offset) {
    p_++; // the backslash
    if (p_ == text_end()) {
        return fail(token_offset, "expected a closing '\"' for this string, found end of text");
    }
    const char c = *p_++;
    switch (c) {
    case 'b':
        out += '\b';
        return true;
    case 't':
        out += '\t';
        return true;
    case 'n':
        out += '\n';
        return true;
    case 'f':
        out += '\f';
        return true;
    case 'r':
        out += '\r';
        return true;
    case 'u':
        return lex_unicode_escape(out);
    default:
        out += c;
        return true;
    }
}

bool Tokenizer::lex_unicode_escape(std::string& out) {
    const int unit = hex4(p_, text_end());
    if (unit < 0) {
        return fail(offset_of(p_) - 2, "expected four hexadecimal digits after \\u in a string");
    }
    p_ += 4;
    uint32_t code_point = static_cast<uint32_t>(unit);
    const bool is_high_surrogate = unit >= 0xd800 && unit < 0xdc00;
    if (is_high_surrogate && text_end() - p_ >= 6 && p_[0] == '\\' && p_[1] == 'u') {
        const int low = hex4(p_ + 2, text_end());
        if (low >= 0xdc00 && low < 0xe000) {
            code_point =
                0x10000u + (static_cast<uint32_t>(unit - 0xd800) << 10) + static_cast<uint32_t>(low - 0xdc00);
            p_ += 6;
        }
    }
    append_utf8(out, code_point);
    return true;
}

} // namespace cl
