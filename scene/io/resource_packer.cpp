#include "scene/io/resource_packer.h"

#include "scene/io/resource_link.h"
#include "scene/io/text_writer.h"
#include "scene/resources/texture.h"

#include "core/object/class_registry.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace cl::scene {

namespace {

bool has_file_of_its_own(const Resource& resource) {
    return !resource.path().empty() && resource.path().find("::") == std::string::npos;
}

/// The n of "res://file::n" if it is a sub resource of `file`.
std::optional<int64_t> id_within(const Resource& resource, const std::string& file) {
    const std::string& path = resource.path();
    if (path.size() < file.size() + 3 || path.compare(0, file.size(), file) != 0 ||
        path.compare(file.size(), 2, "::") != 0) {
        return std::nullopt;
    }
    int64_t id = 0;
    const char* last = path.data() + path.size();
    const auto [end, error] = std::from_chars(path.data() + file.size() + 2, last, id);
    return error == std::errc() && end == last ? std::optional<int64_t>(id) : std::nullopt;
}

/// The class that files name: Godot calls every imported image a Texture.
std::string file_type(const Resource& resource) {
    return dynamic_cast<const StreamTexture*>(&resource) ? "Texture" : resource.class_name().str();
}

} // namespace

ResourcePacker::ResourcePacker(SceneFile& file, std::string path, const SceneFile* original)
    : file_(file), path_(std::move(path)), original_(original) {
    if (!original_) {
        return;
    }
    for (const ExtEntry& e : original_->ext_resources) {
        used_ext_ids_.insert(e.id);
    }
    for (const SubEntry& s : original_->sub_resources) {
        used_sub_ids_.insert(s.id);
    }
}

Variant ResourcePacker::pack(const Variant& value) {
    if (const Array* array = value.get_if<Array>()) {
        Array packed;
        packed.reserve(array->size());
        std::transform(array->begin(), array->end(), std::back_inserter(packed),
                       [this](const Variant& v) { return pack(v); });
        return packed;
    }
    if (const Dictionary* dictionary = value.get_if<Dictionary>()) {
        Dictionary packed;
        for (const Dictionary::Entry& entry : dictionary->entries()) {
            packed.set(pack(entry.first), pack(entry.second));
        }
        return packed;
    }
    const auto* resource = dynamic_cast<const Resource*>(value.to_object());
    return resource ? pack_resource(*resource) : value;
}

Assignments ResourcePacker::pack_properties(const std::vector<Object::PropertyValue>& properties) {
    Assignments assignments;
    assignments.reserve(properties.size());
    for (const Object::PropertyValue& p : properties) {
        assignments.push_back({p.name.str(), pack(p.value), {}, {}});
    }
    return assignments;
}

Variant ResourcePacker::link_to_file(const std::string& path, const std::string& type) {
    const auto known = ext_ids_.find(path);
    if (known != ext_ids_.end()) {
        return make_ref<ResourceLink>(ResourceLink::Kind::Ext, known->second);
    }
    ExtEntry entry;
    if (original_) {
        const auto& all = original_->ext_resources;
        const auto same =
            std::find_if(all.begin(), all.end(), [&](const ExtEntry& e) { return e.path == path; });
        entry = same != all.end() ? *same : entry;
    }
    if (entry.path.empty()) {
        entry.path = path;
        entry.type = type;
        for (entry.id = 1; used_ext_ids_.count(entry.id) > 0; ++entry.id) {
        }
    }
    used_ext_ids_.insert(entry.id);
    ext_ids_.emplace(path, entry.id);
    file_.ext_resources.push_back(entry);
    return make_ref<ResourceLink>(ResourceLink::Kind::Ext, entry.id);
}

Variant ResourcePacker::pack_resource(const Resource& resource) {
    if (has_file_of_its_own(resource)) {
        return link_to_file(resource.path(), file_type(resource));
    }
    const auto known = sub_ids_.find(&resource);
    if (known != sub_ids_.end()) {
        return make_ref<ResourceLink>(ResourceLink::Kind::Sub, known->second);
    }
    if (!packing_.insert(&resource).second) {
        return {}; // contains itself: the format cannot say that
    }
    SubEntry entry;
    entry.type = resource.class_name().str();
    entry.properties =
        pack_properties(resource.stored_properties()); // what it needs gets its entry before it
    entry.id = new_sub_id(resource);
    packing_.erase(&resource);
    sub_ids_.emplace(&resource, entry.id);
    const int64_t id = entry.id;
    file_.sub_resources.push_back(std::move(entry));
    return make_ref<ResourceLink>(ResourceLink::Kind::Sub, id);
}

int64_t ResourcePacker::new_sub_id(const Resource& resource) {
    if (const std::optional<int64_t> kept = path_.empty() ? std::nullopt : id_within(resource, path_)) {
        used_sub_ids_.insert(*kept);
        return *kept;
    }
    int64_t largest = 0;
    for (int64_t id : used_sub_ids_) {
        largest = std::max(largest, id);
    }
    used_sub_ids_.insert(largest + 1);
    return largest + 1;
}

SceneFile pack_resource_file(const Resource& resource, const std::string& path) {
    SceneFile file;
    file.kind = SceneFile::Kind::Resource;
    file.resource_type = resource.class_name().str();
    ResourcePacker packer(file, path.empty() ? resource.path() : path);
    file.resource = packer.pack_properties(resource.stored_properties());
    return file;
}

Status save_resource(const Resource& resource, const std::filesystem::path& target) {
    return save_scene_file(pack_resource_file(resource), target);
}

} // namespace cl::scene
