#include "servers/gi/light_memory.h"

#include <algorithm>
#include <utility>

namespace cl::gi {

void LightMemory::inject(const CellLayout& layout, const CachedLight& light, int sign,
                         std::span<int32_t> leaf_energies) {
    if (is_dark(light)) {
        return;
    }
    auto known = std::find_if(known_.begin(), known_.end(),
                              [&](const Known& k) { return reach_alike(k.light, light); });
    if (known == known_.end()) {
        std::vector<LitLeaf> lit = find_lit_leaves(layout, light);
        forget_beyond(kMostLeaves - std::min(kMostLeaves, lit.size()));
        known = known_.insert(known_.begin(), {light, std::move(lit)});
    }
    add_light(layout, known->lit, light, sign, leaf_energies);
    // A light that was taken out most likely moved: its place is the first to be forgotten, unless it is put
    // back in before.
    known_.splice(sign > 0 ? known_.begin() : known_.end(), known_, known);
}

void LightMemory::forget_beyond(size_t most_leaves) {
    size_t leaves = 0;
    const auto first_too_many = std::find_if(
        known_.begin(), known_.end(), [&](const Known& k) { return (leaves += k.lit.size()) > most_leaves; });
    known_.erase(first_too_many, known_.end());
}

} // namespace cl::gi
