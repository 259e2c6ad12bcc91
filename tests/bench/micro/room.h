#pragma once

#include "scene/resources/primitive_shapes.h"

#include "servers/gi/voxelizer.h"
#include "servers/radiosity/transport.h"

#include <memory>
#include <vector>

namespace cl::bench {

/// A room of 4 x 4 x 4 m, red on the left and green on the right, with a box and a ball in it: what every
/// benchmark here works on.
class Room {
public:
    Room();
    [[nodiscard]] const std::vector<gi::PlotSurface>& surfaces() const noexcept { return surfaces_; }
    /// Of the room's box. @param cells  64, 128, 256 or 512
    [[nodiscard]] gi::Octree octree(int cells) const;
    [[nodiscard]] std::shared_ptr<const radiosity::StillScene> still_scene() const;

    static constexpr size_t kBox = 6;      ///< number of the box among the surfaces
    static constexpr float kHalf_m = 2.3f; ///< half the edge of the probe's box around the origin

private:
    void add(const SurfaceArrays& arrays, const glm::vec3& center_m, const glm::vec3& albedo);

    std::vector<std::unique_ptr<SurfaceArrays>> arrays_;
    std::vector<std::unique_ptr<gi::MaterialCapture>> materials_;
    std::vector<gi::PlotSurface> surfaces_;
};

/// Light transport of the room, made once.
[[nodiscard]] const radiosity::Transport& transport();

} // namespace cl::bench
