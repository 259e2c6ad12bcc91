#pragma once

#include "core/diagnostics.h"
#include "core/expected.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cl {

enum class TokenKind {
    End,
    Punctuation, ///< one of { } [ ] ( ) : , . =
    Identifier,
    String,
    Integer,
    Real,
    Color,   ///< '#' and hexadecimal digits, of any length
    Unknown, ///< a character that starts no token
    Invalid, ///< a damaged string; Tokenizer::error() says what is wrong
};

struct Token {
    TokenKind kind = TokenKind::End;
    size_t offset = 0;    ///< of its first byte in the text
    std::string_view raw; ///< as written
    std::string string;   ///< String: decoded, valid UTF-8
    int64_t integer = 0;  ///< Integer
    double real = 0.0;    ///< Integer and Real: the value

    [[nodiscard]] bool is(char punctuation) const noexcept {
        return kind == TokenKind::Punctuation && raw[0] == punctuation;
    }
    [[nodiscard]] bool is_number() const noexcept {
        return kind == TokenKind::Integer || kind == TokenKind::Real;
    }
    /// For the "found ..." of a message: "','", "string \"abc\"", "end of text".
    [[nodiscard]] std::string describe() const;
};

/// Splits the text format (tscn format, section 2) into tokens, one ahead of its reader, and knows the place
/// of each. Also holds the first error of the whole reading and passes remarks on.
class Tokenizer {
public:
    /// `text` must outlive the tokenizer. A byte order mark at its start is skipped. `diagnostics` may be
    /// null.
    Tokenizer(std::string_view text, std::string file, Diagnostics* diagnostics);

    /// The next token, which stays the next one until advance().
    [[nodiscard]] const Token& peek();
    void advance() { has_next_ = false; }
    /// peek() and advance(): for tokens whose string is wanted without a copy.
    [[nodiscard]] Token take();

    // Reading characters instead of tokens, for lists of numbers and for keys. Not between peek() and
    // advance().
    [[nodiscard]] const char* position() const;
    [[nodiscard]] const char* text_end() const noexcept { return text_.data() + text_.size(); }
    void set_position(const char* position);
    /// Skips white space (codes up to 32) and comments.
    void skip_blank();
    [[nodiscard]] size_t offset_of(const char* position) const noexcept {
        return static_cast<size_t>(position - text_.data());
    }
    [[nodiscard]] std::string_view text_between(size_t start, size_t end) const noexcept {
        return text_.substr(start, end - start);
    }

    /// Line and column count from 1; columns count code points, a tab is one. Cheap for places that ascend.
    [[nodiscard]] SourceLocation location(size_t offset);

    /// Keeps the first error and returns false, for `return tokenizer.fail(...)`.
    bool fail(size_t offset, std::string message, ErrorCode code = ErrorCode::ParseError);
    /// "expected {what}, found {the next token}" at that token, behind "{constructor}: " if that is given.
    bool fail_expected(std::string_view what, std::string_view constructor = {});
    bool fail(Error error);
    [[nodiscard]] const Error& error() const;
    [[nodiscard]] bool failed() const noexcept { return error_.has_value(); }

    /// A warning about something that was read nevertheless. Only the first kMaxRemarks are kept.
    void remark(size_t offset, std::string message);
    static constexpr int kMaxRemarks = 100;

private:
    void lex(Token& token);
    void lex_string(Token& token);
    bool lex_escape(std::string& out, size_t token_offset);
    bool lex_unicode_escape(std::string& out);
    bool lex_signed_name(Token& token); // "-inf" and "-nan"
    void lex_number(Token& token);
    void lex_run(Token& token, TokenKind kind, bool (*belongs)(char));

    std::string_view text_;
    std::string file_;
    Diagnostics* diagnostics_;
    const char* p_; // where the next token, or blanks before it, starts
    Token next_;
    bool has_next_ = false;
    std::optional<Error> error_;
    int remarks_ = 0;
    struct Place { // the last place that location() worked out
        size_t offset = 0;
        int line = 1;
        int column = 1;
    } place_;
};

} // namespace cl
