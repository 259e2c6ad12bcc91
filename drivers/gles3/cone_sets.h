#pragma once

#include "drivers/gles3/gi_volume_storage.h"
#include "drivers/gles3/shaders.h"

#include "servers/cones/gather.h"
#include "servers/rasterizer.h"

#include <array>
#include <map>
#include <vector>

namespace cl::gles3 {

/// The combinations of GI probes, and of their biases, that a frame's surfaces are lit by: those whose light
/// is gathered on the CPU.
class ConeSets {
public:
    void clear();
    /// 1 + the number of a surface's set; 0 if no probe lights it.
    [[nodiscard]] int number_of(const DrawItem& item);
    /// What the kernel reads, in the order of the numbers. Volumes are borrowed from the storage.
    [[nodiscard]] std::vector<cones::ConeSet> resolve(const Frame& frame, GIVolumeStorage& volumes) const;

private:
    struct Key {
        std::array<int16_t, 2> probes{-1, -1};
        bool biased = false; ///< receives_baked_light of the instance
        auto operator<=>(const Key&) const = default;
    };
    std::map<Key, int> numbers_;
    std::vector<Key> keys_;
};

} // namespace cl::gles3
