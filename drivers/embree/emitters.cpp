#include "drivers/embree/emitters.h"

#include "drivers/embree/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::embree {

namespace {

constexpr int kProbesPerEdge = 4;

float luminance(const glm::vec3& rgb) noexcept {
    return std::max(0.0f, glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f)));
}

/// Mean and greatest luminance of a lattice of points: what a texture does between them is guessed.
struct Brightness {
    float mean = 0.0f, most = 0.0f;
};
Brightness brightness_of(const TracedItem& item, uint32_t triangle) noexcept {
    Brightness b;
    int count = 0;
    for (int i = 0; i < kProbesPerEdge; ++i) {
        for (int j = 0; i + j < kProbesPerEdge; ++j, ++count) {
            const glm::vec2 at = (glm::vec2(i, j) + 1.0f / 3.0f) / static_cast<float>(kProbesPerEdge);
            const float l = luminance(item.material.emission(item.coordinates(triangle, at)));
            b.mean += l;
            b.most = std::max(b.most, l);
        }
    }
    b.mean /= static_cast<float>(count);
    return b;
}

float area_of(const TracedItem& item, uint32_t triangle) noexcept {
    const float area = 0.5f * glm::length(item.front_normal(triangle));
    return std::isfinite(area) ? area : 0.0f;
}

/// Luminance that every triangle of a glowing item is held to have at least, so that a spot of light which
/// the lattice misses is found by chance: a share of the item's brightest.
constexpr float kLeastShare = 0.05f;

std::vector<float> powers_of(const TracedItem& item) {
    const auto count = static_cast<uint32_t>(item.surface->triangles.size());
    std::vector<float> powers(count);
    float most = 0.0f;
    for (uint32_t t = 0; t < count; ++t) {
        const Brightness b = brightness_of(item, t);
        powers[t] = b.mean;
        most = std::max(most, b.most);
    }
    const float sides = item.material.desc().cull_mode == CullMode::Disabled ? 2.0f : 1.0f;
    for (uint32_t t = 0; t < count; ++t) {
        powers[t] = std::max(powers[t], kLeastShare * most) * area_of(item, t) * sides;
    }
    return powers;
}

} // namespace

Emitters::Emitters(std::span<const TracedItem> items) : items_(items), pdf_of_(items.size()) {
    double total = 0.0;
    std::vector<double> sums;
    for (uint32_t i = 0; i < items.size(); ++i) {
        if (!items[i].material.emits() || items[i].casting == ShadowCasting::ShadowsOnly) {
            continue;
        }
        const std::vector<float> powers = powers_of(items[i]);
        pdf_of_[i].resize(powers.size());
        for (uint32_t t = 0; t < powers.size(); ++t) {
            if (powers[t] > 0.0f) {
                total += powers[t];
                sums.push_back(total);
                entries_.push_back({i, t, powers[t] / area_of(items[i], t)});
            }
        }
    }
    upper_.reserve(sums.size());
    for (size_t e = 0; e < entries_.size(); ++e) {
        upper_.push_back(static_cast<float>(sums[e] / total));
        entries_[e].pdf_area = static_cast<float>(entries_[e].pdf_area / total);
        pdf_of_[entries_[e].item][entries_[e].triangle] = entries_[e].pdf_area;
    }
}

std::optional<Emitters::Point> Emitters::sample(float u_triangle, const glm::vec2& u) const noexcept {
    if (empty()) {
        return std::nullopt;
    }
    const auto found = std::upper_bound(upper_.begin(), upper_.end(), u_triangle);
    const auto index = std::min(static_cast<size_t>(found - upper_.begin()), entries_.size() - 1);
    const Entry& entry = entries_[index];
    const TracedItem& item = items_[entry.item];
    const TracedItem::Corners corners = item.corners(entry.triangle);
    const glm::vec2 barycentric = uniform_triangle(u);
    Point point;
    point.position = interpolate(corners.a, corners.b, corners.c, barycentric);
    point.front_normal = glm::normalize(item.front_normal(entry.triangle));
    point.item = entry.item;
    point.triangle = entry.triangle;
    point.coordinates = item.coordinates(entry.triangle, barycentric);
    point.pdf_area = entry.pdf_area;
    return point;
}

float Emitters::pdf_area(uint32_t item, uint32_t triangle) const noexcept {
    return pdf_of_[item].empty() ? 0.0f : pdf_of_[item][triangle];
}

} // namespace cl::embree
