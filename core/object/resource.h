#pragma once

#include "core/object/object.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace cl {

template <typename T>
class ClassBuilder;

/// Data that nodes share: meshes, materials, textures, environments, probe data, scenes.
class Resource : public Reference {
public:
    static constexpr std::string_view kClassName = "Resource";
    static void bind(ClassBuilder<Resource>& c);

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    void set_name(std::string name) { name_ = std::move(name); }
    [[nodiscard]] bool local_to_scene() const noexcept { return local_to_scene_; }
    void set_local_to_scene(bool on) { local_to_scene_ = on; }

    /// "res://a.tres" for a file of its own, "res://a.tscn::3" for sub resource 3 of a file, else empty.
    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    void set_path(std::string path) { path_ = std::move(path); }

    /// Called when a property changed in a way that users of the resource must see: the signal "changed".
    uint64_t on_changed(std::function<void()> f);
    void remove_on_changed(uint64_t id);

protected:
    void emit_changed();

private:
    std::string name_;
    std::string path_;
    bool local_to_scene_ = false;
};

} // namespace cl
