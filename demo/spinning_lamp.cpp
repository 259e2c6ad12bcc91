// The engine as a library: builds a room from nodes alone, bakes its probe, and writes pictures of a scripted
// lamp that swings through it. `scons examples`, then `bin/spinning_lamp [FOLDER]`.
#include "demo/offscreen_server.h"
#include "demo/spinning_lamp_scene.h"

#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"
#include "scene/register_types.h"

#include "core/image.h"

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

using namespace cl;

Status write_pictures(const std::filesystem::path& folder) {
    scene::register_scene_types(ClassRegistry::instance());
    Expected<std::unique_ptr<VisualServer>> server = demo::make_offscreen_server();
    if (!server) {
        return server.error();
    }
    scene::SceneTree tree(std::move(*server), {.size = {480, 360}});
    std::unique_ptr<scene::Node> room = demo::make_spinning_lamp_scene(scene::GIProbeSubdiv::Cells64);
    const Expected<scene::BakeFigures> baked =
        room->get_node_as<scene::GIProbe>("Probe")->bake(nullptr, {}, scene::BakeFor::Once);
    if (!baked) {
        return baked.error();
    }
    Status status = tree.set_scene(std::move(room));
    for (int i = 0; status && i < 8; ++i) {
        tree.step(0.25);
        status = tree.draw_settled();
        Expected<Image> picture = tree.server()->viewport_read(tree.world().viewport(), TargetFormat::Srgb8);
        if (status && picture) {
            const std::filesystem::path file = folder / ("lamp_" + std::to_string(i) + ".png");
            status = save_image(*picture, file);
            std::printf("%s\n", file.string().c_str());
        }
    }
    return status;
}

} // namespace

int main(int argc, char** argv) {
    const Status status = write_pictures(argc > 1 ? argv[1] : ".");
    if (!status) {
        std::fprintf(stderr, "%s\n", status.error().to_string().c_str());
    }
    return status ? 0 : 1;
}
