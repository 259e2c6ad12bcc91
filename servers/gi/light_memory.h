#pragma once

#include "servers/gi/relight.h"

#include <deque>
#include <vector>

namespace cl::gi {

/// What the last few lights added to each leaf. A light that changes is taken out as it was before it is put
/// in as it is now: remembered, that is a subtraction instead of a march to every leaf. Sums are exact, so
/// the result is that of inject_light() to the bit. Costs 12 bytes a leaf and light.
class LightMemory {
public:
    /// inject_light(). @param layout  the same in every call
    void inject(const CellLayout& layout, const CachedLight& light, int sign,
                std::span<int32_t> leaf_energies);

private:
    static constexpr size_t kMostLights = 4;
    struct Known {
        CachedLight light;
        std::vector<int32_t> energies; ///< 3 per leaf
    };
    std::deque<Known> known_;    ///< latest first
    std::vector<int32_t> spare_; ///< memory of a light that is forgotten, for the next
};

} // namespace cl::gi
