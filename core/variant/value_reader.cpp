#include "core/variant/value_reader.h"

#include <fmt/format.h>

#include <array>
#include <limits>

namespace cl {
namespace {

using Type = Variant::Type;

struct ConstructorName {
    std::string_view name;
    Type type;
};

// The constructors that are named after their type, with the names that older files use.
constexpr ConstructorName kTypeConstructors[] = {
    {"Vector2", Type::Vector2},
    {"Rect2", Type::Rect2},
    {"Vector3", Type::Vector3},
    {"Transform2D", Type::Transform2D},
    {"Matrix32", Type::Transform2D},
    {"Plane", Type::Plane},
    {"Quat", Type::Quat},
    {"AABB", Type::AABB},
    {"Rect3", Type::AABB},
    {"Basis", Type::Basis},
    {"Matrix3", Type::Basis},
    {"Transform", Type::Transform},
    {"Color", Type::Color},
    {"NodePath", Type::NodePath},
    {"RID", Type::RID},
    {"Object", Type::Object},
    {"PoolByteArray", Type::PoolByteArray},
    {"ByteArray", Type::PoolByteArray},
    {"PoolIntArray", Type::PoolIntArray},
    {"IntArray", Type::PoolIntArray},
    {"PoolRealArray", Type::PoolRealArray},
    {"FloatArray", Type::PoolRealArray},
    {"PoolStringArray", Type::PoolStringArray},
    {"StringArray", Type::PoolStringArray},
    {"PoolVector2Array", Type::PoolVector2Array},
    {"Vector2Array", Type::PoolVector2Array},
    {"PoolVector3Array", Type::PoolVector3Array},
    {"Vector3Array", Type::PoolVector3Array},
    {"PoolColorArray", Type::PoolColorArray},
    {"ColorArray", Type::PoolColorArray},
};

/// Nil if `name` is none of them.
Type constructed_type(std::string_view name) {
    for (const ConstructorName& constructor : kTypeConstructors) {
        if (constructor.name == name) {
            return constructor.type;
        }
    }
    return Type::Nil;
}

} // namespace

bool ValueReader::read(Variant& out) {
    if (depth_ >= kMaxTextDepth) {
        return tokenizer_.fail(tokenizer_.peek().offset,
                               fmt::format("expected at most {} nested values, found more", kMaxTextDepth));
    }
    depth_++;
    const bool done = read_token_value(out);
    depth_--;
    return done;
}

bool ValueReader::read_token_value(Variant& out) {
    const Token& token = tokenizer_.peek();
    switch (token.kind) {
    case TokenKind::String:
        out = tokenizer_.take().string;
        return true;
    case TokenKind::Integer:
        out = token.integer;
        tokenizer_.advance();
        return true;
    case TokenKind::Real:
        out = token.real;
        tokenizer_.advance();
        return true;
    case TokenKind::Color:
        return read_color(out);
    case TokenKind::Identifier:
        return read_identifier(out);
    default:
        break;
    }
    if (take_if('[')) {
        return read_array(out);
    }
    if (take_if('{')) {
        return read_dictionary(out);
    }
    return tokenizer_.fail_expected("a value");
}

bool ValueReader::read_array(Variant& out) {
    Array array;
    while (!take_if(']')) {
        if (!read(array.emplace_back())) {
            return false;
        }
        if (!take_if(',') && !tokenizer_.peek().is(']')) {
            return tokenizer_.fail_expected("',' or ']' in an array");
        }
    }
    array.shrink_to_fit();
    out = std::move(array);
    return true;
}

bool ValueReader::read_dictionary(Variant& out) {
    Dictionary dictionary;
    while (!take_if('}')) {
        Variant key, value;
        if (!read(key)) {
            return false;
        }
        if (!take_if(':')) {
            return tokenizer_.fail_expected("':' after a dictionary's key");
        }
        if (!read(value)) {
            return false;
        }
        dictionary.set(std::move(key), std::move(value));
        if (!take_if(',') && !tokenizer_.peek().is('}')) {
            return tokenizer_.fail_expected("',' or '}' in a dictionary");
        }
    }
    out = std::move(dictionary);
    return true;
}

/// "#rgb", "#argb", "#rrggbb" or "#aarrggbb"; another count of digits is black with a remark, as in Godot.
bool ValueReader::read_color(Variant& out) {
    const Token token = tokenizer_.take();
    const std::string_view digits = token.raw.substr(1);
    const bool is_short = digits.size() == 3 || digits.size() == 4;
    if (!is_short && digits.size() != 6 && digits.size() != 8) {
        tokenizer_.remark(token.offset,
                          fmt::format("expected a colour of 3, 4, 6 or 8 digits, found {}: black is taken",
                                      token.describe()));
        out = Color{};
        return true;
    }
    const size_t digits_per_channel = is_short ? 1 : 2;
    std::array<float, 4> argb{1.0f, 1.0f, 1.0f, 1.0f};
    const size_t channels = digits.size() / digits_per_channel;
    for (size_t i = 0; i < channels; i++) {
        const std::string text(digits.substr(i * digits_per_channel, digits_per_channel));
        const long value = std::strtol(text.c_str(), nullptr, 16);
        argb[4 - channels + i] = static_cast<float>(is_short ? value * 17 : value) / 255.0f;
    }
    out = Color{argb[1], argb[2], argb[3], argb[0]};
    return true;
}

bool ValueReader::is_named_number(std::string_view identifier, double& out) noexcept {
    if (identifier == "inf") {
        out = std::numeric_limits<double>::infinity();
        return true;
    }
    if (identifier == "nan") {
        out = std::numeric_limits<double>::quiet_NaN();
        return true;
    }
    return false;
}

bool ValueReader::read_identifier(Variant& out) {
    const Token token = tokenizer_.take();
    const std::string_view name = token.raw;
    double number = 0.0;
    if (name == "true" || name == "false") {
        out = name == "true";
    } else if (name == "null" || name == "nil") {
        out = Variant();
    } else if (is_named_number(name, number)) {
        out = number;
    } else {
        return read_constructor(name, token.offset, out);
    }
    return true;
}

bool ValueReader::read_constructor(std::string_view name, size_t offset, Variant& out) {
    const Type type = constructed_type(name);
    switch (type) {
    case Type::Nil:
        break;
    case Type::NodePath: {
        std::string path;
        const bool done = read_string_argument(name, path);
        out = NodePath(path);
        return done;
    }
    case Type::RID:
        return read_rid(out);
    case Type::Object:
        return read_object(offset, out);
    default:
        return type >= Type::PoolByteArray ? read_pool(type, name, out) : read_components(type, name, out);
    }
    if (name == "ExtResource") {
        return read_resource_id(name, offset, options_.ext_resource, out);
    }
    if (name == "SubResource") {
        return read_resource_id(name, offset, options_.sub_resource, out);
    }
    if (name == "Resource") {
        return read_resource_path(offset, out);
    }
    if (name == "InputEvent") {
        return read_input_event(offset, out);
    }
    const bool is_call = tokenizer_.peek().is('(');
    return tokenizer_.fail(offset, fmt::format("expected a value, found {} '{}'",
                                               is_call ? "unknown constructor" : "identifier", name));
}

bool ValueReader::take_if(char punctuation) {
    if (!tokenizer_.peek().is(punctuation)) {
        return false;
    }
    tokenizer_.advance();
    return true;
}

bool ValueReader::fail_expected_in(std::string_view name, std::string_view what) {
    return tokenizer_.fail_expected(what, name);
}

bool ValueReader::expect(char punctuation, std::string_view inside_of) {
    return take_if(punctuation) || fail_expected_in(inside_of, fmt::format("'{}'", punctuation));
}

bool ValueReader::read_number(std::string_view name, double& out) {
    const Token& token = tokenizer_.peek();
    if (token.is_number()) {
        out = token.real;
    } else if (token.kind != TokenKind::Identifier || !is_named_number(token.raw, out)) {
        return fail_expected_in(name, "a number");
    }
    tokenizer_.advance();
    return true;
}

bool ValueReader::read_integer(std::string_view name, int64_t& out) {
    if (tokenizer_.peek().kind != TokenKind::Integer) {
        return fail_expected_in(name, "an integer");
    }
    out = tokenizer_.take().integer;
    return true;
}

} // namespace cl
