#include "tests/scene/text_scene.h"

#include "scene/io/config_file.h"
#include "scene/io/project_paths.h"
#include "scene/io/project_settings.h"

using namespace cl;
using namespace cl::scene;
namespace fs = std::filesystem;

namespace {

std::string file_of(const ProjectPaths& paths, std::string_view path, const fs::path& referrer = {}) {
    const Expected<fs::path> file = paths.file_of(path, referrer);
    return file ? file->lexically_relative(paths.root()).generic_string() : file.error().message;
}

} // namespace

TEST_SUITE("scene/io/project") {
    TEST_CASE("res:// is the nearest folder upward with a project.godot, else the scene's own") {
        const cl::tests::TestProject project;
        project.write("levels/inner/a.tscn", "");
        const fs::path root = project.file("project.godot").parent_path();
        CHECK(ProjectPaths::containing(project.file("levels/inner/a.tscn")).root() == root);
        CHECK(ProjectPaths::containing(project.file("levels/none.tscn")).root() == root);
        CHECK(ProjectPaths::containing(project.file("levels")).root() == root);
        project.write("levels/project.godot", "");
        CHECK(ProjectPaths::containing(project.file("levels/inner/a.tscn")).root() == root / "levels");

        const cl::tests::TemporaryDir alone;
        const ProjectPaths paths = ProjectPaths::containing(alone / "a.tscn");
        CHECK(paths.root() == alone.path());
        CHECK(!paths.has_project_file());
    }

    TEST_CASE("paths lead to files of the project, relative ones from the folder of the file that has them") {
        const cl::tests::TestProject project;
        const ProjectPaths paths = ProjectPaths::containing(project.file("a.tscn"));
        CHECK(file_of(paths, "res://a/b.png") == "a/b.png");
        CHECK(file_of(paths, "res://a/../b.png") == "b.png");
        CHECK(file_of(paths, "res:///etc/passwd") == "etc/passwd");
        CHECK(file_of(paths, "b.png", project.file("a/c.tscn")) == "a/b.png");
        CHECK(file_of(paths, "../b.png", project.file("a/c.tscn")) == "b.png");
        CHECK(file_of(paths, project.file("x.png").string()) == "x.png");
    }

    TEST_CASE("paths out of the project and other schemes are refused") {
        const cl::tests::TestProject project;
        const ProjectPaths paths = ProjectPaths::containing(project.file("a.tscn"));
        CHECK(file_of(paths, "res://../b.png") ==
              "expected a path inside the project, found \"res://../b.png\"");
        CHECK(file_of(paths, "res://a/../../b.png") ==
              "expected a path inside the project, found \"res://a/../../b.png\"");
        CHECK(file_of(paths, "user://b.png") ==
              "expected a path that starts with res://, found \"user://b.png\"");
        CHECK(file_of(paths, "http://b.png") ==
              "expected a path that starts with res://, found \"http://b.png\"");
    }

    TEST_CASE("a file of the project is named by res://, another by its absolute path") {
        const cl::tests::TestProject project;
        const ProjectPaths paths = ProjectPaths::containing(project.file("a.tscn"));
        CHECK(paths.resource_path_of(project.file("a/b.tres")) == "res://a/b.tres");
        CHECK(paths.resource_path_of("/elsewhere/b.tres") == "/elsewhere/b.tres");
    }

    TEST_CASE("a config file is sections of keys; keys before the first section stand alone") {
        Diagnostics diagnostics;
        const Expected<ConfigFile> config =
            ConfigFile::parse("; comment\nconfig_version=4\n\n[rendering]\n\n"
                              "quality/shadows/filter_mode=2\nenvironment/on=true\n"
                              "name=\"a\nb\"\nquality/shadows/filter_mode=1\n",
                              "project.godot", diagnostics);
        REQUIRE(config.has_value());
        CHECK(config->int_or("config_version", 0) == 4);
        CHECK(config->int_or("rendering/quality/shadows/filter_mode", 0) == 1);
        CHECK(config->bool_or("rendering/environment/on", false));
        CHECK(config->text_or("rendering/name", "") == "a\nb");
        CHECK(config->find("name") == nullptr);
        CHECK(config->text_or("rendering/environment/on", "other") == "other");
    }

    TEST_CASE(
        "project settings are read, those out of range warned about, and the rest are Godot's defaults") {
        cl::tests::TestProject project;
        project.write("project.godot",
                      "config_version=4\n[display]\nwindow/size/width=640\nwindow/size/height=0\n"
                      "[rendering]\nquality/voxel_cone_tracing/high_quality=true\n"
                      "environment/default_clear_color=Color( 0.1, 0.2, 0.3, 1 )\n"
                      "environment/default_environment=\"res://env.tres\"\n");
        Diagnostics diagnostics;
        const Expected<ProjectSettings> s =
            load_project_settings(ProjectPaths::containing(project.file("a.tscn")), diagnostics);
        REQUIRE(s.has_value());
        CHECK(s->window_size == glm::ivec2(640, 600));
        CHECK(s->voxel_cone_tracing_high_quality);
        CHECK(s->default_clear_color == Color{0.1f, 0.2f, 0.3f, 1.0f});
        CHECK(s->default_environment == "res://env.tres");
        CHECK(s->shadow_atlas_size == 4096);
        REQUIRE(diagnostics.warnings().size() == 1);
        CHECK(diagnostics.warnings()[0].message ==
              "display/window/size/height: expected 1 to 16384, found 0");
    }

    TEST_CASE("a damaged project.godot is an error with its place, none at all gives the defaults") {
        cl::tests::TestProject project;
        project.write("project.godot", "[display]\nwindow/size/width=(\n");
        Diagnostics diagnostics;
        const ProjectPaths paths = ProjectPaths::containing(project.file("a.tscn"));
        const Expected<ProjectSettings> s = load_project_settings(paths, diagnostics);
        REQUIRE(!s.has_value());
        CHECK(s.error().where.line == 2);
        const cl::tests::TemporaryDir alone;
        CHECK(load_project_settings(ProjectPaths::containing(alone / "a.tscn"), diagnostics)->window_size ==
              glm::ivec2(1024, 600));
    }
}
