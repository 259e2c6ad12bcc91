#include "scene/io/scene_edit.h"

#include "scene/io/assign.h"
#include "scene/io/project_paths.h"
#include "scene/io/resource_link.h"
#include "scene/io/text_reader.h"
#include "scene/io/text_writer.h"

#include "core/diagnostics.h"
#include "core/ref.h"

#include <algorithm>

namespace cl::scene {

namespace {

std::string with_dot(std::string_view path) {
    if (path == "." || path.substr(0, 2) == "./") {
        return std::string(path);
    }
    return "./" + std::string(path);
}

NodeEntry& entry_of(SceneFile& file, std::string_view node_path) {
    const std::string path = with_dot(node_path);
    for (NodeEntry& node : file.nodes) {
        if (node.path() == path) {
            return node;
        }
    }
    NodeEntry entry;
    const size_t slash = path.rfind('/');
    entry.name = path.substr(slash + 1);
    entry.parent = slash == 1 ? "." : path.substr(2, slash - 2);
    file.nodes.push_back(std::move(entry));
    return file.nodes.back();
}

bool refers_to(const Variant& value, int64_t ext_id) {
    if (const Array* array = value.get_if<Array>()) {
        return std::any_of(array->begin(), array->end(),
                           [=](const Variant& v) { return refers_to(v, ext_id); });
    }
    if (const Dictionary* dictionary = value.get_if<Dictionary>()) {
        return std::any_of(dictionary->entries().begin(), dictionary->entries().end(),
                           [=](const Dictionary::Entry& e) {
                               return refers_to(e.first, ext_id) || refers_to(e.second, ext_id);
                           });
    }
    const ResourceLink* link = ResourceLink::in(value);
    return link && link->kind() == ResourceLink::Kind::Ext && link->id() == ext_id;
}

bool refers_to(const Assignments& assignments, int64_t ext_id) {
    return std::any_of(assignments.begin(), assignments.end(),
                       [=](const TextAssignment& a) { return refers_to(a.value, ext_id); });
}

bool is_used(const SceneFile& file, int64_t ext_id) {
    return refers_to(file.resource, ext_id) ||
           std::any_of(file.sub_resources.begin(), file.sub_resources.end(),
                       [=](const SubEntry& s) { return refers_to(s.properties, ext_id); }) ||
           std::any_of(file.nodes.begin(), file.nodes.end(),
                       [=](const NodeEntry& n) {
                           return refers_to(n.instance, ext_id) || refers_to(n.properties, ext_id);
                       }) ||
           std::any_of(file.connections.begin(), file.connections.end(),
                       [=](const ConnectionEntry& c) { return refers_to(Variant(c.binds), ext_id); });
}

int64_t ext_id_of(SceneFile& file, const std::string& path, const std::string& type) {
    for (const ExtEntry& e : file.ext_resources) {
        if (e.path == path) {
            return e.id;
        }
    }
    ExtEntry entry;
    entry.path = path;
    entry.type = type;
    for (entry.id = 1; file.find_ext(entry.id); ++entry.id) {
    }
    file.ext_resources.push_back(entry);
    file.heading_text.clear(); // its load_steps counts the resources
    return entry.id;
}

void drop_if_unused(SceneFile& file, int64_t ext_id) {
    if (is_used(file, ext_id)) {
        return;
    }
    const auto entry = std::find_if(file.ext_resources.begin(), file.ext_resources.end(),
                                    [=](const ExtEntry& e) { return e.id == ext_id; });
    if (entry != file.ext_resources.end()) {
        file.ext_resources.erase(entry);
        file.heading_text.clear();
    }
}

void set_assignment(Assignments& assignments, std::string_view key, Variant value) {
    const auto same = std::find_if(assignments.begin(), assignments.end(),
                                   [&](const TextAssignment& a) { return a.key == key; });
    if (same != assignments.end()) {
        same->value = std::move(value);
        same->raw = {};
        assignments.erase(std::remove_if(same + 1, assignments.end(),
                                         [&](const TextAssignment& a) { return a.key == key; }),
                          assignments.end());
        return;
    }
    const auto bookkeeping =
        std::find_if(assignments.begin(), assignments.end(),
                     [](const TextAssignment& a) { return a.key == "script" || a.key == "__meta__"; });
    assignments.insert(bookkeeping, TextAssignment{std::string(key), std::move(value), {}, {}});
}

} // namespace

void set_node_resource(SceneFile& file, std::string_view node_path, std::string_view property,
                       const std::string& resource_path, const std::string& resource_type) {
    const int64_t id = ext_id_of(file, resource_path, resource_type);
    NodeEntry& node = entry_of(file, node_path);
    const TextAssignment* before = find_assignment(node.properties, property);
    const ResourceLink* old_link = before ? ResourceLink::in(before->value) : nullptr;
    const bool replaces_other =
        old_link && old_link->kind() == ResourceLink::Kind::Ext && old_link->id() != id;
    const int64_t old_id = old_link ? old_link->id() : 0;
    set_assignment(node.properties, property, make_ref<ResourceLink>(ResourceLink::Kind::Ext, id));
    if (replaces_other) {
        drop_if_unused(file, old_id);
    }
}

Expected<bool> embed_probe_data(const std::filesystem::path& scene, std::string_view node_path,
                                const std::filesystem::path& data) {
    Diagnostics remarks; // the scene was loaded before: they were said then
    Expected<SceneFile> file = read_scene_file(scene, remarks, Spelling::Kept);
    if (!file) {
        return file.error();
    }
    const std::string before = scene_file_text(*file);
    set_node_resource(*file, node_path, "data", ProjectPaths::containing(scene).resource_path_of(data),
                      "GIProbeData");
    if (scene_file_text(*file) == before) {
        return false;
    }
    const Status saved = save_scene_file(*file, scene);
    return saved ? Expected<bool>(true) : Expected<bool>(saved.error());
}

} // namespace cl::scene
