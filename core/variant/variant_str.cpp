// variant_to_str: values for a person to read, spelled as Godot's str() does.

#include "core/object/object.h"
#include "core/variant/variant_components.h"
#include "core/variant/variant_writer.h"

#include <algorithm>
#include <utility>

namespace cl {
namespace {

using Type = Variant::Type;

class StrWriter {
public:
    std::string text;

    void write(const Variant& value) {
        if (depth_ >= kMaxWriteDepth) {
            text += "...";
            return;
        }
        depth_++;
        write_any(value);
        depth_--;
    }

private:
    void write_any(const Variant& value) {
        const Components c = components_of(value);
        switch (value.type()) {
        case Type::Nil:
            text += "Null";
            return;
        case Type::Bool:
            text += value.to_bool() ? "True" : "False";
            return;
        case Type::Int:
            text += std::to_string(value.to_int());
            return;
        case Type::Real:
            append_shown_real(text, value.to_real());
            return;
        case Type::String:
            text += *value.get_if<std::string>();
            return;
        case Type::NodePath:
            text += value.get_if<NodePath>()->to_string();
            return;
        case Type::RID:
            text += "[RID]";
            return;
        case Type::Object:
            write_object(value.to_object());
            return;
        case Type::Plane:
            return write_numbers(c.span(), ", ");
        case Type::Color:
            return write_numbers(c.span(), ",");
        case Type::AABB:
            return write_two_parts(c.span(), 3);
        case Type::Transform:
            return write_two_parts(c.span(), 9);
        case Type::Transform2D:
            return write_rows(c.span(), 2);
        case Type::Basis:
            return write_rows(c.span(), 3);
        case Type::Dictionary:
            return write_dictionary(*value.get_if<Dictionary>());
        case Type::Array:
            return write_array(*value.get_if<Array>());
        case Type::PoolIntArray:
            return write_list(value.get_if<PoolIntArray>()->span());
        case Type::PoolRealArray:
            return write_list(value.get_if<PoolRealArray>()->span());
        case Type::PoolStringArray:
            return write_list(value.get_if<PoolStringArray>()->span());
        case Type::PoolVector2Array:
            return write_list(value.get_if<PoolVector2Array>()->span());
        case Type::PoolVector3Array:
            return write_list(value.get_if<PoolVector3Array>()->span());
        case Type::PoolByteArray:
        case Type::PoolColorArray:
            text += '[' + std::string(type_name(value.type())) + ']';
            return;
        default:
            return write_tuple(c.span()); // Vector2, Rect2, Vector3, Quat
        }
    }

    void write_numbers(std::span<const float> numbers, std::string_view separator) {
        for (size_t i = 0; i < numbers.size(); i++) {
            text += i > 0 ? separator : "";
            append_shown_real(text, numbers[i]);
        }
    }

    /// "(1, 2, 3)"
    void write_tuple(std::span<const float> numbers) {
        text += '(';
        write_numbers(numbers, ", ");
        text += ')';
    }

    /// "1, 2, 3 - 4, 5, 6"
    void write_two_parts(std::span<const float> numbers, size_t first_count) {
        write_numbers(numbers.first(first_count), ", ");
        text += " - ";
        write_numbers(numbers.subspan(first_count), ", ");
    }

    /// "((1, 2), (3, 4))"
    void write_rows(std::span<const float> numbers, size_t row_length) {
        text += '(';
        for (size_t i = 0; i < numbers.size(); i += row_length) {
            text += i > 0 ? ", " : "";
            write_tuple(numbers.subspan(i, row_length));
        }
        text += ')';
    }

    /// "[1, a]"
    template <typename T>
    void write_list(std::span<const T> elements) {
        text += '[';
        for (size_t i = 0; i < elements.size(); i++) {
            text += i > 0 ? ", " : "";
            write_any(Variant(elements[i]));
        }
        text += ']';
    }

    void write_array(const Array& array) {
        if (array.empty()) {
            text += is_first_empty() ? "[]" : "[...]";
            return;
        }
        text += '[';
        for (size_t i = 0; i < array.size(); i++) {
            text += i > 0 ? ", " : "";
            write(array[i]);
        }
        text += ']';
    }

    /// "{a:1, b:2}", sorted by the text of the keys.
    void write_dictionary(const Dictionary& dictionary) {
        if (dictionary.size() == 0) {
            text += is_first_empty() ? "{}" : "{...}";
            return;
        }
        std::vector<std::pair<std::string, std::string>> entries;
        for (const auto& [key, value] : dictionary.entries()) {
            std::string key_text = text_of(key);
            entries.emplace_back(std::move(key_text), text_of(value));
        }
        std::stable_sort(entries.begin(), entries.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        text += '{';
        for (size_t i = 0; i < entries.size(); i++) {
            text += (i > 0 ? ", " : "") + entries[i].first + ':' + entries[i].second;
        }
        text += '}';
    }

    std::string text_of(const Variant& value) {
        std::string saved = std::move(text);
        text.clear();
        write(value);
        std::swap(saved, text);
        return saved;
    }

    /// Godot guards against containers that contain themselves, but takes all empty ones for the same: from
    /// the second on it shows them as "...".
    bool is_first_empty() { return !std::exchange(empty_seen_, true); }

    void write_object(const Reference* object) {
        text += '[' + (object ? object->class_name().str() : "Object:null") + ']';
    }

    int depth_ = 0;
    bool empty_seen_ = false;
};

} // namespace

std::string variant_to_str(const Variant& value) {
    StrWriter writer;
    writer.write(value);
    return std::move(writer.text);
}

} // namespace cl
