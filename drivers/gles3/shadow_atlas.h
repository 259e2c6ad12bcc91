#pragma once

#include "drivers/gles3/gl/draw_state.h"

#include "core/rid.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cl::gles3 {

/// Which part of the shadow atlas each omni and spot light draws to. The atlas is cut in four quadrants,
/// these in 1, 4, 16 and 64 slots (spec scene-classes section 9). Pure bookkeeping: no GL.
class ShadowAtlas {
public:
    /// @param size  edge [texels]; below 16 there are no slots
    explicit ShadowAtlas(int size);
    [[nodiscard]] int size() const noexcept { return size_; }

    struct Request {
        RID light;
        int wanted = 0;       ///< edge of the slot it would like [texels]
        float reach_m = 0.0f; ///< longest edge of the box that it lights
    };
    /// Gives every light a slot: one it has already if that is of the size it wants, else the smallest free
    /// one that is large enough, else the largest free one. Lights that want most choose first, among them
    /// those of the largest boxes by powers of two, among these the last one made: fitted to what Godot,
    /// which asks a spatial index, is seen to do.
    /// @return by request; std::nullopt where no slot was left (the light then casts no shadow).
    std::vector<std::optional<gl::Rect>> assign(std::span<const Request> requests);

private:
    struct Slot {
        gl::Rect rect;
        RID owner;
    };
    [[nodiscard]] Slot* find_kept(const Request& request, const std::vector<bool>& taken);
    [[nodiscard]] Slot* find_free(int wanted, const std::vector<bool>& taken);
    int size_;
    std::vector<Slot> slots_; ///< largest first
};

/// The slot size that a light of this coverage deserves (1: the largest). @see light_coverage
[[nodiscard]] int wanted_slot_size(float coverage, int atlas_size) noexcept;

} // namespace cl::gles3
