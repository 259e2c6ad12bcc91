#pragma once

#include "scene/io/project_paths.h"

#include "core/diagnostics.h"
#include "core/expected.h"
#include "core/math/color.h"

#include <glm/vec2.hpp>

#include <string>

namespace cl::scene {

/// The settings of a project.godot that matter here (spec scene-classes section 22), with Godot's defaults.
struct ProjectSettings {
    glm::ivec2 window_size{1024, 600};
    Color default_clear_color{0.3f, 0.3f, 0.3f, 1.0f};
    std::string default_environment; ///< path; empty: none
    std::string main_scene;          ///< path; empty: none
    bool voxel_cone_tracing_high_quality = false;
    int shadow_filter_mode = 1; ///< 0 nearest, 1 PCF5, 2 PCF13
    int shadow_atlas_size = 4096;
    int directional_shadow_size = 4096;
    bool high_quality_ggx = true;
    int msaa = 0; ///< 0 off, 1 2x, 2 4x, ...
};

/// The defaults if the project has no project.godot; values of a wrong type or out of range are warned about
/// and keep their default.
/// @return the error of a file that is there but cannot be read.
[[nodiscard]] Expected<ProjectSettings> load_project_settings(const ProjectPaths& paths,
                                                              Diagnostics& diagnostics);

} // namespace cl::scene
