#pragma once

#include "servers/gi/relight.h"

#include <list>
#include <vector>

namespace cl::gi {

/// Which leaves the last few lights reach, and by what share. To find that out is most of a light's cost, and
/// it only depends on where the light is and how it is shaped: a light that changes colour or energy, or
/// flickers, is not marched again, nor is one that is taken out as it was to be put in elsewhere. Sums are
/// exact and shares are kept to the bit, so the result is that of inject_light().
class LightMemory {
public:
    /// inject_light(). @param layout  the same in every call
    void inject(const CellLayout& layout, const CachedLight& light, int sign,
                std::span<int32_t> leaf_energies);

private:
    /// Eight lights or so at 256^3, one or two at 512^3. The latest is kept in any case.
    static constexpr size_t kMostLeaves = (size_t{16} << 20) / sizeof(LitLeaf);
    struct Known {
        CachedLight light;
        std::vector<LitLeaf> lit;
    };
    void forget_beyond(size_t most_leaves);

    std::list<Known> known_; ///< the first to be forgotten is the last
};

} // namespace cl::gi
