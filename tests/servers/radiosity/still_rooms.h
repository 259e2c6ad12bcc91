#pragma once

#include "servers/radiosity/field_map.h"
#include "servers/radiosity/solver.h"
#include "servers/radiosity/transport.h"

#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace cl::tests {

/// Builds still scenes from boxes and balls, all placed by one transform. Faces look out.
class RoomBuilder {
public:
    explicit RoomBuilder(const Transform& world_from_room = {}) : world_from_room_(world_from_room) {}

    uint32_t material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0.0f));
    void box(uint32_t material, const glm::vec3& center, const glm::vec3& size);
    /// Six slabs about the origin with space of `inner_m` an edge between them; the faces within them touch.
    void shell(uint32_t material, float inner_m, float thick_m);
    void ball(uint32_t material, const glm::vec3& center, float radius_m);
    [[nodiscard]] std::shared_ptr<const radiosity::StillScene> take();

private:
    void triangle(uint32_t material, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

    Transform world_from_room_;
    radiosity::StillScene scene_;
};

/// A transport with the map that pixels use.
struct LitRoom {
    std::shared_ptr<const radiosity::Transport> transport;
    radiosity::FieldMap map;

    LitRoom(std::shared_ptr<const radiosity::StillScene> scene, std::span<const radiosity::ProbeBox> probes);
    [[nodiscard]] radiosity::Solution solve(const radiosity::Lighting& lighting) const;
};

/// A probe about the origin whose cells have a given edge: as long as 128 of them, and no higher than needed.
[[nodiscard]] radiosity::ProbeBox probe_with_cells(float cell_m, float height_m,
                                                   const Transform& world_from_probe = {});

/// Black sky, no source, `probes` probes.
[[nodiscard]] radiosity::Lighting darkness(size_t probes = 1);
[[nodiscard]] radiosity::Source omni_source(const glm::vec3& position, float range_m);

/// What a pixel at a point of a surface shows: the CPU twin of surface_light() in shaders/lib/gi_field.glsl.
/// `found` is false where the field has no patch for it.
struct PixelLight {
    bool found = false;
    glm::vec3 light{0.0f};
};
struct SurfacePoint {
    glm::vec3 position, normal; ///< [m], unit length
};
[[nodiscard]] std::vector<PixelLight> pixel_lights(const LitRoom& room, size_t probe,
                                                   const radiosity::Solution& solution,
                                                   std::span<const SurfacePoint> points);
/// Points on the inner faces of a RoomBuilder::shell(), per_edge^2 a face.
[[nodiscard]] std::vector<SurfacePoint> points_inside(const Transform& world_from_room, float inner_m,
                                                      int per_edge);

[[nodiscard]] float luminance(const glm::vec3& radiance);
/// Light that patches receive, straight from sources and by way of others.
[[nodiscard]] std::vector<glm::vec3> received(const radiosity::Transport& transport,
                                              const radiosity::Lighting& lighting,
                                              const radiosity::Solution& solution);
/// Mean luminance over patches by area, of those that `counts` takes.
[[nodiscard]] float mean_over(const radiosity::Patches& patches, std::span<const glm::vec3> values,
                              const std::function<bool(uint32_t)>& counts);

} // namespace cl::tests
