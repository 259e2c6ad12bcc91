// The constructors that stand for objects: ExtResource, SubResource, Resource, Object, InputEvent.

#include "core/object/object.h"
#include "core/variant/value_reader.h"

#include <fmt/format.h>

namespace cl {
namespace {

/// The object of a class that we do not have: it only keeps what the text says of it.
Variant make_declared_object(const std::string& class_name, const std::vector<TextProperty>& properties) {
    Ref<Reference> object(new Reference);
    object->set_declared_class(StringName(class_name));
    for (const TextProperty& property : properties) {
        object->set(StringName(property.name), property.value);
    }
    return object;
}

} // namespace

bool ValueReader::accept(Expected<Variant> made, size_t offset, Variant& out) {
    if (made) {
        out = *std::move(made);
        return true;
    }
    Error error = std::move(made).error();
    if (error.where.line == 0 && error.where.file.empty()) {
        error.where = tokenizer_.location(offset);
    }
    return tokenizer_.fail(std::move(error));
}

bool ValueReader::read_resource_id(std::string_view name, size_t offset,
                                   const std::function<Expected<Variant>(int64_t)>& find, Variant& out) {
    int64_t id = 0;
    if (!expect('(', name) || !read_integer(name, id) || !expect(')', name)) {
        return false;
    }
    if (!find) {
        return tokenizer_.fail(
            offset,
            fmt::format("expected a value that needs no other file or section, found {}( {} )", name, id));
    }
    return accept(find(id), offset, out);
}

bool ValueReader::read_resource_path(size_t offset, Variant& out) {
    std::string path;
    if (!read_string_argument("Resource", path)) {
        return false;
    }
    if (!options_.resource) {
        return tokenizer_.fail(
            offset,
            fmt::format("expected a value that needs no other file or section, found Resource( \"{}\" )",
                        path));
    }
    return accept(options_.resource(path), offset, out);
}

bool ValueReader::make_object(const std::string& class_name, std::vector<TextProperty> properties,
                              size_t offset, Variant& out) {
    if (options_.object) {
        return accept(options_.object(class_name, std::move(properties)), offset, out);
    }
    out = make_declared_object(class_name, properties);
    return true;
}

bool ValueReader::read_property(TextProperty& out) {
    if (tokenizer_.peek().kind != TokenKind::String) {
        return fail_expected_in("Object", "a property name in quotes or ')'");
    }
    out.name = tokenizer_.take().string;
    return expect(':', "Object") && read(out.value);
}

bool ValueReader::read_object(size_t offset, Variant& out) {
    if (!expect('(', "Object")) {
        return false;
    }
    if (tokenizer_.peek().kind != TokenKind::Identifier) {
        return fail_expected_in("Object", "a class name");
    }
    std::string class_name(tokenizer_.take().raw);
    std::vector<TextProperty> properties;
    while (!take_if(')')) {
        if (!take_if(',')) {
            return fail_expected_in("Object", "',' or ')'");
        }
        if (tokenizer_.peek().is(')')) {
            continue; // a trailing comma
        }
        if (!read_property(properties.emplace_back())) {
            return false;
        }
    }
    return make_object(class_name, std::move(properties), offset, out);
}

/// The legacy form `InputEvent( KEY, 65, S )` of Godot 2, as the object that took its place.
bool ValueReader::read_input_event(size_t offset, Variant& out) {
    constexpr std::string_view kName = "InputEvent";
    if (!expect('(', kName)) {
        return false;
    }
    const std::string_view kind = tokenizer_.peek().raw;
    std::vector<TextProperty> properties;
    const auto read_index = [&](const char* property) {
        int64_t index = 0;
        const bool done = expect(',', kName) && read_integer(kName, index);
        properties.push_back({property, index});
        return done;
    };
    std::string class_name;
    bool done = true;
    if (kind != "NONE" && kind != "KEY" && kind != "MBUTTON" && kind != "JBUTTON" && kind != "JAXIS") {
        return fail_expected_in(kName, "NONE, KEY, MBUTTON, JBUTTON or JAXIS");
    }
    tokenizer_.advance();
    if (kind == "KEY") {
        class_name = "InputEventKey";
        done = read_input_event_key(properties);
    } else if (kind == "MBUTTON" || kind == "JBUTTON") {
        class_name = kind == "MBUTTON" ? "InputEventMouseButton" : "InputEventJoypadButton";
        done = read_index("button_index");
    } else if (kind == "JAXIS") {
        class_name = "InputEventJoypadMotion";
        double value = 0.0;
        done = read_index("axis") && expect(',', kName) && read_number(kName, value);
        properties.push_back({"axis_value", value});
    }
    if (!done || !expect(')', kName)) {
        return false;
    }
    if (class_name.empty()) {
        out = ObjectRef();
        return true;
    }
    return make_object(class_name, std::move(properties), offset, out);
}

/// `, key [, modifiers]`: the key as a number or a name, the modifiers as letters of S(hift) A(lt) C(ontrol)
/// M(eta).
bool ValueReader::read_input_event_key(std::vector<TextProperty>& properties) {
    constexpr std::string_view kName = "InputEvent";
    if (!expect(',', kName)) {
        return false;
    }
    const Token key = tokenizer_.take();
    if (key.kind == TokenKind::Integer) {
        properties.push_back({"scancode", key.integer});
    } else if (key.kind == TokenKind::Identifier && key.raw.size() == 1) {
        properties.push_back(
            {"scancode", static_cast<int>(key.raw[0] & ~0x20)}); // letters: the code of the capital
    } else if (key.kind == TokenKind::Identifier) {
        tokenizer_.remark(key.offset,
                          fmt::format("expected a key code, found the key name {}: it is only kept as text",
                                      key.describe()));
        properties.push_back({"scancode", key.raw});
    } else {
        return key.kind != TokenKind::Invalid &&
               tokenizer_.fail(key.offset, fmt::format("InputEvent: expected a key code or name, found {}",
                                                       key.describe()));
    }
    if (!take_if(',')) {
        return true;
    }
    const Token modifiers = tokenizer_.peek();
    if (modifiers.kind != TokenKind::Identifier ||
        modifiers.raw.find_first_not_of("SACM") != std::string_view::npos) {
        return fail_expected_in(kName, "modifiers out of S, A, C and M");
    }
    tokenizer_.advance();
    static constexpr std::pair<char, const char*> kModifiers[] = {
        {'S', "shift"}, {'A', "alt"}, {'C', "control"}, {'M', "meta"}};
    for (const auto& [letter, property] : kModifiers) {
        if (modifiers.raw.find(letter) != std::string_view::npos) {
            properties.push_back({property, true});
        }
    }
    return true;
}

} // namespace cl
