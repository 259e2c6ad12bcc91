#include "servers/gi/leaf_plots.h"

#include "core/threads.h"

#include <array>
#include <utility>

namespace cl::gi {

namespace {

using BrickCounts = std::array<size_t, kBakeBricks>;

/// Turns counts a part and brick into where each part's plots of a brick go. @return the first of each brick,
/// and the end.
std::vector<size_t> add_up(std::span<BrickCounts> counts) {
    std::vector<size_t> begin;
    begin.reserve(kBakeBricks + 1);
    size_t next = 0;
    for (size_t brick = 0; brick < kBakeBricks; ++brick) {
        begin.push_back(next);
        for (BrickCounts& part : counts) {
            next += std::exchange(part[brick], next);
        }
    }
    begin.push_back(next);
    return begin;
}

} // namespace

LeafPlots::LeafPlots(std::span<const std::span<const LeafPlot>> parts, int levels)
    : leaf_bits_(3 * (levels - 1 - kBakeBrickLevel)) {
    std::vector<BrickCounts> counts(parts.size());
    parallel_for_each(parts.size(), [&](size_t i) {
        for (const LeafPlot& plot : parts[i]) {
            ++counts[i][plot.leaf >> leaf_bits_];
        }
    });
    begin_ = add_up(counts);
    plots_.resize(begin_.back());
    parallel_for_each(parts.size(), [&](size_t i) {
        for (const LeafPlot& plot : parts[i]) {
            plots_[counts[i][plot.leaf >> leaf_bits_]++] = plot;
        }
    });
}

std::vector<LeafPlot> LeafPlots::sorted_by_leaf(uint32_t number) const {
    // From the lowest digit to the highest, each time stable: triangles stay in order.
    constexpr int kDigitBits = 6;
    constexpr size_t kDigits = size_t(1) << kDigitBits;
    const std::span<const LeafPlot> plots = of_brick(number);
    std::vector<LeafPlot> sorted(plots.begin(), plots.end());
    std::vector<LeafPlot> from(plots.size());
    for (int shift = 0; shift < leaf_bits_; shift += kDigitBits) {
        sorted.swap(from);
        const auto digit = [shift](const LeafPlot& plot) { return (plot.leaf >> shift) % kDigits; };
        std::array<size_t, kDigits> next{};
        for (const LeafPlot& plot : from) {
            ++next[digit(plot)];
        }
        size_t sum = 0;
        for (size_t& n : next) {
            sum += std::exchange(n, sum);
        }
        for (const LeafPlot& plot : from) {
            sorted[next[digit(plot)]++] = plot;
        }
    }
    return sorted;
}

} // namespace cl::gi
