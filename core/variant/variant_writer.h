#pragma once

#include "core/variant/real_text.h"
#include "core/variant/variant.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace cl {

struct VariantWriteOptions {
    TextStyle style = TextStyle::Exact;
    /// Text of an object that is saved elsewhere, such as "ExtResource( 1 )"; std::nullopt (or no function)
    /// writes it in place as `Object(Class,"property":value,...)`.
    std::function<std::optional<std::string>(const Reference&)> object_text;
};

/// The value as scene files spell it (tscn format, section 7; Godot's var2str): dictionaries with one entry a
/// line and sorted keys, strings with raw newlines. What is nested more than kMaxWriteDepth deep (an object
/// that contains itself) is written as null.
[[nodiscard]] std::string variant_to_text(const Variant& value, const VariantWriteOptions& options = {});
void append_variant(std::string& out, const Variant& value, const VariantWriteOptions& options);
inline constexpr int kMaxWriteDepth = 300;

/// The value for a person to read: what Godot's str() gives ("(1, 2, 3)", "True", "[1, a]"). Objects:
/// "[Class]".
[[nodiscard]] std::string variant_to_str(const Variant& value);

/// `text` in quotes as a String value: only \ and " are escaped.
void append_quoted(std::string& out, std::string_view text);
/// `text` in quotes with C escapes: field values of a tag, elements of a PoolStringArray, node paths.
void append_c_quoted(std::string& out, std::string_view text, TextStyle style);
/// A property name left of '=': quoted if a reader would not take it for one name otherwise.
[[nodiscard]] std::string property_key_text(std::string_view name);

} // namespace cl
