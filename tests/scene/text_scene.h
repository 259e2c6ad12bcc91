#pragma once

#include "tests/scene/scene_fixture.h"
#include "tests/temporary_dir.h"

#include "scene/io/resource_loader.h"
#include "scene/io/text_reader.h"
#include "scene/main/node.h"

#include <doctest/doctest.h>

#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cl::tests {

inline std::vector<std::string> lines_of(const Diagnostics& diagnostics) {
    std::vector<std::string> lines;
    for (const Warning& w : diagnostics.warnings()) {
        lines.push_back(w.to_string());
    }
    return lines;
}

/// A project folder with files in it; messages about them are shown without the folder's name.
class TestProject {
public:
    TestProject() {
        register_types();
        write("project.godot", "config_version=4\n");
    }
    void write(const std::string& name, std::string_view text) const {
        const std::filesystem::path file = dir_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
    }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return dir_ / name; }

    /// The scene's root; null and error() if there is none.
    std::unique_ptr<scene::Node> load(const std::string& name = "a.tscn") {
        loader_ = std::make_unique<scene::ResourceLoader>(scene::ProjectPaths::containing(file(name)),
                                                          diagnostics_);
        const Expected<Ref<scene::PackedScene>> packed = loader_->load_scene(file(name));
        if (!packed) {
            error_ = shortened(packed.error().to_string());
            return nullptr;
        }
        Expected<std::unique_ptr<scene::Node>> root = (*packed)->instance(diagnostics_);
        if (!root) {
            error_ = shortened(root.error().to_string());
            return nullptr;
        }
        return std::move(*root);
    }
    [[nodiscard]] const std::string& error() const { return error_; }
    /// What loading `text` as a.tscn gives: the error, else "loaded".
    std::string outcome(std::string_view text) {
        write("a.tscn", text);
        return load() ? "loaded" : error_;
    }
    [[nodiscard]] std::vector<std::string> warnings() const {
        std::vector<std::string> lines = lines_of(diagnostics_);
        for (std::string& line : lines) {
            line = shortened(line);
        }
        return lines;
    }
    [[nodiscard]] scene::ResourceLoader& loader() { return *loader_; }
    [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }

private:
    [[nodiscard]] std::string shortened(std::string text) const {
        const std::string folder = dir_.path().string() + "/";
        for (size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
            text.erase(at, folder.size());
        }
        return text;
    }

    TemporaryDir dir_;
    Diagnostics diagnostics_;
    std::unique_ptr<scene::ResourceLoader> loader_;
    std::string error_;
};

} // namespace cl::tests
