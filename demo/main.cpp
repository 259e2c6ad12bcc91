#include "demo/cli/commands.h"
#include "demo/cli/options.h"

#include "scene/register_types.h"

#include "core/io/log.h"
#include "core/object/class_registry.h"
#include "core/threads.h"

namespace {

int run(const cl::demo::Options& options) {
    switch (options.command) {
    case cl::demo::Command::Render:
        return cl::demo::run_render(options);
    case cl::demo::Command::Run:
        return cl::demo::run_live(options);
    case cl::demo::Command::Bake:
        return cl::demo::run_bake(options);
    case cl::demo::Command::Reference:
        return cl::demo::run_reference(options);
    case cl::demo::Command::Inspect:
        return cl::demo::run_inspect(options);
    case cl::demo::Command::Bench:
        return cl::demo::run_bench(options);
    }
    return cl::demo::kWrongCommand;
}

cl::LogLevel log_level_of(cl::demo::Verbosity verbosity) {
    switch (verbosity) {
    case cl::demo::Verbosity::Quiet:
        return cl::LogLevel::Error;
    case cl::demo::Verbosity::Normal:
        return cl::LogLevel::Info;
    case cl::demo::Verbosity::Verbose:
        return cl::LogLevel::Debug;
    }
    return cl::LogLevel::Info;
}

} // namespace

int main(int argc, char** argv) {
    const cl::demo::ParsedCommandLine parsed = cl::demo::parse_command_line(argc, argv);
    if (!parsed.options) {
        return parsed.exit_status;
    }
    cl::set_log_level(log_level_of(parsed.options->verbosity));
    cl::set_thread_count(parsed.options->threads);
    cl::scene::register_scene_types(cl::ClassRegistry::instance());
    return run(*parsed.options);
}
