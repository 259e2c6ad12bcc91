#pragma once

#include "servers/cones/level.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

namespace cl::cones {

/// A GI probe's radiance volume as cones on the CPU read it: levels of RGBA8. Pages that no texel was written
/// to take no memory.
class Volume {
public:
    /// All texels are 0. @param size  of level 0 [texels], each at least 1; `levels` are at least 1 and at
    /// most those down to one texel.
    Volume(const glm::ivec3& size, int levels);

    /// Replaces a box of one level, which must lie inside. @param rgba8  x fastest, then y, then z
    void upload(int level, const glm::ivec3& offset, const glm::ivec3& size, std::span<const uint8_t> rgba8);

    [[nodiscard]] int level_count() const noexcept { return int(levels_.size()); }
    [[nodiscard]] const Level& level(int index) const noexcept { return levels_[size_t(index)]; }
    [[nodiscard]] glm::ivec3 size(int level) const noexcept;
    [[nodiscard]] std::span<const uint8_t> rgba8(int level) const noexcept;

private:
    struct Free {
        void operator()(uint8_t* memory) const noexcept { std::free(memory); }
    };
    std::vector<std::unique_ptr<uint8_t, Free>> bytes_;
    std::vector<Level> levels_;
};

} // namespace cl::cones
