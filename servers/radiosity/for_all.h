#pragma once

#include "core/threads.h"

#include <cstddef>

namespace cl::radiosity {

/// Calls f(i) for i in [0, count) on all workers, in no order.
template <typename F>
void for_all(size_t count, const F& f) {
    constexpr size_t kGrain = 512;
    parallel_for(count, kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            f(i);
        }
    });
}

} // namespace cl::radiosity
