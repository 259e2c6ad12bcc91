#include "drivers/embree/sampler.h"

namespace cl::embree {

namespace {

constexpr uint32_t kChoices = static_cast<uint32_t>(Choice::Count);
constexpr uint32_t kRaySeedSalt = 0x9e3779b9u; // any word: apart from the dimensions of pair()

uint32_t reverse_bits(uint32_t v) noexcept {
    v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
    return (v >> 16) | (v << 16);
}

/// Owen scrambling: each bit flips by a hash of the bits above it (Burley 2020, section 3, after Laine and
/// Karras).
uint32_t owen_scramble(uint32_t v, uint32_t seed) noexcept {
    v = reverse_bits(v) + seed;
    v ^= v * 0x6c50b47cu;
    v ^= v * 0xb82f1e52u;
    v ^= v * 0xc7afe638u;
    v ^= v * 0x8d22f6e6u;
    return reverse_bits(v);
}

/// Second dimension of Sobol's sequence; the first is reverse_bits().
uint32_t sobol_second(uint32_t index) noexcept {
    uint32_t result = 0;
    for (uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1) {
        result ^= (index & 1u) != 0 ? v : 0u;
    }
    return result;
}

} // namespace

HashWords pcg3d(HashWords v) noexcept {
    v.x = v.x * 1664525u + 1013904223u;
    v.y = v.y * 1664525u + 1013904223u;
    v.z = v.z * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.x ^= v.x >> 16;
    v.y ^= v.y >> 16;
    v.z ^= v.z >> 16;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

glm::vec2 Sampler::pair(int vertex, Choice choice) const noexcept {
    const uint32_t dimension = static_cast<uint32_t>(vertex) * kChoices + static_cast<uint32_t>(choice);
    const HashWords seeds = pcg3d({seed_, pixel_, dimension});
    const uint32_t index = owen_scramble(sample_, seeds.x);
    return {unit_float(owen_scramble(reverse_bits(index), seeds.y)),
            unit_float(owen_scramble(sobol_second(index), seeds.z))};
}

uint32_t Sampler::ray_seed(int vertex) const noexcept {
    const HashWords words = pcg3d({seed_, pixel_, sample_});
    return pcg3d({words.x, static_cast<uint32_t>(vertex), kRaySeedSalt}).x;
}

} // namespace cl::embree
