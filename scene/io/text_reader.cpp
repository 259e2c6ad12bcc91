#include "scene/io/text_reader.h"

#include "scene/io/resource_link.h"
#include "scene/io/tag_fields.h"

#include "core/io/file.h"

#include <fmt/format.h>

#include <optional>
#include <unordered_map>
#include <utility>

namespace cl::scene {

namespace {

constexpr int64_t kNewestFormat = 2;

class SceneTextReader {
public:
    SceneTextReader(std::string_view text, const std::string& name, Diagnostics& diagnostics)
        : reader_(text, name, read_options(diagnostics)) {
        file_.name = name;
    }

    /// @param kept  the text that is read, if values shall keep their spelling
    Expected<SceneFile> read(std::shared_ptr<const std::string> kept) {
        file_.text = std::move(kept);
        Status status = read_heading();
        while (status) {
            Expected<TextItem> item = reader_.next_item();
            if (!item) {
                return item.error();
            }
            if (auto* tag = std::get_if<TextTag>(&*item)) {
                status = read_tag(*tag);
            } else if (auto* assignment = std::get_if<TextAssignment>(&*item)) {
                status = read_assignment(std::move(*assignment));
            } else {
                status = check_end();
                return status ? Expected<SceneFile>(std::move(file_)) : Expected<SceneFile>(status.error());
            }
        }
        return status.error();
    }

private:
    using Links = std::unordered_map<int64_t, Variant>;

    VariantReadOptions read_options(Diagnostics& diagnostics) {
        VariantReadOptions options;
        options.diagnostics = &diagnostics;
        options.ext_resource = [this](int64_t id) { return defined_above(ext_links_, id, "ext_resource"); };
        options.sub_resource = [this](int64_t id) { return defined_above(sub_links_, id, "sub_resource"); };
        options.resource = [](const std::string& path) -> Expected<Variant> {
            return Variant(make_ref<ResourceLink>(path));
        };
        return options;
    }

    static Expected<Variant> defined_above(const Links& links, int64_t id, std::string_view tag) {
        const auto link = links.find(id);
        if (link == links.end()) {
            return Error{ErrorCode::ParseError,
                         fmt::format("expected the id of a [{}] above, found {}", tag, id)};
        }
        return link->second;
    }

    static Error error_at(const SourceLocation& where, std::string message,
                          ErrorCode code = ErrorCode::ParseError) {
        return {code, std::move(message), where};
    }

    Status read_heading() {
        Expected<TextItem> item = reader_.next_item();
        if (!item) {
            return item.error();
        }
        const auto* tag = std::get_if<TextTag>(&*item);
        if (!tag || (tag->name != "gd_scene" && tag->name != "gd_resource")) {
            const auto* assignment = std::get_if<TextAssignment>(&*item);
            const SourceLocation where = tag          ? tag->where
                                         : assignment ? assignment->where
                                                      : reader_.location();
            const std::string found = tag          ? "[" + tag->name + "]"
                                      : assignment ? "\"" + assignment->key + "\""
                                                   : "the end of the file";
            return error_at(where, "expected [gd_scene] or [gd_resource], found " + found);
        }
        TagFields fields(*tag);
        const int64_t format = fields.int_or("format", kNewestFormat);
        if (tag->name == "gd_resource") {
            file_.kind = SceneFile::Kind::Resource;
            file_.resource_type = fields.required_text("type");
        }
        if (!fields.status()) {
            return fields.status();
        }
        if (format > kNewestFormat) {
            return error_at(
                tag->find("format")->value_where,
                fmt::format("expected format {} or lower, found the newer format {}", kNewestFormat, format),
                ErrorCode::Unsupported);
        }
        file_.heading_text = std::string(tag->raw);
        file_.where = tag->where;
        return {};
    }

    Status read_tag(const TextTag& tag) {
        target_ = nullptr;
        if (open_sub_resource_) { // complete now: from here on it may be referred to, but not by itself
            sub_links_.emplace(*open_sub_resource_,
                               make_ref<ResourceLink>(ResourceLink::Kind::Sub, *open_sub_resource_));
            open_sub_resource_.reset();
        }
        const bool is_scene = file_.kind == SceneFile::Kind::Scene;
        if (resource_seen_) {
            return error_at(tag.where,
                            "expected the end of the file after [resource], found [" + tag.name + "]");
        }
        const bool nodes_started =
            !file_.nodes.empty() || !file_.connections.empty() || !file_.editables.empty();
        if (!nodes_started && tag.name == "ext_resource") {
            return read_ext_resource(tag);
        }
        if (!nodes_started && tag.name == "sub_resource") {
            return read_sub_resource(tag);
        }
        if (is_scene && tag.name == "node") {
            return read_node(tag);
        }
        if (is_scene && tag.name == "connection") {
            return read_connection(tag);
        }
        if (is_scene && tag.name == "editable") {
            return read_editable(tag);
        }
        if (!is_scene && tag.name == "resource") {
            resource_seen_ = true;
            target_ = &file_.resource;
            return {};
        }
        const std::string_view expected = nodes_started ? "[node], [connection] or [editable]"
                                          : is_scene    ? "[ext_resource], [sub_resource] or [node]"
                                                        : "[ext_resource], [sub_resource] or [resource]";
        return error_at(tag.where, fmt::format("expected {}, found [{}]", expected, tag.name));
    }

