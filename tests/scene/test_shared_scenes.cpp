#include "tests/scene/text_scene.h"
#include "tests/servers/gi/agreement.h"
#include "tests/servers/gi/oracle_probe.h"
#include "tests/shared_dir.h"

#include "scene/3d/gi_probe.h"
#include "scene/io/inspect.h"
#include "scene/io/scene_packer.h"
#include "scene/io/text_writer.h"
#include "scene/resources/mesh.h"

#include <algorithm>
#include <chrono>
#include <optional>

using namespace cl;
using namespace cl::scene;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_below(const fs::path& folder, std::initializer_list<const char*> suffixes) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        const bool wanted = std::any_of(suffixes.begin(), suffixes.end(),
                                        [&](const char* s) { return entry.path().extension() == s; });
        if (entry.is_regular_file() && wanted) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string without_space(const std::string& text) {
    std::string out;
    std::copy_if(text.begin(), text.end(), std::back_inserter(out),
                 [](char c) { return static_cast<unsigned char>(c) > 32; });
    return out;
}

/// The first place where two texts part, with some of what follows; empty if they are equal.
std::string difference(const std::string& a, const std::string& b) {
    const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (in_a == a.end() && in_b == b.end()) {
        return {};
    }
    const auto at = static_cast<size_t>(in_a - a.begin());
    const size_t from = at > 40 ? at - 40 : 0;
    return "\"" + a.substr(from, 80) + "\" became \"" + b.substr(from, 80) + "\"";
}

} // namespace

