#include "scene/io/project_settings.h"

#include "scene/io/config_file.h"

#include <fmt/format.h>

namespace cl::scene {

namespace {

class SettingsReader {
public:
    SettingsReader(const ConfigFile& config, std::string file, Diagnostics& diagnostics)
        : config_(config), file_(std::move(file)), diagnostics_(diagnostics) {}

    void read(std::string_view key, int& setting, int least, int most) {
        const int64_t value = config_.int_or(key, setting);
        if (value < least || value > most) {
            diagnostics_.warn({file_},
                              fmt::format("{}: expected {} to {}, found {}", key, least, most, value));
            return;
        }
        setting = static_cast<int>(value);
    }
    void read(std::string_view key, bool& setting) { setting = config_.bool_or(key, setting); }
    void read(std::string_view key, std::string& setting) { setting = config_.text_or(key, setting); }
    void read(std::string_view key, Color& setting) {
        const Variant* value = config_.find(key);
        if (const Color* color = value ? value->get_if<Color>() : nullptr) {
            setting = *color;
        }
    }

private:
    const ConfigFile& config_;
    std::string file_;
    Diagnostics& diagnostics_;
};

} // namespace

Expected<ProjectSettings> load_project_settings(const ProjectPaths& paths, Diagnostics& diagnostics) {
    ProjectSettings s;
    if (!paths.has_project_file()) {
        return s;
    }
    const std::filesystem::path file = paths.root() / "project.godot";
    const Expected<ConfigFile> config = ConfigFile::load(file, diagnostics);
    if (!config) {
        return config.error();
    }
    constexpr int kMaxPixels = 16384;
    SettingsReader r(*config, file.string(), diagnostics);
    r.read("display/window/size/width", s.window_size.x, 1, kMaxPixels);
    r.read("display/window/size/height", s.window_size.y, 1, kMaxPixels);
    r.read("rendering/environment/default_clear_color", s.default_clear_color);
    r.read("rendering/environment/default_environment", s.default_environment);
    r.read("application/run/main_scene", s.main_scene);
    r.read("rendering/quality/voxel_cone_tracing/high_quality", s.voxel_cone_tracing_high_quality);
    r.read("rendering/quality/shadows/filter_mode", s.shadow_filter_mode, 0, 2);
    r.read("rendering/quality/shadow_atlas/size", s.shadow_atlas_size, 256, kMaxPixels);
    r.read("rendering/quality/directional_shadow/size", s.directional_shadow_size, 256, kMaxPixels);
    r.read("rendering/quality/reflections/high_quality_ggx", s.high_quality_ggx);
    r.read("rendering/quality/filters/msaa", s.msaa, 0, 4);
    return s;
}

} // namespace cl::scene
