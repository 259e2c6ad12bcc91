#pragma once

#include <benchmark/benchmark.h>
#include <cstddef>

namespace cl::bench {

/// What all cores together copy from memory to memory [bytes read and written per second]; measured once.
[[nodiscard]] double memory_bandwidth();

/// Reports the bytes that an iteration moves, as a rate and as a part of memory_bandwidth(). Above 1: the
/// loop works in cache.
void report_bytes(benchmark::State& state, size_t bytes);

} // namespace cl::bench
