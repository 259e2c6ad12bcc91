#pragma once

#include "scene/io/scene_file.h"

#include "core/diagnostics.h"

namespace cl::scene {

/// Warns about the classes and properties in a file that we do not have, without opening the files it refers
/// to.
void check_classes(const SceneFile& file, Diagnostics& diagnostics);

} // namespace cl::scene
