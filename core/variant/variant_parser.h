#pragma once

#include "core/variant/tokenizer.h"
#include "core/variant/variant.h"

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cl {

/// Arrays, dictionaries and objects may nest this deep in a text; deeper is an error, not a stack overflow.
inline constexpr int kMaxTextDepth = 256;

struct TextProperty {
    std::string name;
    Variant value;
};

/// What a reader needs from its surroundings. An error that a function returns without a place gets the place
/// of the constructor in the text.
struct VariantReadOptions {
    /// Objects behind `ExtResource( id )` and `SubResource( id )`. Without a function these are errors.
    std::function<Expected<Variant>(int64_t id)> ext_resource;
    std::function<Expected<Variant>(int64_t id)> sub_resource;
    /// The file behind `Resource( "path" )`. Without a function it is an error.
    std::function<Expected<Variant>(const std::string& path)> resource;
    /// Makes the object of `Object( Class, "property": value, ... )`. Without a function: a Reference that
    /// declares the class and keeps the properties, so that it is written back (needs register_core_types()).
    std::function<Expected<Variant>(const std::string& class_name, std::vector<TextProperty> properties)>
        object;
    /// Where to report what is read in spite of being odd; may be null.
    Diagnostics* diagnostics = nullptr;
};

/// `[name field=value ...]`
struct TextTag {
    struct Field {
        std::string name;
        Variant value;
        SourceLocation where;       ///< of the name
        SourceLocation value_where; ///< of the value
    };
    std::string name; ///< "node", "gd_scene", "a.b"
    std::vector<Field> fields;
    SourceLocation where; ///< of the '['
    std::string_view raw; ///< as written, '[' to ']'; points into the reader's text

    /// nullptr if the tag has no such field; of a repeated one the last.
    [[nodiscard]] const Field* find(std::string_view field) const noexcept;
};

/// `key = value`
struct TextAssignment {
    std::string key;
    Variant value;
    SourceLocation where;       ///< of the key
    SourceLocation value_where; ///< of the value
    std::string_view raw{};     ///< the value as written; points into the reader's text
};

/// monostate at the end of the text.
using TextItem = std::variant<std::monostate, TextTag, TextAssignment>;

enum class TagSyntax {
    Fields,  ///< scenes and resources: `[name field=value ...]`
    Heading, ///< project.godot and .import files: everything up to ']' is the name
};

/// Reads values, tags and assignments of the text format (tscn format, sections 1 to 4) from a text in
/// memory. What Godot 3.2.3 reads is read to the same value; beyond that ".5", "+5", "1E1", "-inf", and inf
/// and nan inside constructors. Text is valid UTF-8 in every String that comes out. Every error is ParseError
/// with a place, or what a function of the options returned. After an error the reader only repeats it.
class VariantReader {
public:
    /// `text` must outlive the reader; `file` names it in messages and may be empty.
    VariantReader(std::string_view text, std::string file, VariantReadOptions options = {});

    /// The next tag or assignment.
    [[nodiscard]] Expected<TextItem> next_item(TagSyntax syntax = TagSyntax::Fields);
    /// The value that starts at the next token; what follows it is left alone.
    [[nodiscard]] Expected<Variant> read_value();
    /// Fails unless only white space and comments are left.
    [[nodiscard]] Status expect_end();
    /// Place of the next token, or of the end.
    [[nodiscard]] SourceLocation location();

private:
    bool read_item(TagSyntax syntax, TextItem& out);
    bool read_tag(TextTag& tag);
    bool read_heading(TextTag& tag);
    bool read_field(TextTag& tag);
    bool read_assignment(TextAssignment& assignment);
    bool read_key(std::string& key);
    void skip_rest_of_number(size_t value_offset);

    VariantReadOptions options_;
    Tokenizer tokenizer_;
};

/// Reads a text that is one value and nothing else, such as the right side of `--set`.
[[nodiscard]] Expected<Variant> parse_variant(std::string_view text, std::string file = {},
                                              VariantReadOptions options = {});

} // namespace cl