TEST_SUITE("scene/io/shared") {
    TEST_CASE(
        "real text scenes and resources are read, and written back with a difference in white space alone") {
        const std::optional<fs::path> shared = cl::tests::shared_dir();
        if (!shared) {
            MESSAGE("skipped: no reference material");
            return;
        }
        cl::tests::register_types();
        const std::vector<fs::path> files =
            files_below(*shared / "assets/tscn-corpus", {".tscn", ".tres", ".escn"});
        CHECK(files.size() > 100);
        for (const fs::path& file : files) {
            CAPTURE(file.string());
            Diagnostics diagnostics;
            const Expected<SceneFile> parsed = read_scene_file(file, diagnostics, Spelling::Kept);
            REQUIRE_MESSAGE(parsed.has_value(), (parsed ? "" : parsed.error().to_string()));
            const std::string written = scene_file_text(*parsed);
            CHECK(difference(without_space(text_of(file)), without_space(written)) == "");
            const Expected<SceneFile> again = parse_scene_text(written, "again", diagnostics, Spelling::Kept);
            REQUIRE(again.has_value());
            CHECK(scene_file_text(*again) == written);
        }
    }

    TEST_CASE("real text scenes and resources can be inspected") {
        const std::optional<fs::path> shared = cl::tests::shared_dir();
        if (!shared) {
            MESSAGE("skipped: no reference material");
            return;
        }
        cl::tests::register_types();
        for (const fs::path& file :
             files_below(*shared / "assets/tscn-corpus", {".tscn", ".tres", ".escn"})) {
            CAPTURE(file.string());
            CHECK(inspect_file(file).has_value());
        }
    }

    TEST_CASE("the oracle's scenes load without a warning and pack back to what they say") {
        const std::optional<fs::path> shared = cl::tests::shared_dir();
        if (!shared) {
            MESSAGE("skipped: no reference material");
            return;
        }
        cl::tests::register_types();
        const std::vector<fs::path> files = files_below(*shared / "oracle/scenes", {".tscn"});
        CHECK(files.size() == 7);
        for (const fs::path& file : files) {
            CAPTURE(file.string());
            Diagnostics diagnostics;
            ResourceLoader loader(ProjectPaths::containing(file), diagnostics);
            const Expected<Ref<PackedScene>> scene = loader.load_scene(file);
            REQUIRE_MESSAGE(scene.has_value(), (scene ? "" : scene.error().to_string()));
            const Expected<std::unique_ptr<Node>> root = (*scene)->instance(diagnostics);
            REQUIRE_MESSAGE(root.has_value(), (root ? "" : root.error().to_string()));
            CHECK(cl::tests::lines_of(diagnostics).empty());

            // Packed, loaded and packed again it says the same.
            const PackOptions options{.path = (*scene)->path(), .original = (*scene)->file().get()};
            const Expected<SceneFile> packed = pack_scene(**root, loader, diagnostics, options);
            REQUIRE(packed.has_value());
            CHECK(packed->nodes.size() == (*scene)->file()->nodes.size());
            cl::tests::TestProject copy;
            copy.write("a.tscn", scene_file_text(*packed));
            const std::unique_ptr<Node> again = copy.load();
            REQUIRE_MESSAGE(again != nullptr, copy.error());
            const Expected<SceneFile> repacked = pack_scene(*again, copy.loader(), diagnostics,
                                                            {.path = "res://a.tscn", .original = &*packed});
            REQUIRE(repacked.has_value());
            CHECK(scene_file_text(*repacked) == scene_file_text(*packed));
        }
    }

    TEST_CASE("Sponza loads with all its surfaces and textures") {
        const std::optional<fs::path> shared = cl::tests::shared_dir();
        if (!shared) {
            MESSAGE("skipped: no reference material");
            return;
        }
        cl::tests::register_types();
        const fs::path file = *shared / "assets/gltf/Sponza/sponza_text.tscn";
        const auto start = std::chrono::steady_clock::now();
        Diagnostics diagnostics;
        ResourceLoader loader(ProjectPaths::containing(file), diagnostics);
        const Expected<Ref<PackedScene>> scene = loader.load_scene(file);
        REQUIRE_MESSAGE(scene.has_value(), (scene ? "" : scene.error().to_string()));
        const Expected<std::unique_ptr<Node>> root = (*scene)->instance(diagnostics);
        REQUIRE_MESSAGE(root.has_value(), (root ? "" : root.error().to_string()));
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        MESSAGE("Sponza loaded in " << took.count() << " ms");
        CHECK(cl::tests::lines_of(diagnostics).empty());
        const auto* mesh = dynamic_cast<const Mesh*>((*root)->get_node("Sponza")->get("mesh").to_object());
        REQUIRE(mesh != nullptr);
        CHECK(mesh->surface_count() == 25);
        size_t triangles = 0;
        for (const MeshSurface& surface : mesh->surfaces()) {
            triangles += surface.index_count / 3;
        }
        CHECK(triangles == 262267);
    }

    TEST_CASE("Sponza bakes to Godot's cells") {
        const std::optional<fs::path> shared = cl::tests::shared_dir();
        if (!shared) {
            MESSAGE("skipped: no reference material");
            return;
        }
        cl::tests::register_types();
        const fs::path file = *shared / "assets/gltf/Sponza/sponza_text.tscn";
        Diagnostics diagnostics;
        ResourceLoader loader(ProjectPaths::containing(file), diagnostics);
        const Expected<Ref<PackedScene>> scene = loader.load_scene(file);
        REQUIRE(scene.has_value());
        const Expected<std::unique_ptr<Node>> root = (*scene)->instance(diagnostics);
        REQUIRE(root.has_value());
        auto* probe = dynamic_cast<GIProbe*>((*root)->get_node("Probe"));
        REQUIRE(probe != nullptr);
        REQUIRE(probe->bake(root->get()).has_value());
        const Expected<gi::Octree> ours = gi::decode_octree(probe->data()->data().dynamic_data);
        const Expected<gi::Octree> theirs = gi::decode_octree(
            cl::tests::load_dynamic_data(*shared / "assets/godot-pictures/sponza_text_Probe.tres.xz"));
        REQUIRE(ours.has_value());
        REQUIRE(theirs.has_value());
        const cl::tests::Agreement a = cl::tests::agreement(*ours, *theirs);
        const double share = double(a.leaves_within_one) / double(a.common);
        MESSAGE("Sponza: " << a.common << " leaves in both, " << a.ours_only << " ours only, "
                           << a.theirs_only << " theirs only; " << 100.0 * share << " % within 1");
        CHECK(double(a.common) >= 0.999 * double(a.common + a.ours_only + a.theirs_only));
        CHECK(share >= 0.995); // JPEGs are decoded by another library
    }
}
