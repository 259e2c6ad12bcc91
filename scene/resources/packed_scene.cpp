#include "scene/resources/packed_scene.h"

#include "scene/io/scene_file.h"
#include "scene/io/scene_instancer.h"
#include "scene/main/node.h"

namespace cl::scene {

PackedScene::PackedScene() = default;
PackedScene::~PackedScene() = default;

void PackedScene::set_content(std::shared_ptr<const SceneFile> file, Resources resources) {
    file_ = std::move(file);
    resources_ = std::move(resources);
    emit_changed();
}

Expected<std::unique_ptr<Node>> PackedScene::instance(Diagnostics& diagnostics) const {
    if (!file_) {
        return Error{ErrorCode::InvalidArgument, "expected a scene with nodes, found an empty one"};
    }
    InstancingBudget budget;
    return instance_scene(*this, diagnostics, budget);
}

} // namespace cl::scene
