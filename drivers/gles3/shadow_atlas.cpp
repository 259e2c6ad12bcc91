#include "drivers/gles3/shadow_atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace cl::gles3 {

namespace {

constexpr int kQuadrantRows[4] = {1, 2, 4, 8}; ///< slots along a quadrant's edge
constexpr int kLeastSlot = 8;                  ///< [texels]

} // namespace

ShadowAtlas::ShadowAtlas(int size) : size_(size) {
    const int quadrant = size / 2;
    for (int q = 0; q < 4; ++q) {
        const int rows = kQuadrantRows[q];
        const int edge = quadrant / rows;
        for (int i = 0; i < rows * rows && edge >= kLeastSlot; ++i) {
            const glm::ivec2 corner =
                glm::ivec2(q & 1, q >> 1) * quadrant + glm::ivec2(i % rows, i / rows) * edge;
            slots_.push_back({{corner, {edge, edge}}, RID{}});
        }
    }
}

ShadowAtlas::Slot* ShadowAtlas::find_kept(const Request& request, const std::vector<bool>& taken) {
    for (size_t i = 0; i < slots_.size(); ++i) {
        if (slots_[i].owner == request.light && !taken[i]) {
            return slots_[i].rect.size.x == request.wanted ? &slots_[i] : nullptr;
        }
    }
    return nullptr;
}

ShadowAtlas::Slot* ShadowAtlas::find_free(int wanted, const std::vector<bool>& taken) {
    Slot* best = nullptr;
    for (size_t i = 0; i < slots_.size(); ++i) {
        const bool is_enough = slots_[i].rect.size.x >= wanted;
        if (!taken[i] && (!best || (is_enough && slots_[i].rect.size.x < best->rect.size.x))) {
            best = &slots_[i];
        }
    }
    return best;
}

std::vector<std::optional<gl::Rect>> ShadowAtlas::assign(std::span<const Request> requests) {
    std::vector<size_t> order(requests.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto rank = [&](size_t i) {
        return std::tuple(requests[i].wanted, std::ilogb(requests[i].reach_m), requests[i].light);
    };
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return rank(a) > rank(b); });
    std::vector<std::optional<gl::Rect>> out(requests.size());
    std::vector<bool> taken(slots_.size(), false);
    const auto give = [&](size_t request, Slot* slot) {
        if (slot) {
            slot->owner = requests[request].light;
            taken[static_cast<size_t>(slot - slots_.data())] = true;
            out[request] = slot->rect;
        }
    };
    for (const size_t i : order) {
        give(i, find_kept(requests[i], taken));
    }
    for (const size_t i : order) {
        if (!out[i]) {
            give(i, find_free(requests[i].wanted, taken));
        }
    }
    for (size_t i = 0; i < slots_.size(); ++i) {
        slots_[i].owner = taken[i] ? slots_[i].owner : RID{};
    }
    return out;
}

int wanted_slot_size(float coverage, int atlas_size) noexcept {
    const int largest = std::max(atlas_size / 2, kLeastSlot);
    int edge = std::max(largest / 8, kLeastSlot);
    while (edge < largest && static_cast<float>(edge) < coverage * static_cast<float>(largest)) {
        edge *= 2;
    }
    return edge;
}

} // namespace cl::gles3
