#include "demo/cli/inspect_text.h"

#include "scene/io/text_writer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cl::demo {

namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json value_or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json properties_json(const scene::ShownProperties& properties) {
    Json json = Json::object();
    for (const auto& property : properties) {
        json[property.first] = property.second;
    }
    return json;
}

Json warnings_json(const std::vector<Warning>& warnings) {
    Json json = Json::array();
    for (const Warning& w : warnings) {
        json.push_back({{"line", w.where.line}, {"column", w.where.column}, {"message", w.message}});
    }
    return json;
}

Json nodes_json(const std::vector<scene::InspectedNode>& nodes) {
    Json json = Json::array();
    for (const scene::InspectedNode& n : nodes) {
        json.push_back({{"path", n.path},
                        {"type", value_or_null(n.type)},
                        {"groups", n.groups},
                        {"instance", value_or_null(n.instance)},
                        {"index", value_or_null(n.index)},
                        {"properties", properties_json(n.properties)}});
    }
    return json;
}

Json connections_json(const std::vector<scene::InspectedConnection>& connections) {
    Json json = Json::array();
    for (const scene::InspectedConnection& c : connections) {
        json.push_back({{"from", c.from},
                        {"signal", c.signal},
                        {"to", c.to},
                        {"method", c.method},
                        {"flags", c.flags},
                        {"binds", c.binds}});
    }
    return json;
}

const char* kind_name(scene::InspectedResource::Kind kind) {
    return kind == scene::InspectedResource::Kind::Sub ? "sub" : "ext";
}

Json resources_json(const std::vector<scene::InspectedResource>& resources) {
    Json json = Json::array();
    for (const scene::InspectedResource& r : resources) {
        json.push_back({{"kind", kind_name(r.kind)},
                        {"id", r.id},
                        {"type", r.type},
                        {"path", value_or_null(r.path)},
                        {"properties", properties_json(r.properties)}});
    }
    return json;
}

Json probe_json(const scene::InspectedProbe& p) {
    return {{"size", {p.size.x, p.size.y, p.size.z}},
            {"cells", p.cells},
            {"leaves", p.leaves},
            {"levels", p.levels},
            {"bounds",
             {p.bounds.position.x, p.bounds.position.y, p.bounds.position.z, p.bounds.size.x, p.bounds.size.y,
              p.bounds.size.z}},
            {"bytes", p.bytes}};
}

std::string dump(const Json& json) {
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Values that would fill the screen are shown by their start.
std::string shortened(const std::string& value) {
    constexpr size_t kMaxShown = 100;
    std::string line = value.substr(0, kMaxShown);
    for (char& c : line) {
        c = c == '\n' ? ' ' : c;
    }
    return value.size() > kMaxShown ? line + "..." : line;
}

void append_properties(std::string& text, const scene::ShownProperties& properties) {
    for (const auto& property : properties) {
        text += fmt::format("    {} = {}\n", property.first, shortened(property.second));
    }
}

void append_tree(std::string& text, const scene::Node& node, size_t depth) {
    text += fmt::format("{:{}}{} ({})\n", "", depth * 2, node.name().str(), node.class_name().str());
    for (const auto& child : node.children()) {
        append_tree(text, *child, depth + 1);
    }
}

Json node_json(const scene::Node& root, const scene::Node& node) {
    Json groups = Json::array();
    for (const scene::Node::Group& group : node.groups()) {
        groups.push_back(group.name.str());
    }
    Json properties = Json::object();
    for (const Object::PropertyValue& property : node.stored_properties()) {
        properties[property.name.str()] = scene::value_text(property.value);
    }
    const std::string path = &node == &root ? "." : "./" + root.path_to(node).to_string();
    return {
        {"path", path}, {"type", node.class_name().str()}, {"groups", groups}, {"properties", properties}};
}

void append_nodes(Json& json, const scene::Node& root, const scene::Node& node) {
    json.push_back(node_json(root, node));
    for (const auto& child : node.children()) {
        append_nodes(json, root, *child);
    }
}

} // namespace

std::string inspection_json(const scene::Inspection& i) {
    const bool is_scene = i.kind == scene::Inspection::Kind::Scene;
    Json json = {
        {"kind", is_scene ? "scene" : "resource"}, {"file", i.file}, {"warnings", warnings_json(i.warnings)}};
    if (is_scene) {
        json["nodes"] = nodes_json(i.nodes);
        json["connections"] = connections_json(i.connections);
    } else {
        json["type"] = i.type;
        json["properties"] = properties_json(i.properties);
    }
    json["resources"] = resources_json(i.resources);
    if (i.probe) {
        json["probe"] = probe_json(*i.probe);
    }
    return dump(json);
}

std::string inspection_text(const scene::Inspection& i) {
    std::string text = fmt::format("{}: {}\n", i.file, i.type.empty() ? "scene" : i.type);
    if (i.probe) {
        const scene::InspectedProbe& p = *i.probe;
        text += fmt::format("probe {} x {} x {}: {} cells, {} leaves, {} levels, {:.1f} KiB\n", p.size.x,
                            p.size.y, p.size.z, p.cells, p.leaves, p.levels,
                            static_cast<double>(p.bytes) / 1024.0);
    }
    for (const scene::InspectedResource& r : i.resources) {
        text += fmt::format("{} resource {}: {} {}\n", kind_name(r.kind), r.id, r.type, r.path.value_or(""));
        append_properties(text, r.properties);
    }
    append_properties(text, i.properties);
    for (const scene::InspectedNode& n : i.nodes) {
        text += fmt::format("{} ({})\n", n.path, n.type.value_or(n.instance.value_or("override")));
        append_properties(text, n.properties);
    }
    for (const scene::InspectedConnection& c : i.connections) {
        text += fmt::format("{}.{} -> {}.{}\n", c.from, c.signal, c.to, c.method);
    }
    for (const Warning& w : i.warnings) {
        text += w.to_string() + "\n";
    }
    return text;
}

std::string tree_text(const scene::Node& root) {
    std::string text;
    append_tree(text, root, 0);
    return text;
}

std::string tree_json(const scene::Node& root) {
    Json nodes = Json::array();
    append_nodes(nodes, root, root);
    return dump({{"kind", "tree"}, {"nodes", nodes}});
}

} // namespace cl::demo
