#include "scene/io/inspect.h"

#include "scene/io/class_check.h"
#include "scene/io/parent_check.h"
#include "scene/io/resource_link.h"
#include "scene/io/text_reader.h"
#include "scene/io/text_writer.h"

#include "servers/gi/probe_data.h"

#include <fmt/format.h>

#include <algorithm>

namespace cl::scene {

namespace {

std::optional<size_t> element_count(const Variant& value) {
    switch (value.type()) {
    case Variant::Type::Dictionary:
        return value.get_if<Dictionary>()->size();
    case Variant::Type::Array:
        return value.get_if<Array>()->size();
    case Variant::Type::PoolByteArray:
        return value.get_if<PoolByteArray>()->size();
    case Variant::Type::PoolIntArray:
        return value.get_if<PoolIntArray>()->size();
    case Variant::Type::PoolRealArray:
        return value.get_if<PoolRealArray>()->size();
    case Variant::Type::PoolStringArray:
        return value.get_if<PoolStringArray>()->size();
    case Variant::Type::PoolVector2Array:
        return value.get_if<PoolVector2Array>()->size();
    case Variant::Type::PoolVector3Array:
        return value.get_if<PoolVector3Array>()->size();
    case Variant::Type::PoolColorArray:
        return value.get_if<PoolColorArray>()->size();
    default:
        return std::nullopt;
    }
}

std::string shown_text(const Variant& value) {
    std::string text = value_text(value);
    const std::optional<size_t> elements = text.size() > kMaxShownText ? element_count(value) : std::nullopt;
    return elements ? fmt::format("<{}, {} elements>", type_name(value.type()), *elements) : text;
}

ShownProperties shown(const Assignments& assignments) {
    ShownProperties properties;
    for (const TextAssignment& a : assignments) {
        const auto same = std::find_if(properties.begin(), properties.end(),
                                       [&](const auto& p) { return p.first == a.key; });
        if (same != properties.end()) {
            same->second = shown_text(a.value); // of a key given twice the last counts
        } else {
            properties.emplace_back(a.key, shown_text(a.value));
        }
    }
    return properties;
}

std::string from_root(const std::string& path) {
    return path == "." || path.compare(0, 2, "./") == 0 ? path : "./" + path;
}

InspectedNode inspect_node(const SceneFile& file, const NodeEntry& entry) {
    InspectedNode node;
    node.path = entry.path();
    node.groups = entry.groups;
    node.index = entry.index;
    node.properties = shown(entry.properties);
    if (const ResourceLink* link = ResourceLink::in(entry.instance)) {
        const ExtEntry* ext = file.find_ext(link->id());
        node.instance = link->kind() == ResourceLink::Kind::Path ? link->path()
                        : ext                                    ? ext->path
                                                                 : std::string();
    } else if (!entry.instance_placeholder.empty()) {
        node.type = "InstancePlaceholder";
    } else if (!entry.type.empty()) {
        node.type = entry.type;
    }
    return node;
}

Expected<InspectedProbe> inspect_probe(const SceneFile& file) {
    InspectedProbe probe;
    const TextAssignment* bounds = find_assignment(file.resource, "bounds");
    const AABB* box = bounds ? bounds->value.get_if<AABB>() : nullptr;
    probe.bounds = box ? *box : gi::ProbeData{}.bounds;
    const TextAssignment* cells = find_assignment(file.resource, "dynamic_data");
    const auto* data = cells ? cells->value.get_if<PoolIntArray>() : nullptr;
    if (!data || data->empty()) {
        return probe;
    }
    const Expected<gi::Octree> octree = gi::decode_octree(data->span());
    if (!octree) {
        return Error{octree.error().code, "GIProbeData.dynamic_data: " + octree.error().message,
                     cells->value_where};
    }
    probe.size = octree->dims;
    probe.cells = static_cast<uint32_t>(octree->cells.size());
    probe.leaves = octree->leaf_count;
    probe.levels = octree->levels;
    probe.bytes = data->size() * sizeof(int32_t);
    return probe;
}

void inspect_resources(const SceneFile& file, Inspection& inspection) {
    for (const ExtEntry& e : file.ext_resources) {
        inspection.resources.push_back({InspectedResource::Kind::Ext, e.id, e.type, e.path, {}});
    }
    for (const SubEntry& s : file.sub_resources) {
        inspection.resources.push_back(
            {InspectedResource::Kind::Sub, s.id, s.type, std::nullopt, shown(s.properties)});
    }
}

} // namespace

Expected<Inspection> inspect_file(const std::filesystem::path& path) {
    Diagnostics diagnostics;
    const Expected<SceneFile> file = read_scene_file(path, diagnostics);
    if (!file) {
        return file.error();
    }
    if (const Status placed = check_parents(*file); !placed) {
        return placed.error();
    }
    check_classes(*file, diagnostics);
    Inspection inspection;
    inspection.file = path.string();
    inspection.warnings = diagnostics.warnings();
    inspect_resources(*file, inspection);
    if (file->kind == SceneFile::Kind::Resource) {
        inspection.kind = Inspection::Kind::Resource;
        inspection.type = file->resource_type;
        inspection.properties = shown(file->resource);
        if (file->resource_type == "GIProbeData") {
            Expected<InspectedProbe> probe = inspect_probe(*file);
            if (!probe) {
                return probe.error();
            }
            inspection.probe = *probe;
        }
        return inspection;
    }
    for (const NodeEntry& entry : file->nodes) {
        inspection.nodes.push_back(inspect_node(*file, entry));
    }
    for (const ConnectionEntry& c : file->connections) {
        inspection.connections.push_back(
            {from_root(c.from), c.signal, from_root(c.to), c.method, c.flags, shown_text(c.binds)});
    }
    return inspection;
}

} // namespace cl::scene
