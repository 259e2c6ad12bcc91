#include "tests/bench/micro/memory.h"

#include "core/threads.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <vector>

namespace cl::bench {

namespace {

constexpr size_t kBytes = size_t{256} << 20; ///< far more than any cache
constexpr size_t kChunk = size_t{1} << 20;

double copy_rate(std::vector<uint8_t>& to, const std::vector<uint8_t>& from) {
    const auto begin = std::chrono::steady_clock::now();
    parallel_for(kBytes / kChunk, 1, [&](size_t first, size_t last) {
        std::memcpy(to.data() + first * kChunk, from.data() + first * kChunk, (last - first) * kChunk);
    });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    benchmark::DoNotOptimize(to.data());
    return 2.0 * double(kBytes) / took.count();
}

void copy_memory(benchmark::State& state) {
    for (auto _ : state) {
        static_cast<void>(_);
        benchmark::DoNotOptimize(memory_bandwidth());
    }
    state.counters["bytes_per_second"] = memory_bandwidth();
}
BENCHMARK(copy_memory)->Iterations(1);

} // namespace

double memory_bandwidth() {
    static const double best = [] {
        std::vector<uint8_t> from(kBytes, 1), to(kBytes, 2); // all pages are there
        double rate = 0.0;
        for (int i = 0; i < 7; ++i) {
            rate = std::max(rate, copy_rate(to, from));
        }
        return rate;
    }();
    return best;
}

void report_bytes(benchmark::State& state, size_t bytes) {
    state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(bytes));
    state.counters["of_memory"] =
        benchmark::Counter(double(bytes) / memory_bandwidth(), benchmark::Counter::kIsIterationInvariantRate);
}

} // namespace cl::bench
