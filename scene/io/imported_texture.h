#pragma once

#include "scene/resources/texture.h"

#include "core/diagnostics.h"
#include "core/expected.h"
#include "core/ref.h"

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace cl::scene {

/// True for the names of image files: png, jpg, hdr, exr, and kinds that we do not read (webp, svg, ...).
[[nodiscard]] bool is_image_name(std::string_view path) noexcept;

/// Loads image files as textures, on all worker threads. Sampling flags come from the `<file>.import` beside
/// an image (section [params]); without one they are mipmaps, repeat and filter. The source image is read,
/// not the imported copy, which checkouts lack.
/// @return a texture or an error for each file, in order.
[[nodiscard]] std::vector<Expected<Ref<StreamTexture>>>
import_textures(std::span<const std::filesystem::path> files, Diagnostics& diagnostics);

} // namespace cl::scene
