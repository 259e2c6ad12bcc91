#include "demo/cli/pictures.h"

#include "scene/3d/world.h"

#include "servers/visual_server.h"

#include "core/image.h"

#include <fmt/format.h>

namespace cl::demo {

namespace {

bool is_exr(const std::filesystem::path& path) {
    return path.extension() == ".exr";
}

} // namespace

Status check_outputs(const std::vector<std::filesystem::path>& outputs) {
    for (const std::filesystem::path& path : outputs) {
        if (path.extension() != ".png" && !is_exr(path)) {
            return Error{
                ErrorCode::Unsupported,
                fmt::format("expected an output file that ends in .png or .exr, found {}", path.string())};
        }
    }
    return {};
}

Status save_pictures(scene::SceneTree& tree, const std::vector<std::filesystem::path>& outputs) {
    for (const std::filesystem::path& path : outputs) {
        const TargetFormat format = is_exr(path) ? TargetFormat::LinearFloat : TargetFormat::Srgb8;
        Expected<Image> image = tree.server()->viewport_read(tree.world().viewport(), format);
        if (!image) {
            return image.error();
        }
        if (Status saved = save_image(*image, path); !saved) {
            return saved;
        }
    }
    return {};
}

} // namespace cl::demo
