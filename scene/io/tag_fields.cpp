#include "scene/io/tag_fields.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace cl::scene {

namespace {

std::optional<int64_t> int_in(const Variant& value) {
    if (value.is_num()) {
        return value.to_int();
    }
    const std::string* text = value.get_if<std::string>();
    if (!text) {
        return std::nullopt;
    }
    int64_t number = 0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
    return error == std::errc() && end == text->data() + text->size() ? std::optional<int64_t>(number)
                                                                      : std::nullopt;
}

} // namespace

void TagFields::fail_type(const TextTag::Field& field, std::string_view expected) {
    if (status_) {
        status_ = Error{ErrorCode::ParseError,
                        fmt::format("expected {} as \"{}\" of [{}], found {}", expected, field.name,
                                    tag_.name, type_name(field.value.type())),
                        field.value_where};
    }
}

const TextTag::Field* TagFields::required(std::string_view name) {
    const TextTag::Field* field = tag_.find(name);
    if (!field && status_) {
        status_ =
            Error{ErrorCode::ParseError,
                  fmt::format("expected a field \"{}\" in [{}], found none", name, tag_.name), tag_.where};
    }
    return field;
}

std::string TagFields::required_text(std::string_view name) {
    return required(name) ? text_or_empty(name) : std::string();
}

std::string TagFields::text_or_empty(std::string_view name) {
    const TextTag::Field* field = tag_.find(name);
    if (!field) {
        return {};
    }
    if (const std::string* text = field->value.get_if<std::string>()) {
        return *text;
    }
    if (const NodePath* path = field->value.get_if<NodePath>()) {
        return path->to_string();
    }
    fail_type(*field, "a String");
    return {};
}

int64_t TagFields::required_int(std::string_view name) {
    return required(name) ? int_or(name, 0) : 0;
}

int64_t TagFields::int_or(std::string_view name, int64_t otherwise) {
    const TextTag::Field* field = tag_.find(name);
    if (!field) {
        return otherwise;
    }
    const std::optional<int64_t> number = int_in(field->value);
    if (!number) {
        fail_type(*field, "an int");
    }
    return number.value_or(otherwise);
}

std::vector<std::string> TagFields::texts(std::string_view name) {
    std::vector<std::string> result;
    const TextTag::Field* field = tag_.find(name);
    if (!field) {
        return result;
    }
    const std::optional<Variant> list = field->value.converted_to(Variant::Type::PoolStringArray);
    if (!list) {
        fail_type(*field, "an Array of Strings");
        return result;
    }
    const auto texts = list->get_if<PoolStringArray>()->span();
    result.assign(texts.begin(), texts.end());
    return result;
}

Array TagFields::array(std::string_view name) {
    const TextTag::Field* field = tag_.find(name);
    if (!field) {
        return {};
    }
    if (const Array* list = field->value.get_if<Array>()) {
        return *list;
    }
    fail_type(*field, "an Array");
    return {};
}

} // namespace cl::scene
