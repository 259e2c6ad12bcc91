#include "scene/io/scene_file_resources.h"

#include "scene/io/assign.h"
#include "scene/io/imported_texture.h"
#include "scene/io/link_resolver.h"
#include "scene/resources/material.h"
#include "scene/resources/missing_resource.h"
#include "scene/resources/texture.h"

#include "core/object/class_registry.h"

#include <fmt/format.h>

#include <fstream>

namespace cl::scene {

namespace fs = std::filesystem;

namespace {

/// An error about a whole file becomes one about the line that asks for the file.
Error located(Error error, const ExtEntry& entry) {
    if (error.where.line > 0) {
        return error;
    }
    return {error.code, fmt::format("{}: {}", entry.path, error.message), entry.where};
}

Error located(const Error& error, const TextAssignment& assignment) {
    return {error.code, error.message, error.where.line > 0 ? error.where : assignment.value_where};
}

bool is_text_resource(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    char start[4] = {};
    stream.read(start, sizeof start);
    const std::string_view magic(start, static_cast<size_t>(stream.gcount()));
    return magic.substr(0, 3) == "[gd" || magic == "RSRC" ||
           magic == "RSCC"; // the binary ones: a clear error follows
}

Ref<Resource> missing_resource(const std::string& type) {
    auto missing = make_ref<MissingResource>();
    missing->set_declared_class(StringName(type));
    return missing;
}

bool is_resource_class(const std::string& type) {
    const ClassInfo* info = ClassRegistry::instance().find(StringName(type));
    return info && info->is_a(StringName(Resource::kClassName));
}

} // namespace

SceneFileResources::SceneFileResources(ResourceLoader& loader, const SceneFile& file, const fs::path& path)
    : loader_(loader), diagnostics_(loader.diagnostics_), file_(file), path_(path) {}

Expected<PackedScene::Resources> SceneFileResources::make() {
    if (const Status loaded = load_images(); !loaded) {
        return loaded.error();
    }
    for (const ExtEntry& entry : file_.ext_resources) {
        if (made_.ext.count(entry.id) > 0) {
            continue;
        }
        Expected<Ref<Resource>> resource = load_ext(entry);
        if (!resource) {
            return located(resource.error(), entry);
        }
        made_.ext.emplace(entry.id, std::move(*resource));
    }
    for (const SubEntry& entry : file_.sub_resources) {
        if (made_.sub.count(entry.id) > 0) {
            continue; // of two with one id the first counts (spec tscn section 5)
        }
        const Expected<Ref<Resource>> resource = create(entry.type, entry.where);
        if (!resource) {
            return resource.error();
        }
        (*resource)->set_path(fmt::format("{}::{}", loader_.paths().resource_path_of(path_), entry.id));
        if (const Status filled = fill(**resource, entry.properties); !filled) {
            return filled.error();
        }
        made_.sub.emplace(entry.id, *resource);
    }
    if (const Status loaded = load_paths_in_nodes(); !loaded) {
        return loaded.error();
    }
    return made_;
}

Status SceneFileResources::load_paths_in_nodes() {
    for (const NodeEntry& node : file_.nodes) {
        for (const TextAssignment& assignment : node.properties) {
            const LinkResolver resolver = [this](const ResourceLink& link) { return resolve(link); };
            const Expected<Variant> value = resolve_links(assignment.value, resolver);
            if (!value) {
                return located(value.error(), assignment);
            }
        }
    }
    return {};
}

Expected<Ref<Resource>> SceneFileResources::make_main() {
    Expected<Ref<Resource>> resource = create(file_.resource_type, file_.where);
    if (resource) {
        if (const Status filled = fill(**resource, file_.resource); !filled) {
            return filled.error();
        }
    }
    return resource;
}

Status SceneFileResources::load_images() {
    std::vector<fs::path> files;
    std::vector<const ExtEntry*> entries;
    for (const ExtEntry& entry : file_.ext_resources) {
        const Expected<fs::path> file = loader_.paths().file_of(entry.path, path_);
        if (file && is_image_name(entry.path) && !loader_.cached(*file)) {
            files.push_back(*file);
            entries.push_back(&entry);
        }
    }
    std::vector<Expected<Ref<StreamTexture>>> textures = import_textures(files, diagnostics_);
    for (size_t i = 0; i < files.size(); ++i) {
        const ExtEntry& entry = *entries[i];
        if (textures[i]) {
            loader_.remember(files[i], *textures[i]);
        } else if (textures[i].error().code == ErrorCode::Unsupported) {
            const std::string reason = fmt::format("{}: {}", entry.path, textures[i].error().message);
            loader_.remember(files[i], stand_in(entry.type, entry.where, reason));
        } else {
            return located(textures[i].error(), entry);
        }
    }
    return {};
}

Expected<Ref<Resource>> SceneFileResources::load_ext(const ExtEntry& entry) {
    const Expected<fs::path> file = loader_.paths().file_of(entry.path, path_);
    const bool has_use = is_image_name(entry.path) || is_resource_class(entry.type);
    if (has_use && !file) {
        return file.error();
    }
    if (file) {
        if (Ref<Resource> known = loader_.cached(*file)) {
            return known;
        }
    }
    Expected<Ref<Resource>> resource =
        has_use ? load_known_kind(entry, *file)
                : stand_in(entry.type, entry.where,
                           fmt::format("files of class {} are kept, without effect", entry.type));
    if (resource && (*resource)->path().empty()) {
        (*resource)->set_path(entry.path);
    }
    return resource;
}

Expected<Ref<Resource>> SceneFileResources::load_known_kind(const ExtEntry& entry, const fs::path& file) {
    std::error_code error;
    const bool is_missing = !fs::exists(file, error);
    if (is_missing || loader_.has_importer(file) || is_text_resource(file) || fs::is_directory(file, error)) {
        return loader_.load(file);
    }
    return stand_in(entry.type, entry.where,
                    fmt::format("{}: files of this kind are kept, without effect", entry.path));
}

Ref<Resource> SceneFileResources::stand_in(const std::string& type, const SourceLocation& where,
                                           const std::string& reason) {
    diagnostics_.warn(where, reason, reason);
    return missing_resource(type);
}

Expected<Ref<Resource>> SceneFileResources::create(const std::string& type, const SourceLocation& where) {
    const ClassRegistry& registry = ClassRegistry::instance();
    const StringName class_name(type);
    const ClassInfo* info = registry.find(class_name);
    if (!info) {
        warn_unknown_resource_class(type, where, diagnostics_);
        return missing_resource(type);
    }
    if (!info->is_a(StringName(Resource::kClassName))) {
        return Error{ErrorCode::ParseError,
                     fmt::format("expected the class of a resource, found \"{}\"", type), where};
    }
    const Ref<Resource> resource = registry.create_ref(class_name).cast<Resource>();
    if (!resource) {
        return Error{ErrorCode::ParseError,
                     fmt::format("expected a class that has objects, found the abstract \"{}\"", type),
                     where};
    }
    if (resource.cast<ShaderMaterial>()) {
        diagnostics_.warn(where, "materials of class ShaderMaterial are drawn as plain white",
                          "ShaderMaterial");
    }
    return resource;
}

Status SceneFileResources::fill(Resource& resource, const Assignments& assignments) {
    const LinkResolver resolver = [this](const ResourceLink& link) { return resolve(link); };
    for (const TextAssignment& assignment : assignments) {
        const Expected<Variant> value = resolve_links(assignment.value, resolver);
        if (!value) {
            return located(value.error(), assignment);
        }
        if (Status assigned = assign(resource, assignment, *value, diagnostics_); !assigned) {
            return assigned;
        }
        if (const auto* image = dynamic_cast<const ImageResource*>(&resource);
            image && !image->problem().empty()) {
            diagnostics_.warn(assignment.value_where, image->problem());
        }
    }
    return {};
}

Expected<Variant> SceneFileResources::resolve(const ResourceLink& link) {
    if (link.kind() == ResourceLink::Kind::Path) {
        const Expected<fs::path> file = loader_.paths().file_of(link.path(), path_);
        if (!file) {
            return file.error();
        }
        const Expected<Ref<Resource>> resource = loader_.load(*file);
        if (!resource) {
            return resource.error();
        }
        made_.by_path.emplace(link.path(), *resource);
        return Variant(*resource);
    }
    // The reader made sure that the id is defined above.
    const auto& resources = link.kind() == ResourceLink::Kind::Ext ? made_.ext : made_.sub;
    const auto found = resources.find(link.id());
    return found != resources.end() ? Variant(found->second) : Variant();
}

} // namespace cl::scene
