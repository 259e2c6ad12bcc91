// The constructors with a fixed number of arguments: mathematical types, NodePath, RID.

#include "core/variant/value_reader.h"
#include "core/variant/variant_components.h"

#include <fmt/format.h>

#include <array>

namespace cl {

bool ValueReader::fail_count(std::string_view name, int expected, std::string_view found) {
    return tokenizer_.fail(tokenizer_.peek().offset,
                           fmt::format("{}: expected {} numbers, found {}", name, expected, found));
}

bool ValueReader::read_components(Variant::Type type, std::string_view name, Variant& out) {
    const int count = component_count(type);
    std::array<float, 12> numbers{};
    if (!expect('(', name)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        if (i > 0 && !take_if(',')) {
            return tokenizer_.peek().is(')') ? fail_count(name, count, std::to_string(i))
                                             : fail_expected_in(name, "','");
        }
        double number = 0.0;
        if (!read_number(name, number)) {
            return false;
        }
        numbers[static_cast<size_t>(i)] = static_cast<float>(number);
    }
    if (tokenizer_.peek().is(',')) {
        return fail_count(name, count, "more");
    }
    out = from_components(type, numbers);
    return expect(')', name);
}

/// `RID( n )` is just the number, as in Godot.
bool ValueReader::read_rid(Variant& out) {
    double number = 0.0;
    if (!expect('(', "RID")) {
        return false;
    }
    const bool is_integer = tokenizer_.peek().kind == TokenKind::Integer;
    const int64_t integer = tokenizer_.peek().integer;
    if (!read_number("RID", number)) {
        return false;
    }
    out = is_integer ? Variant(integer) : Variant(number);
    return expect(')', "RID");
}

bool ValueReader::read_string_argument(std::string_view constructor, std::string& out) {
    if (!expect('(', constructor)) {
        return false;
    }
    if (tokenizer_.peek().kind != TokenKind::String) {
        return fail_expected_in(constructor, "a string");
    }
    out = tokenizer_.take().string;
    return expect(')', constructor);
}

} // namespace cl
