#include "demo/cli/commands.h"
#include "demo/cli/figures.h"
#include "demo/cli/scene_loading.h"

#include "scene/3d/gi_probe.h"
#include "scene/io/resource_packer.h"
#include "scene/io/scene_edit.h"
#include "scene/io/text_writer.h"

#include "core/io/file.h"
#include "core/io/log.h"
#include "core/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <vector>

namespace cl::demo {

namespace {

/// The probes of `--probe`, else all. NotFound names the path that is no probe.
Expected<std::vector<scene::GIProbe*>> choose_probes(scene::Node& root, const Options& options) {
    if (options.probe_paths.empty()) {
        return find_probes(root);
    }
    std::vector<scene::GIProbe*> chosen;
    for (const std::string& path : options.probe_paths) {
        auto* probe = root.get_node_as<scene::GIProbe>(path);
        if (!probe) {
            return Error{ErrorCode::NotFound,
                         fmt::format("--probe: expected the path of a GIProbe, found {}", path)};
        }
        chosen.push_back(probe);
    }
    return chosen;
}

/// A file name for each probe: the node's name, numbered where several probes share it.
class FileNames {
public:
    std::string make(const scene::GIProbe& probe) {
        const std::string& name = probe.name().str();
        std::string file = name + ".tres";
        for (int n = 2; !taken_.insert(file).second; ++n) {
            file = fmt::format("{}_{}.tres", name, n);
        }
        return file;
    }

private:
    std::unordered_set<std::string> taken_;
};

/// Writes only what differs from the file that is there. @return whether it wrote.
Expected<bool> save_if_changed(const scene::GIProbeData& data, const std::filesystem::path& path) {
    const std::string text = scene::scene_file_text(scene::pack_resource_file(data));
    if (std::filesystem::is_regular_file(path)) {
        const Expected<std::string> before = read_text_file(path);
        if (before && *before == text) {
            return false;
        }
    }
    if (Status written = write_file_atomic(path, text); !written) {
        return written.error();
    }
    return true;
}

struct Baked {
    scene::GIProbe* probe;
    std::filesystem::path file;
};

/// The folder of `-o`; it is made if it is not there.
Status make_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) {
        return Error{ErrorCode::IoError, "cannot make the folder: " + failed.message(), {folder.string()}};
    }
    return {};
}

/// Writes one file a probe, and its reference into the scene with `--embed`. @return how many files were
/// written.
Expected<int> write_all(const std::vector<Baked>& baked, const scene::Node& root, const Options& options) {
    int written = 0;
    for (const Baked& b : baked) {
        const Expected<bool> wrote = save_if_changed(*b.probe->data(), b.file);
        if (!wrote) {
            return wrote.error();
        }
        if (*wrote) {
            ++written;
            log_info(b.file.string());
        }
        if (!options.embed) {
            continue;
        }
        const Expected<bool> embedded =
            scene::embed_probe_data(options.input, path_from_root(root, *b.probe), b.file);
        if (!embedded) {
            return embedded.error();
        }
        written += *embedded ? 1 : 0;
    }
    return written;
}

Status write_figures(const Figures& figures, const Options& options) {
    for (const std::filesystem::path& path : {options.json_file, options.stats_file}) {
        if (path.empty()) {
            continue;
        }
        if (Status written = write_json(to_json(figures), path); !written) {
            return written;
        }
    }
    return {};
}

} // namespace

int run_bake(const Options& options) {
    const Stopwatch total;
    Diagnostics diagnostics;
    Expected<LoadedScene> loaded = load_scene(options, diagnostics);
    if (!loaded) {
        return fail(loaded.error());
    }
    print_warnings(diagnostics, options.verbosity);
    scene::Node& root = *loaded->root;
    const Expected<std::vector<scene::GIProbe*>> probes = choose_probes(root, options);
    if (!probes) {
        return fail(probes.error());
    }
    if (probes->empty()) {
        return fail(
            {ErrorCode::NotFound, "expected a scene with a GIProbe, found none", {options.input.string()}});
    }
    Figures figures;
    double bake_ms = 0.0;
    std::vector<Baked> baked;
    FileNames names;
    const std::filesystem::path folder =
        options.output_dir.empty() ? options.input.parent_path() : options.output_dir;
    if (!options.output_dir.empty()) {
        if (const Status made = make_folder(folder); !made) {
            return fail(made.error());
        }
    }
    for (scene::GIProbe* probe : *probes) {
        if (options.subdivision) {
            // 64, 128, 256, 512 are checked on the command line: 64 << subdiv.
            const int subdiv = static_cast<int>(std::lround(std::log2(*options.subdivision / 64)));
            (void)probe->set_subdiv(static_cast<scene::GIProbeSubdiv>(subdiv));
        }
        Expected<ProbeFigures> one = bake_with_progress(root, *probe, options);
        if (!one) {
            return fail(one.error());
        }
        bake_ms += *one->bake_ms;
        figures.probes.push_back(*one);
        baked.push_back({probe, folder / names.make(*probe)});
    }
    const Expected<int> written = write_all(baked, root, options);
    if (!written) {
        return fail(written.error());
    }
    if (*written == 0) {
        log_info("nothing changed, nothing written");
    }
    figures.scene = options.input.filename().string();
    figures.threads = thread_count();
    figures.load_ms = loaded->load_ms;
    figures.bake_ms = bake_ms;
    figures.total_ms = total.elapsed_ms();
    figures.peak_rss_mib = peak_rss_mib();
    figures.warnings = diagnostics.warnings().size();
    const Status status = write_figures(figures, options);
    return status ? kDone : fail(status.error());
}

} // namespace cl::demo
