// A light's bounce at the leaves that it reaches (spec gi-update section 5.1, "Injection").
#include "servers/gi/relight.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>
#include <cmath>

namespace cl::gi {

namespace {

constexpr double kMaxEnergy = double(1 << 24);

/// Truncates toward zero and keeps sums far from overflow; NaN gives 0.
int32_t truncated(double v) {
    return std::isnan(v) ? 0 : int32_t(std::clamp(v, -kMaxEnergy, kMaxEnergy));
}

/// Energy of a light, per channel.
glm::ivec3 light_energy(const CachedLight& light) {
    glm::ivec3 energy(0);
    for (int c = 0; c < 3; ++c) {
        energy[c] = truncated(double(light.color[c] * light.energy) * 1024.0);
    }
    return energy;
}

/// Energy that a leaf of this albedo reflects, of a channel.
int32_t reflected(float light_energy, float share, uint8_t albedo) {
    return truncated(double(light_energy * share * float(albedo)) / 255.0);
}

bool is_finite(const CachedLight& light) {
    return std::isfinite(light.color.r) && std::isfinite(light.color.g) && std::isfinite(light.color.b) &&
           std::isfinite(light.energy);
}

} // namespace

bool is_dark(const CachedLight& light) noexcept {
    return !light.visible || !is_finite(light) || light_energy(light) == glm::ivec3(0);
}

void add_light(const CellLayout& layout, std::span<const LitLeaf> lit, const CachedLight& light, int sign,
               std::span<int32_t> leaf_energies) {
    CL_ASSERT(sign == 1 || sign == -1, "a light comes or goes");
    CL_ASSERT(leaf_energies.size() == layout.leaves.size() * 3, "three energies a leaf");
    if (is_dark(light)) {
        return;
    }
    constexpr size_t kGrain = 4096;
    const glm::vec3 energy(light_energy(light) * sign);
    parallel_for(lit.size(), kGrain, [&](size_t begin, size_t end) {
        for (const auto& [leaf, share] : lit.subspan(begin, end - begin)) {
            const glm::u8vec3 albedo = layout.leaves[leaf].albedo;
            for (int c = 0; c < 3; ++c) {
                leaf_energies[size_t(leaf) * 3 + size_t(c)] += reflected(energy[c], share, albedo[c]);
            }
        }
    });
}

void inject_light(const CellLayout& layout, const CachedLight& light, int sign,
                  std::span<int32_t> leaf_energies) {
    if (!is_dark(light)) {
        add_light(layout, find_lit_leaves(layout, light), light, sign, leaf_energies);
    }
}

} // namespace cl::gi
