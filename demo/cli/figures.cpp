#include "demo/cli/figures.h"

#include "demo/cli/options.h"

#include "core/io/file.h"

#include <nlohmann/json.hpp>

#include <iostream>
#include <sys/resource.h>

namespace cl::demo {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json text_or_null(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

Json size_or_null(glm::ivec2 size) {
    return size == glm::ivec2(0) ? Json(nullptr) : Json{size.x, size.y};
}

Json probe_json(const ProbeFigures& probe) {
    return {{"path", probe.path},
            {"size", {probe.size.x, probe.size.y, probe.size.z}},
            {"cells", probe.cells},
            {"leaves", probe.leaves},
            {"bake_ms", number_or_null(probe.bake_ms)},
            {"bytes", probe.bytes}};
}

Json path_json(const PathFigures& p) {
    return {{"spp", p.samples},
            {"depth", p.depth},
            {"seed", p.seed},
            {"rays", p.rays},
            {"rays_per_s", p.seconds > 0.0 ? static_cast<double>(p.rays) / p.seconds : 0.0}};
}

} // namespace

std::string to_json(const Figures& f) {
    Json probes = Json::array();
    for (const ProbeFigures& probe : f.probes) {
        probes.push_back(probe_json(probe));
    }
    Json json = {{"conelight", kVersion},
                 {"scene", f.scene},
                 {"driver", text_or_null(f.driver)},
                 {"renderer", text_or_null(f.renderer)},
                 {"size", size_or_null(f.size)},
                 {"gi", text_or_null(f.gi)},
                 {"threads", f.threads},
                 {"load_ms", number_or_null(f.load_ms)},
                 {"bake_ms", number_or_null(f.bake_ms)},
                 {"relight_ms", number_or_null(f.relight_ms)},
                 {"upload_ms", number_or_null(f.upload_ms)},
                 {"frame_ms", number_or_null(f.frame_ms)},
                 {"gi_ms", number_or_null(f.gi_ms)},
                 {"total_ms", number_or_null(f.total_ms)},
                 {"peak_rss_mib", f.peak_rss_mib},
                 {"probes", probes},
                 {"draw_calls", f.draw_calls},
                 {"triangles", f.triangles},
                 {"lights", f.lights},
                 {"warnings", f.warnings}};
    if (f.paths) {
        json["paths"] = path_json(*f.paths);
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Status write_json(const std::string& json, const std::filesystem::path& path) {
    if (path == "-") {
        std::cout << json << std::flush;
        return {};
    }
    return write_file_atomic(path, json);
}

double peak_rss_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0; // ru_maxrss is in KiB on Linux
}

} // namespace cl::demo
