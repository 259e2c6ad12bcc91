#include "servers/gi/light_memory.h"

#include "core/threads.h"

#include <algorithm>
#include <utility>

namespace cl::gi {

namespace {

void add(std::span<const int32_t> energies, int sign, std::span<int32_t> sums) {
    constexpr size_t kGrain = 16384;
    parallel_for(sums.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            sums[i] += sign * energies[i];
        }
    });
}

} // namespace

void LightMemory::inject(const CellLayout& layout, const CachedLight& light, int sign,
                         std::span<int32_t> leaf_energies) {
    const auto found =
        std::find_if(known_.begin(), known_.end(), [&](const Known& known) { return known.light == light; });
    if (sign < 0 && found != known_.end()) {
        add(found->energies, sign, leaf_energies);
        spare_ = std::move(found->energies);
        known_.erase(found);
        return;
    }
    if (sign < 0) {
        inject_light(layout, light, sign, leaf_energies);
        return;
    }
    if (known_.size() == kMostLights) {
        spare_ = std::move(known_.back().energies);
        known_.pop_back();
    }
    Known fresh{light, std::move(spare_)};
    fresh.energies.assign(leaf_energies.size(), 0);
    inject_light(layout, light, 1, fresh.energies);
    add(fresh.energies, 1, leaf_energies);
    known_.push_front(std::move(fresh));
}

} // namespace cl::gi
