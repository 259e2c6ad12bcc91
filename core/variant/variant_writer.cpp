#include "core/variant/variant_writer.h"

#include "core/object/object.h"
#include "core/variant/variant_compare.h"
#include "core/variant/variant_components.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace cl {
namespace {

using Type = Variant::Type;

class Writer {
public:
    Writer(std::string& out, const VariantWriteOptions& options) : out_(out), options_(options) {}

    void write(const Variant& value) {
        if (depth_ >= kMaxWriteDepth) {
            out_ += "null";
            return;
        }
        depth_++;
        write_any(value);
        depth_--;
    }

private:
    void write_any(const Variant& value) {
        switch (value.type()) {
        case Type::Nil:
            out_ += "null";
            return;
        case Type::Bool:
            out_ += value.to_bool() ? "true" : "false";
            return;
        case Type::Int:
            out_ += std::to_string(value.to_int());
            return;
        case Type::Real:
            append_real(out_, value.to_real(), options_.style);
            return;
        case Type::String:
            append_quoted(out_, *value.get_if<std::string>());
            return;
        case Type::NodePath:
            out_ += "NodePath(";
            append_c_quoted(out_, value.get_if<NodePath>()->to_string(), options_.style);
            out_ += ')';
            return;
        case Type::RID:
            out_ += "RID( " + std::to_string(value.get_if<TextRID>()->id) + " )";
            return;
        case Type::Object:
            write_object(value.to_object());
            return;
        case Type::Dictionary:
            write_dictionary(*value.get_if<Dictionary>());
            return;
        case Type::Array:
            write_array(*value.get_if<Array>());
            return;
        case Type::PoolByteArray:
            return write_list(value, value.get_if<PoolByteArray>()->span());
        case Type::PoolIntArray:
            return write_list(value, value.get_if<PoolIntArray>()->span());
        case Type::PoolRealArray:
            return write_list(value, value.get_if<PoolRealArray>()->span());
        case Type::PoolStringArray:
            return write_list(value, value.get_if<PoolStringArray>()->span());
        case Type::PoolVector2Array:
            return write_list(value, value.get_if<PoolVector2Array>()->span());
        case Type::PoolVector3Array:
            return write_list(value, value.get_if<PoolVector3Array>()->span());
        case Type::PoolColorArray:
            return write_list(value, value.get_if<PoolColorArray>()->span());
        default:
            return write_list(value, components_of(value).span());
        }
    }

    /// `Type( a, b )`; without elements `Type(  )`.
    template <typename T>
    void write_list(const Variant& value, std::span<const T> elements) {
        out_ += type_name(value.type());
        out_ += "( ";
        for (size_t i = 0; i < elements.size(); i++) {
            out_ += i > 0 ? ", " : "";
            write_element(elements[i]);
        }
        out_ += " )";
    }

    void write_element(uint8_t v) { write_element(static_cast<int32_t>(v)); }
    void write_element(int32_t v) {
        const fmt::format_int digits(v);
        out_.append(digits.data(), digits.size());
    }
    void write_element(float v) { append_component(out_, v, options_.style); }
    void write_element(const std::string& v) { append_c_quoted(out_, v, options_.style); }
    void write_element(glm::vec2 v) { write_numbers({v.x, v.y}); }
    void write_element(const glm::vec3& v) { write_numbers({v.x, v.y, v.z}); }
    void write_element(const Color& v) { write_numbers({v.r, v.g, v.b, v.a}); }
    void write_numbers(std::initializer_list<float> numbers) {
        for (const float* n = numbers.begin(); n != numbers.end(); n++) {
            out_ += n != numbers.begin() ? ", " : "";
            write_element(*n);
        }
    }

    void write_array(const Array& array) {
        out_ += "[ ";
        for (size_t i = 0; i < array.size(); i++) {
            out_ += i > 0 ? ", " : "";
            write(array[i]);
        }
        out_ += " ]";
    }

    void write_dictionary(const Dictionary& dictionary) {
        const std::vector<Dictionary::Entry>& entries = dictionary.entries();
        std::vector<size_t> order(entries.size());
        std::iota(order.begin(), order.end(), size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](size_t a, size_t b) { return key_less(entries[a].first, entries[b].first); });
        out_ += "{\n";
        for (const size_t i : order) {
            out_ += i != order.front() ? ",\n" : "";
            write(entries[i].first);
            out_ += ": ";
            write(entries[i].second);
        }
        out_ += "\n}";
    }

    void write_object(Reference* object) {
        if (!object) {
            out_ += "null";
            return;
        }
        if (options_.object_text) {
            if (const std::optional<std::string> text = options_.object_text(*object)) {
                out_ += *text;
                return;
            }
        }
        out_ += "Object(" + object->class_name().str();
        for (const Object::PropertyValue& property : object->stored_properties()) {
            out_ += ',';
            append_quoted(out_, property.name.view());
            out_ += ':';
            write(property.value);
        }
        out_ += ")\n"; // the newline is Godot's
    }

    std::string& out_;
    const VariantWriteOptions& options_;
    int depth_ = 0;
};

/// Letter after the backslash in a C escape of `c`, 0 if `c` is written as it is.
char c_escape_letter(char c, TextStyle style) {
    switch (c) {
    case '\\':
    case '"':
    case '\'':
    case '?':
        return c;
    case '\b':
        return 'b';
    case '\t':
        return 't';
    case '\n':
        return 'n';
    case '\f':
        return 'f';
    case '\r':
        return 'r';
    // Godot writes these two but reads them back as the letters a and v.
    case '\a':
        return style == TextStyle::Godot ? 'a' : '\0';
    case '\v':
        return style == TextStyle::Godot ? 'v' : '\0';
    default:
        return '\0';
    }
}

} // namespace

void append_variant(std::string& out, const Variant& value, const VariantWriteOptions& options) {
    Writer(out, options).write(value);
}

std::string variant_to_text(const Variant& value, const VariantWriteOptions& options) {
    std::string out;
    append_variant(out, value, options);
    return out;
}

void append_quoted(std::string& out, std::string_view text) {
    out += '"';
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    out += '"';
}

void append_c_quoted(std::string& out, std::string_view text, TextStyle style) {
    out += '"';
    for (const char c : text) {
        if (const char letter = c_escape_letter(c, style)) {
            out += '\\';
            out += letter;
        } else {
            out += c;
        }
    }
    out += '"';
}

std::string property_key_text(std::string_view name) {
    const bool plain = !name.empty() && name[0] != '[' && std::all_of(name.begin(), name.end(), [](char c) {
        return c > ' ' && c < 127 && c != '=' && c != '"' && c != ';';
    });
    if (plain) {
        return std::string(name);
    }
    std::string quoted;
    append_quoted(quoted, name);
    return quoted;
}

} // namespace cl
