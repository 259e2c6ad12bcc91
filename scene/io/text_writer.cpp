#include "scene/io/text_writer.h"

#include "scene/io/resource_link.h"

#include "core/io/file.h"
#include "core/variant/variant_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace cl::scene {

namespace {

VariantWriteOptions write_options() {
    VariantWriteOptions options;
    options.object_text = [](const Reference& object) -> std::optional<std::string> {
        const auto* link = dynamic_cast<const ResourceLink*>(&object);
        return link ? std::optional<std::string>(link->to_text()) : std::nullopt;
    };
    return options;
}

class SceneTextWriter {
public:
    std::string write(const SceneFile& file) {
        write_heading(file);
        for (const ExtEntry& e : file.ext_resources) {
            write_tag(
                e.tag_text,
                [&] {
                    field("path", e.path);
                    field("type", e.type);
                    out_ += fmt::format(" id={}", e.id);
                },
                "ext_resource");
        }
        out_ += file.ext_resources.empty() ? "" : "\n";
        for (const SubEntry& s : file.sub_resources) {
            write_tag(
                s.tag_text,
                [&] {
                    field("type", s.type);
                    out_ += fmt::format(" id={}", s.id);
                },
                "sub_resource");
            write_assignments(s.properties);
            out_ += '\n';
        }
        if (file.kind == SceneFile::Kind::Resource) {
            out_ += "[resource]\n";
            write_assignments(file.resource);
            return std::move(out_);
        }
        for (const NodeEntry& n : file.nodes) {
            out_ += &n == &file.nodes.front() ? "" : "\n";
            write_tag(
                n.tag_text, [&] { write_node_fields(n); }, "node");
            write_assignments(n.properties);
        }
        for (const ConnectionEntry& c : file.connections) {
            write_tag(
                c.tag_text, [&] { write_connection_fields(c); }, "connection");
        }
        for (const EditableEntry& e : file.editables) {
            out_ += '\n';
            write_tag(
                e.tag_text, [&] { field("path", e.path); }, "editable");
        }
        return std::move(out_);
    }

private:
    template <typename WriteFields>
    void write_tag(const std::string& as_read, WriteFields&& write_fields, std::string_view name) {
        if (!as_read.empty()) {
            out_ += as_read;
        } else {
            out_ += '[';
            out_ += name;
            write_fields();
            out_ += ']';
        }
        out_ += '\n';
    }

    void write_heading(const SceneFile& file) {
        write_tag(
            file.heading_text,
            [&] {
                if (file.kind == SceneFile::Kind::Resource) {
                    field("type", file.resource_type);
                }
                const size_t steps = file.ext_resources.size() + file.sub_resources.size() + 1;
                if (steps > 1) {
                    out_ += fmt::format(" load_steps={}", steps);
                }
                out_ += " format=2";
            },
            file.kind == SceneFile::Kind::Resource ? "gd_resource" : "gd_scene");
        out_ += '\n';
    }

    void write_node_fields(const NodeEntry& n) {
        field("name", n.name);
        field_if_set("type", n.type);
        if (n.parent) {
            field("parent", *n.parent);
        }
        field_if_set("owner", n.owner);
        if (n.index) {
            field("index", std::to_string(*n.index)); // a String, as Godot has it
        }
        if (!n.groups.empty()) {
            out_ += " groups=[\n";
            for (const std::string& group : n.groups) {
                append_c_quoted(out_, group, TextStyle::Exact);
                out_ += ",\n";
            }
            out_ += ']';
        }
        field_if_set("instance_placeholder", n.instance_placeholder);
        if (!n.instance.is_nil()) {
            out_ += " instance=";
            append_variant(out_, n.instance, options_);
        }
    }

    void write_connection_fields(const ConnectionEntry& c) {
        field("signal", c.signal);
        field("from", c.from);
        field("to", c.to);
        field("method", c.method);
        if (c.flags != 2) {
            out_ += fmt::format(" flags={}", c.flags);
        }
        if (!c.binds.empty()) {
            out_ += " binds= ";
            append_variant(out_, c.binds, options_);
        }
    }

    void field(std::string_view name, std::string_view text) {
        out_ += ' ';
        out_ += name;
        out_ += '=';
        append_c_quoted(out_, text, TextStyle::Exact);
    }
    void field_if_set(std::string_view name, std::string_view text) {
        if (!text.empty()) {
            field(name, text);
        }
    }

    void write_assignments(const Assignments& assignments) {
        for (const TextAssignment& a : assignments) {
            out_ += property_key_text(a.key);
            out_ += " = ";
            if (!a.raw.empty()) {
                out_ += a.raw;
            } else {
                append_variant(out_, a.value, options_);
            }
            out_ += '\n';
        }
    }

    std::string out_;
    VariantWriteOptions options_ = write_options();
};

} // namespace

std::string value_text(const Variant& value) {
    return variant_to_text(value, write_options());
}

std::string scene_file_text(const SceneFile& file) {
    return SceneTextWriter().write(file);
}

Status save_scene_file(const SceneFile& file, const std::filesystem::path& target) {
    return write_file_atomic(target, scene_file_text(file));
}

} // namespace cl::scene