    Status read_ext_resource(const TextTag& tag) {
        TagFields fields(tag);
        ExtEntry entry;
        entry.path = fields.required_text("path");
        entry.type = fields.required_text("type");
        entry.id = fields.required_int("id");
        entry.tag_text = std::string(tag.raw);
        entry.where = tag.where;
        if (!fields.status()) {
            return fields.status();
        }
        ext_links_.emplace(entry.id, make_ref<ResourceLink>(ResourceLink::Kind::Ext, entry.id));
        file_.ext_resources.push_back(std::move(entry));
        return {};
    }

    Status read_sub_resource(const TextTag& tag) {
        TagFields fields(tag);
        SubEntry entry;
        entry.type = fields.required_text("type");
        entry.id = fields.required_int("id");
        entry.tag_text = std::string(tag.raw);
        entry.where = tag.where;
        if (!fields.status()) {
            return fields.status();
        }
        open_sub_resource_ = entry.id;
        file_.sub_resources.push_back(std::move(entry));
        target_ = &file_.sub_resources.back().properties;
        return {};
    }

    Status read_node(const TextTag& tag) {
        TagFields fields(tag);
        NodeEntry entry;
        entry.name = fields.text_or_empty("name");
        entry.type = fields.text_or_empty("type");
        if (fields.has("parent")) {
            entry.parent = fields.text_or_empty("parent");
        }
        entry.owner = fields.text_or_empty("owner");
        if (fields.has("index")) {
            entry.index = fields.int_or("index", 0);
        }
        entry.groups = fields.texts("groups");
        entry.instance_placeholder = fields.text_or_empty("instance_placeholder");
        entry.tag_text = std::string(tag.raw);
        entry.where = tag.where;
        if (!fields.status()) {
            return fields.status();
        }
        if (const TextTag::Field* instance = tag.find("instance")) {
            const ResourceLink* link = ResourceLink::in(instance->value);
            if (!link || link->kind() == ResourceLink::Kind::Sub) {
                return error_at(
                    instance->value_where,
                    fmt::format("expected ExtResource( id ) as \"instance\" of [node], found {}",
                                link ? link->to_text() : std::string(type_name(instance->value.type()))));
            }
            entry.instance = instance->value;
        }
        if (Status placed = check_place(entry); !placed) {
            return placed;
        }
        file_.nodes.push_back(std::move(entry));
        target_ = &file_.nodes.back().properties;
        return {};
    }

    [[nodiscard]] Status check_place(const NodeEntry& entry) const {
        if (!file_.nodes.empty()) {
            return entry.parent
                       ? Status()
                       : error_at(entry.where,
                                  "expected a field \"parent\" in every [node] but the first, found none");
        }
        if (entry.parent) {
            return error_at(
                entry.where,
                fmt::format("expected no \"parent\" in the first [node], found \"{}\"", *entry.parent));
        }
        if (entry.type.empty() && entry.instance.is_nil() && entry.instance_placeholder.empty()) {
            return error_at(entry.where,
                            "expected a \"type\" or an \"instance\" in the first [node], found neither");
        }
        return {};
    }

    Status read_connection(const TextTag& tag) {
        TagFields fields(tag);
        ConnectionEntry entry;
        entry.signal = fields.required_text("signal");
        entry.from = fields.required_text("from");
        entry.to = fields.required_text("to");
        entry.method = fields.required_text("method");
        entry.flags = fields.int_or("flags", 2);
        entry.binds = fields.array("binds");
        entry.tag_text = std::string(tag.raw);
        entry.where = tag.where;
        file_.connections.push_back(std::move(entry));
        return fields.status();
    }

    Status read_editable(const TextTag& tag) {
        TagFields fields(tag);
        file_.editables.push_back({fields.required_text("path"), std::string(tag.raw), tag.where});
        return fields.status();
    }

    Status read_assignment(TextAssignment assignment) {
        if (!target_) {
            return error_at(assignment.where, fmt::format("expected a tag, found \"{}\"", assignment.key));
        }
        if (!file_.text) {
            assignment.raw = {}; // the text does not outlive the reader
        }
        target_->push_back(std::move(assignment));
        return {};
    }

    Status check_end() {
        if (file_.kind == SceneFile::Kind::Resource) {
            return resource_seen_
                       ? Status()
                       : error_at(reader_.location(), "expected [resource], found the end of the file");
        }
        return file_.nodes.empty()
                   ? error_at(reader_.location(), "expected [node], found the end of the file")
                   : Status();
    }

    Links ext_links_;
    Links sub_links_;
    VariantReader reader_;
    SceneFile file_;
    std::optional<int64_t> open_sub_resource_;
    Assignments* target_ = nullptr; // of the tag above; nullptr where assignments are not allowed
    bool resource_seen_ = false;
};

} // namespace

Expected<SceneFile> parse_scene_text(std::string_view text, const std::string& name, Diagnostics& diagnostics,
                                     Spelling spelling) {
    if (spelling == Spelling::Forgotten) {
        return SceneTextReader(text, name, diagnostics).read(nullptr);
    }
    auto kept = std::make_shared<const std::string>(text);
    return SceneTextReader(*kept, name, diagnostics).read(kept);
}

Expected<SceneFile> read_scene_file(const std::filesystem::path& file, Diagnostics& diagnostics,
                                    Spelling spelling) {
    const Expected<std::string> text = read_text_file(file);
    if (!text) {
        return text.error();
    }
    const std::string_view magic = std::string_view(*text).substr(0, 4);
    if (magic == "RSRC" || magic == "RSCC") {
        return Error{ErrorCode::Unsupported,
                     fmt::format("expected a text scene or resource, found a binary one ({})", magic),
                     {file.string()}};
    }
    return parse_scene_text(*text, file.string(), diagnostics, spelling);
}

} // namespace cl::scene
