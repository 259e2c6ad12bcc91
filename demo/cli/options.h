#pragma once

#include "servers/render_types.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cl::demo {

enum class Command { Render, Run, Bake, Reference, Inspect, Bench };
enum class Verbosity { Quiet, Normal, Verbose };

/// `--set PATH:PROPERTY=VALUE`, split but not yet read.
struct PropertyOverride {
    std::string node_path;
    std::string property;
    std::string value_text; ///< scene-file syntax
};

/// The whole command line, checked for form; what it names may still not exist.
struct Options {
    Command command = Command::Render;
    std::filesystem::path input; ///< SCENE, or FILE of inspect
    Verbosity verbosity = Verbosity::Normal;
    int threads = 0; ///< 0: all cores

    // commands that draw
    std::vector<std::filesystem::path> outputs;
    std::optional<glm::ivec2> size;
    GIMode gi_mode = GIMode::Auto;
    Quality quality = Quality::High;
    std::string camera_path;
    std::vector<PropertyOverride> overrides;
    std::optional<int> frames;
    std::string driver; ///< empty: the first that works
    std::filesystem::path stats_file;

    // bake
    std::vector<std::string> probe_paths;
    std::optional<int> subdivision;
    std::filesystem::path output_dir;
    bool embed = false;
    bool compat = false;

    // reference
    int samples = 256; ///< paths a pixel
    int depth = 64;    ///< most reflections of a path
    uint32_t seed = 0;

    // inspect
    bool as_json = false;
    bool tree = false;

    // bench
    int runs = 7;
    std::filesystem::path json_file; ///< also `bake --json`
};

/// What parsing the command line came to: options to act on, or an exit status because everything was said.
struct ParsedCommandLine {
    std::optional<Options> options;
    int exit_status = 0; ///< 0 after --help or --version, 2 if the command line is wrong
};

/// Reads the command line; prints help, version or one line on what is wrong.
[[nodiscard]] ParsedCommandLine parse_command_line(int argc, const char* const* argv);

inline constexpr const char* kVersion = "0.1.0";

} // namespace cl::demo
