#pragma once

#include "core/expected.h"
#include "core/stopwatch.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cl::demo {

struct ProbeFigures {
    std::string path;
    glm::ivec3 size{0}; ///< [cells]
    uint32_t cells = 0;
    uint32_t leaves = 0;
    std::optional<double> bake_ms; ///< none: its data came with the scene
    uint64_t bytes = 0;            ///< of the data as stored
};

struct PathFigures {
    int samples = 0, depth = 0;
    uint32_t seed = 0;
    int64_t rays = 0;
    double seconds = 0.0; ///< that the rays took
};

/// The figures of a run, as `--stats` and `bench --json` write them. Times in milliseconds; a step that did
/// not run is none and becomes null,
/// as do the driver, renderer, size and gi of a run that draws nothing.
struct Figures {
    std::string scene, driver, renderer, gi;
    glm::ivec2 size{0};
    int threads = 0;
    std::optional<double> load_ms, bake_ms, relight_ms, upload_ms, frame_ms, gi_ms, total_ms;
    double peak_rss_mib = 0.0;
    std::vector<ProbeFigures> probes;
    std::optional<PathFigures> paths; ///< of `reference`
    int draw_calls = 0;
    int64_t triangles = 0;
    int lights = 0;
    size_t warnings = 0;
};

[[nodiscard]] std::string to_json(const Figures& figures);
/// "-" is standard output; files are written beside and renamed.
[[nodiscard]] Status write_json(const std::string& json, const std::filesystem::path& path);
/// Most memory this process has had resident so far [MiB].
[[nodiscard]] double peak_rss_mib();

} // namespace cl::demo
