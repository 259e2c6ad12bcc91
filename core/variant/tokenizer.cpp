#include "core/variant/tokenizer.h"

#include "core/utf8.h"
#include "core/variant/number_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace cl {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool is_blank(char c) {
    return static_cast<unsigned char>(c) <= 32;
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_identifier_start(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_identifier_part(char c) {
    return is_identifier_start(c) || is_digit(c);
}

bool is_hex_digit(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/// At most kMaxShown characters of `text`, control characters and damaged UTF-8 made visible.
std::string shown(std::string_view text) {
    constexpr size_t kMaxShown = 32;
    const bool cut = text.size() > kMaxShown;
    if (cut) {
        text = text.substr(0, kMaxShown);
        while (!text.empty() && !is_utf8(text)) { // do not cut within a sequence, but give up on real damage
            text.remove_suffix(1);
            if (text.size() + 4 < kMaxShown) {
                break;
            }
        }
    }
    std::string out;
    for (const char c : utf8_repaired(text)) {
        out += is_blank(c) && c != ' ' ? '.' : c;
    }
    return cut ? out + "..." : out;
}

} // namespace

std::string Token::describe() const {
    switch (kind) {
    case TokenKind::End:
        return "end of text";
    case TokenKind::String:
        return "string \"" + shown(string) + '"';
    case TokenKind::Integer:
    case TokenKind::Real:
        return "number " + shown(raw);
    case TokenKind::Unknown:
        return utf8_sequence_length(raw) != raw.size() || (raw.size() == 1 && (raw[0] & 0x7f) == 0x7f)
                   ? fmt::format("byte 0x{:02x}", static_cast<unsigned char>(raw[0]))
                   : '\'' + std::string(raw) + '\'';
    default:
        return '\'' + shown(raw) + '\'';
    }
}

Tokenizer::Tokenizer(std::string_view text, std::string file, Diagnostics* diagnostics)
    : text_(text), file_(std::move(file)), diagnostics_(diagnostics) {
    if (text_.starts_with(kByteOrderMark)) {
        text_.remove_prefix(kByteOrderMark.size());
    }
    p_ = text_.data();
}

const Token& Tokenizer::peek() {
    if (!has_next_) {
        lex(next_);
        has_next_ = true;
    }
    return next_;
}

Token Tokenizer::take() {
    static_cast<void>(peek());
    has_next_ = false;
    return std::move(next_);
}

const char* Tokenizer::position() const {
    CL_ASSERT(!has_next_, "the tokenizer is already past the next token");
    return p_;
}

void Tokenizer::set_position(const char* position) {
    CL_ASSERT(!has_next_, "the tokenizer is already past the next token");
    p_ = position;
}

void Tokenizer::skip_blank() {
    CL_ASSERT(!has_next_, "the tokenizer is already past the next token");
    const char* const end = text_end();
    while (p_ != end && (is_blank(*p_) || *p_ == ';')) {
        p_ = *p_ == ';' ? std::find(p_, end, '\n') : p_ + 1;
    }
}

void Tokenizer::lex(Token& token) {
    skip_blank();
    token.offset = offset_of(p_);
    token.string.clear();
    if (p_ == text_end()) {
        token.kind = TokenKind::End;
        token.raw = {};
        return;
    }
    const char c = *p_;
    const char after = p_ + 1 != text_end() ? p_[1] : '\0';
    if (is_identifier_start(c)) {
        return lex_run(token, TokenKind::Identifier, is_identifier_part);
    }
    if (c == '"') {
        return lex_string(token);
    }
    if ((c == '-' || c == '+') && lex_signed_name(token)) {
        return;
    }
    // A '-' is a number even when no digit follows, as in Godot.
    if (is_digit(c) || c == '-' || (c == '+' && (is_digit(after) || after == '.')) ||
        (c == '.' && is_digit(after))) {
        return lex_number(token);
    }
    if (c == '#') {
        return lex_run(token, TokenKind::Color, is_hex_digit);
    }
    const bool is_punctuation = std::strchr("{}[]():,.=", c) != nullptr; // c is not '\0': that is blank
    token.kind = is_punctuation ? TokenKind::Punctuation : TokenKind::Unknown;
    const std::string_view rest = text_.substr(token.offset, 4);
    token.raw = rest.substr(0, std::max<size_t>(1, utf8_sequence_length(rest)));
    p_ += token.raw.size();
}

void Tokenizer::lex_run(Token& token, TokenKind kind, bool (*belongs)(char)) {
    const char* const start = p_;
    p_ = std::find_if_not(p_ + 1, text_end(), belongs);
    token.kind = kind;
    token.raw = text_.substr(token.offset, static_cast<size_t>(p_ - start));
}

bool Tokenizer::lex_signed_name(Token& token) {
    const std::string_view rest = text_.substr(token.offset + 1);
    const bool infinite = rest.starts_with("inf");
    if ((!infinite && !rest.starts_with("nan")) || (rest.size() > 3 && is_identifier_part(rest[3]))) {
        return false;
    }
    const size_t tail = rest.substr(3).starts_with(".0") ? 2 : 0; // Godot writes -inf.0
    token.kind = TokenKind::Real;
    token.raw = text_.substr(token.offset, 4 + tail);
    const double magnitude =
        infinite ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    token.real = *p_ == '-' && infinite ? -magnitude : magnitude;
    p_ += token.raw.size();
    return true;
}

void Tokenizer::lex_number(Token& token) {
    const ScannedNumber number = scan_number(p_, text_end());
    if (number.end == p_) { // "+." and the like
        token.kind = TokenKind::Unknown;
        token.raw = text_.substr(token.offset, 1);
        p_++;
        return;
    }
    token.kind = number.is_real ? TokenKind::Real : TokenKind::Integer;
    token.integer = number.integer;
    token.real = number.real;
    token.raw = text_.substr(token.offset, static_cast<size_t>(number.end - p_));
    p_ = number.end;
    if (number.note == ScannedNumber::Note::Saturated) {
        remark(token.offset, fmt::format("expected an integer of 64 bits, found {}: {} is taken",
                                         shown(token.raw), number.integer));
    } else if (number.note == ScannedNumber::Note::NoDigits) {
        remark(token.offset, "expected digits after '-', found none: 0 is taken");
    }
}

SourceLocation Tokenizer::location(size_t offset) {
    if (offset < place_.offset) {
        place_ = {};
    }
    const std::string_view passed = text_.substr(place_.offset, offset - place_.offset);
    const auto newlines = std::count(passed.begin(), passed.end(), '\n');
    const size_t line_start = newlines > 0 ? passed.rfind('\n') + 1 : 0;
    const std::string_view on_line = passed.substr(line_start);
    const auto continuations = std::count_if(on_line.begin(), on_line.end(), is_utf8_continuation);
    place_.line += static_cast<int>(newlines);
    place_.column = (newlines > 0 ? 1 : place_.column) + static_cast<int>(on_line.size()) -
                    static_cast<int>(continuations);
    place_.offset = offset;
    return {file_, place_.line, place_.column};
}

bool Tokenizer::fail(size_t offset, std::string message, ErrorCode code) {
    return fail(Error{code, std::move(message), location(offset)});
}

bool Tokenizer::fail(Error error) {
    if (!error_) {
        error_ = std::move(error);
    }
    return false;
}

bool Tokenizer::fail_expected(std::string_view what, std::string_view constructor) {
    const Token& found = peek();
    if (found.kind == TokenKind::Invalid) {
        return false; // reported where it was read
    }
    return fail(found.offset, fmt::format("{}{}expected {}, found {}", constructor,
                                          constructor.empty() ? "" : ": ", what, found.describe()));
}

const Error& Tokenizer::error() const {
    CL_ASSERT(error_, "error() of a tokenizer that met none");
    return *error_;
}

void Tokenizer::remark(size_t offset, std::string message) {
    if (diagnostics_ && remarks_ < kMaxRemarks) {
        remarks_++;
        diagnostics_->warn(location(offset), std::move(message));
    }
}

} // namespace cl
