#pragma once

#include "core/diagnostics.h"
#include "core/expected.h"
#include "core/object/resource.h"
#include "core/ref.h"

#include <memory>
#include <string>
#include <unordered_map>

namespace cl::scene {

class Node;       // scene/main/node.h
struct SceneFile; // scene/io/scene_file.h

/// A scene that can be made into nodes any number of times.
class PackedScene final : public Resource {
public:
    static constexpr std::string_view kClassName = "PackedScene";
    PackedScene();
    PackedScene(const PackedScene&) = delete;
    PackedScene& operator=(const PackedScene&) = delete;
    ~PackedScene() override;

    /// Resources that the file refers to.
    struct Resources {
        std::unordered_map<int64_t, Ref<Resource>> ext;
        std::unordered_map<int64_t, Ref<Resource>> sub;
        std::unordered_map<std::string, Ref<Resource>> by_path; ///< of `Resource( "path" )` in nodes
    };

    /// @param file  the scene as parsed; shared, not changed.
    void set_content(std::shared_ptr<const SceneFile> file, Resources resources);
    /// The scene as parsed; null before set_content().
    [[nodiscard]] const std::shared_ptr<const SceneFile>& file() const noexcept { return file_; }
    [[nodiscard]] const Resources& resources() const noexcept { return resources_; }

    /// Makes the nodes (spec tscn section 6): children in file order, properties in file order, owner = the
    /// root, connections last. Nodes of instanced scenes come with it.
    /// @param diagnostics  receives a located warning for all that was left out or not understood.
    /// @return the root, outside any tree; ParseError if there is no root or the scene instances itself.
    [[nodiscard]] Expected<std::unique_ptr<Node>> instance(Diagnostics& diagnostics) const;

private:
    std::shared_ptr<const SceneFile> file_;
    Resources resources_;
};

} // namespace cl::scene
