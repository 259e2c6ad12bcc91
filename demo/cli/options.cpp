#include "demo/cli/options.h"

#include "core/variant/variant_parser.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <iostream>

namespace cl::demo {

namespace {

const std::map<std::string, GIMode> kGIModes{
    {"off", GIMode::Off}, {"cones", GIMode::Cones}, {"auto", GIMode::Auto}};
const std::map<std::string, Quality> kQualities{{"low", Quality::Low}, {"high", Quality::High}};
constexpr int kMaxPictureEdge = 16384;

/// Names to their values; the help shows the option's type_name alone, as the values have no text of their
/// own.
template <typename T>
CLI::CheckedTransformer one_of(const std::map<std::string, T>& values) {
    CLI::CheckedTransformer transformer(values);
    transformer.description("");
    return transformer;
}

std::optional<glm::ivec2> parse_size(const std::string& text) {
    glm::ivec2 size{0};
    const char* end = text.data() + text.size();
    const auto [x, x_error] = std::from_chars(text.data(), end, size.x);
    if (x_error != std::errc() || x == end || *x != 'x') {
        return std::nullopt;
    }
    const auto [y, y_error] = std::from_chars(x + 1, end, size.y);
    if (y_error != std::errc() || y != end) {
        return std::nullopt;
    }
    const bool in_range = size.x > 0 && size.y > 0 && size.x <= kMaxPictureEdge && size.y <= kMaxPictureEdge;
    return in_range ? std::optional(size) : std::nullopt;
}

std::optional<PropertyOverride> parse_override(const std::string& text) {
    const size_t equals = text.find('=');
    const size_t colon = text.rfind(':', equals);
    if (equals == std::string::npos || colon == std::string::npos || colon + 1 == equals) {
        return std::nullopt;
    }
    return PropertyOverride{text.substr(0, colon), text.substr(colon + 1, equals - colon - 1),
                            text.substr(equals + 1)};
}

void add_common(CLI::App& app, Options& o, const char* what) {
    app.add_option(what, o.input, "the file to read")->required();
    app.add_flag_callback(
        "-q,--quiet", [&o] { o.verbosity = Verbosity::Quiet; }, "say nothing but errors");
    app.add_flag_callback(
        "-v,--verbose", [&o] { o.verbosity = Verbosity::Verbose; }, "say what is being done");
    app.add_option("--threads", o.threads, "worker threads (default: all cores)")->check(CLI::Range(1, 1024));
}

void add_scene(CLI::App& app, Options& o) {
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&o](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   const auto parsed = parse_override(text);
                   if (!parsed) {
                       throw CLI::ValidationError("--set", "expected PATH:PROPERTY=VALUE, found " + text);
                   }
                   if (const Expected<Variant> value = parse_variant(parsed->value_text, parsed->property);
                       !value) {
                       throw CLI::ValidationError("--set", value.error().to_string());
                   }
                   o.overrides.push_back(*parsed);
               }
           },
           "override a property before the first frame; VALUE in scene-file syntax; repeatable")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("PATH:PROPERTY=VALUE");
}

void add_view(CLI::App& app, Options& o) {
    add_scene(app, o);
    app.add_option_function<std::string>(
           "--size",
           [&o](const std::string& text) {
               o.size = parse_size(text);
               if (!o.size) {
                   throw CLI::ValidationError("--size",
                                              "expected WxH with edges of 1 to 16384, found " + text);
               }
           },
           "pixels (default: the project's setting, else 1024x600)")
        ->type_name("WxH");
    app.add_option("--camera", o.camera_path, "node path of the camera (default: the current one)");
}

void add_drawing(CLI::App& app, Options& o) {
    add_view(app, o);
    app.add_option("--gi", o.gi_mode,
                   "global illumination: off, cones (Godot 3.2's) or auto (the best there is)")
        ->transform(one_of(kGIModes))
        ->type_name("MODE");
    app.add_option("--quality", o.quality, "low (4 cones) or high (6 cones)")
        ->transform(one_of(kQualities))
        ->type_name("low|high");
    app.add_option("--driver", o.driver, "where the GL context comes from: osmesa, egl or window")
        ->check(CLI::IsMember({"osmesa", "egl", "window"}))
        ->type_name("NAME");
}

void add_stats(CLI::App& app, Options& o) {
    app.add_option("--stats", o.stats_file, "write the run's figures as JSON")->type_name("FILE");
}

void add_outputs(CLI::App& app, Options& o) {
    app.add_option("-o,--output", o.outputs, ".png (8-bit sRGB) or .exr (linear radiance); repeatable")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("FILE");
}

