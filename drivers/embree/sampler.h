#pragma once

#include <glm/vec2.hpp>

#include <cstdint>

namespace cl::embree {

/// What a pair of random numbers decides. A path's vertex has one pair for each, so that a decision keeps its
/// own well-spread sequence whatever the others do.
enum class Choice : uint8_t { Pixel, EmitterTriangle, EmitterPoint, Sky, Lobe, Direction, Count };

/// The random numbers of one sample of one pixel. They are a function of seed, pixel, sample and what they
/// are for, and nothing is remembered: the same picture comes out for any number of threads and any order of
/// work.
///
/// The samples of a pixel are spread evenly: each choice takes a Sobol' (0, 2)-sequence in an order and with
/// digits of its own. Source: Burley 2020, "Practical Hash-based Owen Scrambling" (JCGT 9-4), sections 3 and
/// 5; hash: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering" (JCGT 9-3), pcg3d.
class Sampler {
public:
    /// @param pixel  index of the pixel in the picture
    Sampler(uint32_t seed, uint32_t pixel, uint32_t sample) noexcept
        : seed_(seed), pixel_(pixel), sample_(sample) {}

    /// Two numbers in [0, 1). @param vertex  of the path, 0 being the camera's
    [[nodiscard]] glm::vec2 pair(int vertex, Choice choice) const noexcept;
    /// What chances on the way of a ray that leaves `vertex` go by.
    [[nodiscard]] uint32_t ray_seed(int vertex) const noexcept;

private:
    uint32_t seed_, pixel_, sample_;
};

/// Three well-mixed words from three.
struct HashWords {
    uint32_t x, y, z;
};
[[nodiscard]] HashWords pcg3d(HashWords v) noexcept;

/// In [0, 1), of the upper 24 bits: exact in a float.
[[nodiscard]] inline float unit_float(uint32_t bits) noexcept {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

} // namespace cl::embree
