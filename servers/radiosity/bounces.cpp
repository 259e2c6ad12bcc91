#include "servers/radiosity/bounces.h"

#include "core/threads.h"

#include <glm/ext/vector_double3.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <deque>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr int kMaxSteps = 64;
constexpr size_t kKept = 4; ///< earlier directions that a new one is made orthogonal to
constexpr double kTolerance = 2e-4;

using Column = std::vector<Rgb4>;

/// Sums that a pass over all records brings along, of each channel by itself.
template <size_t N>
using Sums = std::array<glm::dvec3, N>;

/// Calls f(record, sums) for all records on all workers; f adds to sums. In blocks, whose float32 sums stay
/// short, and are added in their order whoever made them.
template <size_t N, typename F>
Sums<N> sum_all(size_t count, const F& f) {
    constexpr size_t kBlock = 256, kGrain = 4;
    std::vector<std::array<Rgb4, N>> blocks((count + kBlock - 1) / kBlock);
    parallel_for(blocks.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t block = begin; block < end; ++block) {
            std::array<Rgb4, N> sums{};
            for (size_t r = block * kBlock; r < std::min((block + 1) * kBlock, count); ++r) {
                f(r, sums);
            }
            blocks[block] = sums;
        }
    });
    Sums<N> all{};
    for (const std::array<Rgb4, N>& block : blocks) {
        for (size_t i = 0; i < N; ++i) {
            all[i] += glm::dvec3(rgb(block[i]));
        }
    }
    return all;
}

/// a / b in each channel, 0 where there is nothing to divide by: a channel without light.
Rgb4 ratio(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    Rgb4 out{};
    for (int c = 0; c < 3; ++c) {
        out[c] = b[c] > 0.0 ? float(a[c] / b[c]) : 0.0f;
    }
    return out;
}

/// A direction in which light is added, and what that changes of the residual.
struct Direction {
    Column light, effect;
    glm::dvec3 square{0.0}; ///< of the effect
};

/// Makes a direction orthogonal to those before it, all of which are so to each other.
/// @param shares  products of effects with each of `known`
/// @return the effect's product with itself, and with the residual
Sums<2> orthogonalize(Direction& next, const std::deque<Direction>& known, const Sums<kKept>& products,
                      const Column& residual) {
    std::array<Rgb4, kKept> shares{};
    for (size_t k = 0; k < known.size(); ++k) {
        shares[k] = ratio(products[k], known[k].square);
    }
    return sum_all<2>(residual.size(), [&](size_t r, auto& sums) {
        Rgb4 light = next.light[r], effect = next.effect[r];
        for (size_t k = 0; k < known.size(); ++k) {
            light -= shares[k] * known[k].light[r];
            effect -= shares[k] * known[k].effect[r];
        }
        next.light[r] = light;
        next.effect[r] = effect;
        sums[0] += effect * effect;
        sums[1] += effect * residual[r];
    });
}

} // namespace

int sum_bounces(const Transport& t, std::span<const Rgb4> first, const std::atomic<bool>& stop,
                Column& arriving) {
    const size_t count = first.size();
    arriving.assign(first.begin(), first.end());
    Column residual(count); // what the second bounce adds
    Sums<2> squares = sum_all<2>(count, [&](size_t r, auto& sums) {
        residual[r] = exchanged(t, arriving, r);
        sums[0] += residual[r] * residual[r];
        sums[1] += arriving[r] * arriving[r];
    });
    std::deque<Direction> known;
    int steps = 1;
    for (; steps < kMaxSteps && !stop; ++steps) {
        if (glm::all(glm::lessThanEqual(squares[0], kTolerance * kTolerance * squares[1]))) {
            break;
        }
        Direction next{residual, Column(count), {}};
        const Sums<kKept> products = sum_all<kKept>(count, [&](size_t r, auto& sums) {
            next.effect[r] = residual[r] - exchanged(t, residual, r);
            for (size_t k = 0; k < known.size(); ++k) {
                sums[k] += next.effect[r] * known[k].effect[r];
            }
        });
        const auto [square, along] = orthogonalize(next, known, products, residual);
        next.square = square;
        const Rgb4 length = ratio(along, square);
        squares = sum_all<2>(count, [&](size_t r, auto& sums) {
            arriving[r] += length * next.light[r];
            residual[r] -= length * next.effect[r];
            sums[0] += residual[r] * residual[r];
            sums[1] += arriving[r] * arriving[r];
        });
        known.push_front(std::move(next));
        known.resize(std::min(known.size(), kKept));
    }
    return steps;
}

} // namespace cl::radiosity
