#pragma once

#include "core/variant/variant_parser.h"

#include <span>

namespace cl {

/// Recursive descent over one value; the inside of VariantReader. Functions return false after an error,
/// which the tokenizer holds.
class ValueReader {
public:
    ValueReader(Tokenizer& tokenizer, const VariantReadOptions& options)
        : tokenizer_(tokenizer), options_(options) {}

    bool read(Variant& out);

private:
    bool read_token_value(Variant& out);
    bool read_array(Variant& out);
    bool read_dictionary(Variant& out);
    bool read_color(Variant& out);
    bool read_identifier(Variant& out);
    bool read_constructor(std::string_view name, size_t offset, Variant& out);

    // value_constructors.cpp
    bool read_components(Variant::Type type, std::string_view name, Variant& out);
    bool fail_count(std::string_view name, int expected, std::string_view found);
    bool read_rid(Variant& out);
    bool read_string_argument(std::string_view constructor, std::string& out);

    // value_pools.cpp
    bool read_pool(Variant::Type type, std::string_view name, Variant& out);
    template <typename T>
    bool read_element(std::string_view name, const char*& p, T& out);
    template <typename T>
    bool read_numbers(std::string_view name, std::vector<T>& out);
    bool read_strings(std::string_view name, std::vector<std::string>& out);

    // value_objects.cpp
    bool read_resource_id(std::string_view name, size_t offset,
                          const std::function<Expected<Variant>(int64_t)>& find, Variant& out);
    bool read_resource_path(size_t offset, Variant& out);
    bool read_object(size_t offset, Variant& out);
    bool read_property(TextProperty& out);
    bool read_input_event(size_t offset, Variant& out);
    bool read_input_event_key(std::vector<TextProperty>& properties);
    bool make_object(const std::string& class_name, std::vector<TextProperty> properties, size_t offset,
                     Variant& out);
    /// Moves a callback's value out, or fails with its error placed at `offset`.
    bool accept(Expected<Variant> made, size_t offset, Variant& out);

    /// Takes the next token if it is `punctuation`.
    bool take_if(char punctuation);
    bool expect(char punctuation, std::string_view inside_of);
    /// A number, or inf or nan with an optional sign, as an argument of constructor `name`.
    bool read_number(std::string_view name, double& out);
    bool read_integer(std::string_view name, int64_t& out);
    /// The identifiers inf and nan.
    static bool is_named_number(std::string_view identifier, double& out) noexcept;
    bool fail_expected_in(std::string_view name, std::string_view what);

    Tokenizer& tokenizer_;
    const VariantReadOptions& options_;
    int depth_ = 0;
};

} // namespace cl
