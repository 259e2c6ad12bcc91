#pragma once

#include "demo/cli/options.h"

#include "core/expected.h"

namespace cl::demo {

// Exit statuses that users and scripts rely on.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1; ///< the scene or a file is wrong, or a step failed; one line was printed
inline constexpr int kWrongCommand = 2;
inline constexpr int kNoDriver = 3;

// One function a command; each prints its errors and gives the exit status.
[[nodiscard]] int run_render(const Options& options);
[[nodiscard]] int run_live(const Options& options);
[[nodiscard]] int run_bake(const Options& options);
[[nodiscard]] int run_reference(const Options& options);
[[nodiscard]] int run_inspect(const Options& options);
[[nodiscard]] int run_bench(const Options& options);

/// Prints one line, `file:line:column: error: ...`, and gives `status`.
int fail(const Error& error, int status = kFailed);

} // namespace cl::demo
