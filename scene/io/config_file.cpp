#include "scene/io/config_file.h"

#include "core/io/file.h"
#include "core/variant/variant_parser.h"

#include <utility>

namespace cl::scene {

Expected<ConfigFile> ConfigFile::parse(std::string_view text, const std::string& name,
                                       Diagnostics& diagnostics) {
    ConfigFile config;
    VariantReadOptions options;
    options.diagnostics = &diagnostics;
    // Settings may hold references that have no meaning here (themes, icons): they are read as null.
    options.ext_resource = options.sub_resource = [](int64_t) -> Expected<Variant> { return Variant(); };
    options.resource = [](const std::string&) -> Expected<Variant> { return Variant(); };
    VariantReader reader(text, name, std::move(options));
    std::string section;
    for (;;) {
        Expected<TextItem> item = reader.next_item(TagSyntax::Heading);
        if (!item) {
            return item.error();
        }
        if (auto* assignment = std::get_if<TextAssignment>(&*item)) {
            config.values_[section + assignment->key] = std::move(assignment->value);
        } else if (const auto* tag = std::get_if<TextTag>(&*item)) {
            section = tag->name + "/";
        } else {
            return config;
        }
    }
}

Expected<ConfigFile> ConfigFile::load(const std::filesystem::path& file, Diagnostics& diagnostics) {
    const Expected<std::string> text = read_text_file(file);
    return text ? parse(*text, file.string(), diagnostics) : Expected<ConfigFile>(text.error());
}

const Variant* ConfigFile::find(std::string_view key) const noexcept {
    const auto found = values_.find(key);
    return found != values_.end() ? &found->second : nullptr;
}

int64_t ConfigFile::int_or(std::string_view key, int64_t otherwise) const noexcept {
    const Variant* value = find(key);
    const bool is_number = value && (value->is_num() || value->type() == Variant::Type::Bool);
    return is_number ? value->to_int() : otherwise;
}

bool ConfigFile::bool_or(std::string_view key, bool otherwise) const noexcept {
    return int_or(key, otherwise ? 1 : 0) != 0;
}

std::string ConfigFile::text_or(std::string_view key, std::string_view otherwise) const {
    const Variant* value = find(key);
    const std::string* text = value ? value->get_if<std::string>() : nullptr;
    return text ? *text : std::string(otherwise);
}

} // namespace cl::scene
