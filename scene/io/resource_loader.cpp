#include "scene/io/resource_loader.h"

#include "scene/io/imported_texture.h"
#include "scene/io/scene_file_resources.h"
#include "scene/io/text_reader.h"

#include "core/object/class_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cl::scene {

namespace fs = std::filesystem;

namespace {

/// Files may need each other in a chain this long: loading recurses.
constexpr size_t kMaxChain = 64;

std::string suffix_of(const fs::path& file) {
    std::string suffix = file.extension().string();
    suffix.erase(0, suffix.empty() ? 0 : 1);
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return suffix;
}

} // namespace

ResourceLoader::ResourceLoader(ProjectPaths paths, Diagnostics& diagnostics)
    : paths_(std::move(paths)), diagnostics_(diagnostics) {}

void ResourceLoader::add_importer(std::string suffix, Importer importer) {
    importers_[std::move(suffix)] = std::move(importer);
}

bool ResourceLoader::has_importer(const fs::path& file) const {
    return importers_.find(suffix_of(file)) != importers_.end();
}

Ref<Resource> ResourceLoader::cached(const fs::path& file) const {
    const auto found = cache_.find(normalized(file));
    return found != cache_.end() ? found->second : nullptr;
}

void ResourceLoader::remember(const fs::path& file, const Ref<Resource>& resource) {
    if (resource->path().empty()) {
        resource->set_path(paths_.resource_path_of(file));
    }
    cache_[normalized(file)] = resource;
}

Expected<Ref<Resource>> ResourceLoader::load(const fs::path& file) {
    if (Ref<Resource> known = cached(file)) {
        return known;
    }
    const fs::path absolute = normalized(file);
    if (std::find(loading_.begin(), loading_.end(), absolute) != loading_.end()) {
        return Error{ErrorCode::ParseError,
                     "expected a file that does not need itself, found a circle of files"};
    }
    if (loading_.size() >= kMaxChain) {
        return Error{
            ErrorCode::OutOfMemory,
            fmt::format("expected at most {} files that need one another in a chain, found more", kMaxChain)};
    }
    loading_.push_back(absolute);
    Expected<Ref<Resource>> resource = load_any(file);
    loading_.pop_back();
    if (resource) {
        remember(file, *resource);
    }
    return resource;
}

Expected<Ref<Resource>> ResourceLoader::load_any(const fs::path& file) {
    const auto importer = importers_.find(suffix_of(file));
    if (importer != importers_.end()) {
        return importer->second(file, diagnostics_);
    }
    if (is_image_name(file.string())) {
        const std::array<fs::path, 1> files{file};
        const Expected<Ref<StreamTexture>> texture = import_textures(files, diagnostics_).front();
        return texture ? Expected<Ref<Resource>>(*texture) : Expected<Ref<Resource>>(texture.error());
    }
    return load_text(file);
}

Expected<Ref<Resource>> ResourceLoader::load_text(const fs::path& file) {
    Expected<SceneFile> parsed = read_scene_file(file, diagnostics_);
    if (!parsed) {
        return parsed.error();
    }
    const auto content = std::make_shared<const SceneFile>(std::move(*parsed));
    const fs::path absolute = normalized(file);
    SceneFileResources resources(*this, *content, absolute);
    Expected<PackedScene::Resources> made = resources.make();
    if (!made) {
        return made.error();
    }
    if (content->kind == SceneFile::Kind::Resource) {
        return resources.make_main();
    }
    auto scene = make_ref<PackedScene>();
    scene->set_content(content, std::move(*made));
    return Ref<Resource>(scene);
}

Expected<Ref<PackedScene>> ResourceLoader::load_scene(const fs::path& file) {
    const Expected<Ref<Resource>> resource = load(file);
    if (!resource) {
        return resource.error();
    }
    const Ref<PackedScene> scene = resource->cast<PackedScene>();
    if (!scene) {
        return Error{
            ErrorCode::ParseError,
            fmt::format("expected a scene, found a resource of class {}", (*resource)->class_name().view()),
            {file.string(), 1, 1}};
    }
    return scene;
}

Expected<Ref<Resource>> ResourceLoader::load_path(std::string_view path) {
    const Expected<fs::path> file = paths_.file_of(path);
    return file ? load(*file) : Expected<Ref<Resource>>(file.error());
}

} // namespace cl::scene
