#pragma once

#include "servers/radiosity/gather.h"

#include <atomic>
#include <span>
#include <vector>

namespace cl::radiosity {

/// All bounces after the first: finds what records have where one more exchange changes nothing, each
/// channel to a residual of 2e-4. A room of albedo 0.95 that would take a hundred bounces takes a dozen
/// steps. The same numbers for any number of threads. Source: truncated generalised conjugate residuals
/// (Eisenstat, Elman and Schultz 1983).
/// @param first  light of one bounce, one a record. @param stop  gives up early
/// @param arriving  the result, one a record
/// @return steps taken
int sum_bounces(const Transport& transport, std::span<const Rgb4> first, const std::atomic<bool>& stop,
                std::vector<Rgb4>& arriving);

} // namespace cl::radiosity
