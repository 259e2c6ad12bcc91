#include "core/variant/variant_parser.h"

#include "core/utf8.h"
#include "core/variant/value_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace cl {
namespace {

bool is_blank(char c) {
    return static_cast<unsigned char>(c) <= 32;
}

} // namespace

const TextTag::Field* TextTag::find(std::string_view field) const noexcept {
    const auto found =
        std::find_if(fields.rbegin(), fields.rend(), [&](const Field& f) { return f.name == field; });
    return found == fields.rend() ? nullptr : &*found;
}

VariantReader::VariantReader(std::string_view text, std::string file, VariantReadOptions options)
    : options_(std::move(options)), tokenizer_(text, std::move(file), options_.diagnostics) {}

Expected<TextItem> VariantReader::next_item(TagSyntax syntax) {
    TextItem item;
    if (tokenizer_.failed() || !read_item(syntax, item)) {
        return tokenizer_.error();
    }
    return item;
}

Expected<Variant> VariantReader::read_value() {
    Variant value;
    if (tokenizer_.failed() || !ValueReader(tokenizer_, options_).read(value)) {
        return tokenizer_.error();
    }
    return value;
}

Status VariantReader::expect_end() {
    if (tokenizer_.failed() ||
        (tokenizer_.peek().kind != TokenKind::End && !tokenizer_.fail_expected("end of text"))) {
        return tokenizer_.error();
    }
    return {};
}

SourceLocation VariantReader::location() {
    return tokenizer_.location(tokenizer_.peek().offset);
}

bool VariantReader::read_item(TagSyntax syntax, TextItem& out) {
    tokenizer_.skip_blank();
    const char* const p = tokenizer_.position();
    if (p == tokenizer_.text_end()) {
        out = std::monostate();
        return true;
    }
    if (*p != '[') {
        return read_assignment(out.emplace<TextAssignment>());
    }
    TextTag& tag = out.emplace<TextTag>();
    tag.where = tokenizer_.location(tokenizer_.offset_of(p));
    tokenizer_.set_position(p + 1);
    if (!(syntax == TagSyntax::Heading ? read_heading(tag) : read_tag(tag))) {
        return false;
    }
    tag.raw = std::string_view(p, static_cast<size_t>(tokenizer_.position() - p));
    return true;
}

bool VariantReader::read_heading(TextTag& tag) {
    const char* const start = tokenizer_.position();
    const char* const close = std::find(start, tokenizer_.text_end(), ']');
    if (close == tokenizer_.text_end()) {
        return tokenizer_.fail(tokenizer_.offset_of(close),
                               "expected ']' after a section's name, found end of text");
    }
    tag.name = std::string(start, close);
    tokenizer_.set_position(close + 1);
    return true;
}

bool VariantReader::read_tag(TextTag& tag) {
    do {
        if (tokenizer_.peek().kind != TokenKind::Identifier) {
            return tokenizer_.fail_expected("the name of a tag");
        }
        tag.name += tokenizer_.take().raw;
        if (!tokenizer_.peek().is('.') && !tokenizer_.peek().is(':')) {
            break;
        }
        tag.name += tokenizer_.take().raw;
    } while (true);
    while (!tokenizer_.peek().is(']')) {
        if (!read_field(tag)) {
            return false;
        }
    }
    tokenizer_.advance();
    return true;
}

bool VariantReader::read_field(TextTag& tag) {
    if (tokenizer_.peek().kind != TokenKind::Identifier) {
        return tokenizer_.fail_expected(fmt::format("a field or ']' in tag [{}]", tag.name));
    }
    TextTag::Field& field = tag.fields.emplace_back();
    field.where = location();
    field.name = tokenizer_.take().raw;
    if (!tokenizer_.peek().is('=')) {
        return tokenizer_.fail_expected(
            fmt::format("'=' after field '{}' of tag [{}]", field.name, tag.name));
    }
    tokenizer_.advance();
    field.value_where = location();
    return ValueReader(tokenizer_, options_).read(field.value);
}

bool VariantReader::read_assignment(TextAssignment& assignment) {
    assignment.where = tokenizer_.location(tokenizer_.offset_of(tokenizer_.position()));
    if (!read_key(assignment.key)) {
        return false;
    }
    const Token& first = tokenizer_.peek();
    const size_t value_offset = first.offset;
    const bool is_number = first.is_number() || first.raw == "inf" || first.raw == "nan";
    assignment.value_where = tokenizer_.location(value_offset);
    if (!ValueReader(tokenizer_, options_).read(assignment.value)) {
        return false;
    }
    assignment.raw = tokenizer_.text_between(value_offset, tokenizer_.offset_of(tokenizer_.position()));
    if (is_number) {
        skip_rest_of_number(value_offset);
    }
    return true;
}

/// All characters above code 32 up to '='. A string replaces what stands before it, as in Godot.
bool VariantReader::read_key(std::string& key) {
    const char* const end = tokenizer_.text_end();
    const size_t start = tokenizer_.offset_of(tokenizer_.position());
    bool has_gap = false;
    for (;;) {
        const char* const before = tokenizer_.position();
        tokenizer_.skip_blank();
        const char* const p = tokenizer_.position();
        if (p == end) {
            return tokenizer_.fail(tokenizer_.offset_of(p),
                                   fmt::format("expected '=' after '{}', found end of text", key));
        }
        if (*p == '=') {
            tokenizer_.set_position(p + 1);
            break;
        }
        has_gap = has_gap || (p != before && !key.empty());
        if (*p == '"') {
            if (tokenizer_.peek().kind != TokenKind::String) {
                return false;
            }
            key = tokenizer_.take().string;
            continue;
        }
        const char* const stop =
            std::find_if(p, end, [](char c) { return is_blank(c) || c == '=' || c == '"' || c == ';'; });
        key.append(p, stop);
        tokenizer_.set_position(stop);
    }
    if (!is_utf8(key)) {
        key = utf8_repaired(key);
    }
    if (has_gap || key.empty()) {
        tokenizer_.remark(
            start, key.empty()
                       ? "expected a property name, found '='"
                       : fmt::format("expected a property name without gaps, found one read as '{}'", key));
    }
    return true;
}

/// Godot stops reading "0x10" after the 0 and adds "x10" to the next key, which loses that property. We drop
/// the rest, unless it is the key of an assignment on the same line (`a=1b=2`).
void VariantReader::skip_rest_of_number(size_t value_offset) {
    const char* const end = tokenizer_.text_end();
    const char* const start = tokenizer_.position();
    const auto ends_word = [](char c) {
        return is_blank(c) || std::string_view("=;[]{}(),\"").find(c) != std::string_view::npos;
    };
    const char* const stop = std::find_if(start, end, ends_word);
    if (stop == start) {
        return;
    }
    const char* const next = std::find_if(stop, end, [](char c) { return c != ' ' && c != '\t'; });
    if (next != end && *next == '=') {
        return;
    }
    tokenizer_.remark(value_offset,
                      fmt::format("expected a number, found one followed by '{}', which is left out",
                                  utf8_repaired(std::string_view(
                                      start, static_cast<size_t>(std::min<ptrdiff_t>(stop - start, 32))))));
    tokenizer_.set_position(stop);
}

Expected<Variant> parse_variant(std::string_view text, std::string file, VariantReadOptions options) {
    VariantReader reader(text, std::move(file), std::move(options));
    Expected<Variant> value = reader.read_value();
    if (!value) {
        return value;
    }
    if (Status end = reader.expect_end(); !end) {
        return end.error();
    }
    return value;
}

} // namespace cl
