#include "servers/radiosity/bounces.h"

#include <glm/ext/vector_double3.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <deque>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr int kMaxSteps = 64;
constexpr size_t kKept = 4; ///< earlier directions that a new one is made orthogonal to
constexpr double kTolerance = 2e-4;

using Column = std::vector<Rgb4>;

/// Sums of products, of each channel by itself. In blocks, whose float32 sums stay short.
glm::dvec3 dot(std::span<const Rgb4> a, std::span<const Rgb4> b) noexcept {
    constexpr size_t kBlock = 256;
    glm::dvec3 sum(0.0);
    for (size_t begin = 0; begin < a.size(); begin += kBlock) {
        const size_t end = std::min(begin + kBlock, a.size());
        Rgb4 even{}, odd{};
        for (size_t i = begin; i + 1 < end; i += 2) {
            even += a[i] * b[i];
            odd += a[i + 1] * b[i + 1];
        }
        if ((end - begin) % 2 == 1) {
            even += a[end - 1] * b[end - 1];
        }
        sum += glm::dvec3(rgb(even + odd));
    }
    return sum;
}

/// a += factor * b
void add(const Rgb4& factor, std::span<const Rgb4> b, std::span<Rgb4> a) noexcept {
    for (size_t i = 0; i < a.size(); ++i) {
        a[i] += factor * b[i];
    }
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

/// light - exchange * light
Column effect_of(const Transport& t, const Column& nothing, const Column& light) {
    Column effect(light.size());
    step_bounce(t, nothing, light, effect);
    for (size_t r = 0; r < light.size(); ++r) {
        effect[r] = light[r] - effect[r];
    }
    return effect;
}

} // namespace

int sum_bounces(const Transport& t, std::span<const Rgb4> first, const std::atomic<bool>& stop,
                Column& arriving) {
    const Column nothing(first.size(), Rgb4{});
    arriving.assign(first.begin(), first.end());
    Column residual(first.size());
    step_bounce(t, nothing, arriving, residual); // what the second bounce adds
    std::deque<Direction> known;
    int steps = 1;
    for (; steps < kMaxSteps && !stop; ++steps) {
        const glm::dvec3 left = dot(residual, residual), all = dot(arriving, arriving);
        if (glm::all(glm::lessThanEqual(left, kTolerance * kTolerance * all))) {
            break;
        }
        Direction next{residual, effect_of(t, nothing, residual), {}};
        for (const Direction& d : known) {
            const Rgb4 share = -ratio(dot(next.effect, d.effect), d.square);
            add(share, d.light, next.light);
            add(share, d.effect, next.effect);
        }
        next.square = dot(next.effect, next.effect);
        const Rgb4 length = ratio(dot(residual, next.effect), next.square);
        add(length, next.light, arriving);
        add(-length, next.effect, residual);
        known.push_front(std::move(next));
        known.resize(std::min(known.size(), kKept));
    }
    return steps;
}

} // namespace cl::radiosity