void add_render(CLI::App& app, Options& o) {
    CLI::App* c = app.add_subcommand("render", "load, bake what is unbaked, light, draw, write the picture");
    add_common(*c, o, "SCENE");
    add_drawing(*c, o);
    add_stats(*c, o);
    add_outputs(*c, o);
    c->add_option("--frames", o.frames,
                  "frames drawn before the picture is taken (default: enough to settle)")
        ->check(CLI::Range(1, 1'000'000));
    c->callback([&o] { o.command = Command::Render; });
}

void add_run(CLI::App& app, Options& o) {
    CLI::App* c =
        app.add_subcommand("run", "the same scene, live, in a window: WASD and mouse fly, Esc ends");
    add_common(*c, o, "SCENE");
    add_drawing(*c, o);
    add_stats(*c, o);
    c->add_option("--frames", o.frames, "end after this many frames (default: at Esc)")
        ->check(CLI::Range(1, 1'000'000'000));
    c->callback([&o] { o.command = Command::Run; });
}

void add_bake(CLI::App& app, Options& o) {
    CLI::App* c = app.add_subcommand("bake", "voxelise the scene's GIProbes and write their GIProbeData");
    add_common(*c, o, "SCENE");
    add_scene(*c, o);
    add_stats(*c, o);
    c->add_option("--probe", o.probe_paths, "node path of a probe; repeatable (default: all)")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("PATH");
    c->add_option("--subdiv", o.subdivision, "cells along the longest axis (default: the probe's)")
        ->check(CLI::IsMember({64, 128, 256, 512}))
        ->type_name("64|128|256|512");
    c->add_option("-o,--output", o.output_dir,
                  "folder for one .tres a probe, made if missing (default: beside the scene)")
        ->type_name("DIR");
    c->add_flag("--embed", o.embed, "write the data's reference into the scene");
    c->add_flag("--compat", o.compat, "Godot 3.2's sampling, cell for cell");
    c->add_option("--json", o.json_file, "write what was baked as JSON (- for standard output)")
        ->type_name("FILE");
    c->callback([&o] { o.command = Command::Bake; });
}

void add_reference(CLI::App& app, Options& o) {
    CLI::App* c =
        app.add_subcommand("reference", "path-traced truth of the same camera and lights; no GPU, no probes");
    add_common(*c, o, "SCENE");
    add_view(*c, o);
    add_stats(*c, o);
    add_outputs(*c, o);
    c->add_option("--spp", o.samples, "paths a pixel (default 256)")->check(CLI::Range(1, 1 << 24));
    c->add_option("--depth", o.depth, "most reflections of a path, 0: emission alone (default 64)")
        ->check(CLI::Range(0, 100'000));
    c->add_option("--seed", o.seed, "of the random numbers: same seed, same picture (default 0)");
    c->callback([&o] { o.command = Command::Reference; });
}

void add_inspect(CLI::App& app, Options& o) {
    CLI::App* c = app.add_subcommand("inspect", "what is in a scene, resource or probe");
    add_common(*c, o, "FILE");
    c->add_flag("--json", o.as_json, "for machines");
    c->add_flag("--tree", o.tree, "the running tree, instances resolved");
    c->callback([&o] { o.command = Command::Inspect; });
}

void add_bench(CLI::App& app, Options& o) {
    CLI::App* c = app.add_subcommand("bench", "medians of repeated bakes, relights and frames");
    add_common(*c, o, "SCENE");
    add_drawing(*c, o);
    c->add_option("--runs", o.runs, "repetitions (default 7)")->check(CLI::Range(1, 10'000));
    c->add_option("--json", o.json_file, "write the figures as JSON (- for standard output)")
        ->type_name("FILE");
    c->callback([&o] { o.command = Command::Bench; });
}

} // namespace

ParsedCommandLine parse_command_line(int argc, const char* const* argv) {
    Options o;
    CLI::App app{"Conelight: global illumination by voxel cone tracing, on any machine", "conelight"};
    app.set_version_flag("--version", std::string("conelight ") + kVersion);
    app.require_subcommand(1);
    add_render(app, o);
    add_run(app, o);
    add_bake(app, o);
    add_reference(app, o);
    add_inspect(app, o);
    add_bench(app, o);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& said) { // --help, --version
        return {std::nullopt, app.exit(said)};
    } catch (const CLI::ParseError& wrong) {
        std::cerr << "conelight: error: " << wrong.what() << " (see conelight --help)\n";
        return {std::nullopt, 2};
    }
    if (o.outputs.empty()) {
        o.outputs.emplace_back("out.png");
    }
    return {o, 0};
}

} // namespace cl::demo
