#pragma once

#include "core/variant/variant_parser.h"
#include "core/variant/variant_writer.h"

#include <string>
#include <string_view>

namespace cl::tests {

/// The value of a text that is one value; the text of the error, in quotes, if it is none.
inline Variant read(std::string_view text) {
    const Expected<Variant> value = parse_variant(text);
    return value ? *value : Variant("error: " + value.error().message);
}

/// "line:column: error: message", or "no error".
inline std::string error_of(std::string_view text, VariantReadOptions options = {}) {
    const Expected<Variant> value = parse_variant(text, {}, std::move(options));
    return value ? "no error" : value.error().to_string();
}

/// The warnings of reading a file of tags and assignments, one a line; ends with the error if there is one.
inline std::string remarks_of(std::string_view text) {
    Diagnostics diagnostics;
    VariantReadOptions options;
    options.diagnostics = &diagnostics;
    VariantReader reader(text, "", options);
    std::string error;
    for (;;) {
        const Expected<TextItem> item = reader.next_item();
        if (!item) {
            error = item.error().to_string() + '\n';
        }
        if (!item || std::holds_alternative<std::monostate>(*item)) {
            break;
        }
    }
    std::string out;
    for (const Warning& warning : diagnostics.warnings()) {
        out += warning.to_string() + '\n';
    }
    return out + error;
}

/// A file of assignments as "key=value" lines, with values as the writer spells them.
inline std::string assignments_of(std::string_view text) {
    VariantReader reader(text, "");
    std::string out;
    for (;;) {
        const Expected<TextItem> item = reader.next_item();
        if (!item) {
            return out + item.error().to_string();
        }
        if (std::holds_alternative<std::monostate>(*item)) {
            return out;
        }
        if (const auto* assignment = std::get_if<TextAssignment>(&*item)) {
            out += assignment->key + '=' + variant_to_text(assignment->value) + '\n';
        }
    }
}

inline VariantWriteOptions as_godot() {
    VariantWriteOptions options;
    options.style = TextStyle::Godot;
    return options;
}

} // namespace cl::tests
