#pragma once

#include "demo/cli/figures.h"
#include "demo/cli/options.h"

#include "scene/io/project_settings.h"
#include "scene/main/scene_tree.h"

#include "drivers/window.h"

#include "core/expected.h"

#include <memory>
#include <string>

namespace cl {
class VisualServer;
}

namespace cl::demo {

/// Where the pictures come from: a tree with its server and graphics context.
class Stage {
public:
    /// Starts the graphics driver, in a window if `--driver window` says so.
    /// @return one line on what each driver that was tried said: exit status 3.
    [[nodiscard]] static Expected<std::unique_ptr<Stage>> open(const Options& options,
                                                               const scene::ProjectSettings& settings);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Puts the scene in the tree and makes the camera of `options` current: that of `--camera`, else the
    /// scene's current one, else one that frames the scene.
    [[nodiscard]] Status show(std::unique_ptr<scene::Node> root, const Options& options);

    [[nodiscard]] scene::SceneTree& tree() noexcept;
    [[nodiscard]] VisualServer& server() noexcept;
    /// nullptr off screen.
    [[nodiscard]] drivers::Window* window() noexcept;
    [[nodiscard]] glm::ivec2 window_size() const;
    void present();
    void set_gi_mode(GIMode mode);
    /// Server and driver figures of the last frame.
    void describe(Figures& figures);

private:
    Stage();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// "off", "cones" or "auto".
[[nodiscard]] std::string gi_name(GIMode mode);

} // namespace cl::demo
