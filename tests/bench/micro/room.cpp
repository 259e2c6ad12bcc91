#include "tests/bench/micro/room.h"

#include "core/assert.h"

#include <atomic>

namespace cl::bench {

Room::Room() {
    const auto box = [this](const glm::vec3& center_m, const glm::vec3& size_m, const glm::vec3& albedo) {
        add(scene::make_shape(scene::CubeShape{.size = size_m}), center_m, albedo);
    };
    const glm::vec3 white(0.85f);
    box({0.0f, -2.1f, 0.0f}, {4.4f, 0.2f, 4.4f}, white);
    box({0.0f, 2.1f, 0.0f}, {4.4f, 0.2f, 4.4f}, white);
    box({0.0f, 0.0f, -2.1f}, {4.4f, 4.0f, 0.2f}, white);
    box({0.0f, 0.0f, 2.1f}, {4.4f, 4.0f, 0.2f}, white);
    box({-2.1f, 0.0f, 0.0f}, {0.2f, 4.0f, 4.0f}, {0.8f, 0.15f, 0.15f});
    box({2.1f, 0.0f, 0.0f}, {0.2f, 4.0f, 4.0f}, {0.2f, 0.7f, 0.2f});
    box({0.7f, -1.4f, -0.4f}, {1.2f, 1.2f, 1.2f}, white);
    add(scene::make_shape(scene::SphereShape{.radius = 0.6f, .height = 1.2f}), {-0.8f, -1.4f, 0.3f}, white);
}

void Room::add(const SurfaceArrays& arrays, const glm::vec3& center_m, const glm::vec3& albedo) {
    arrays_.push_back(std::make_unique<SurfaceArrays>(arrays));
    materials_.push_back(std::make_unique<gi::MaterialCapture>());
    materials_.back()->albedo = {albedo};
    materials_.back()->emission = {glm::vec3(0.0f)};
    const SurfaceArrays& a = *arrays_.back();
    Transform room_from_mesh;
    room_from_mesh.origin = center_m;
    surfaces_.push_back({room_from_mesh, a.positions, a.normals, a.uvs, a.indices, materials_.back().get()});
}

gi::Octree Room::octree(int cells) const {
    const auto baked = gi::voxelize(*gi::compute_grid(glm::vec3(kHalf_m), cells), surfaces_);
    CL_ASSERT(baked.has_value(), "the room is baked");
    return *gi::decode_octree(baked->dynamic_data);
}

std::shared_ptr<const radiosity::StillScene> Room::still_scene() const {
    auto still = std::make_shared<radiosity::StillScene>();
    for (const gi::PlotSurface& s : surfaces_) {
        const uint32_t first = uint32_t(still->positions.size());
        for (const glm::vec3& p : s.positions) {
            still->positions.push_back(s.local_from_mesh.xform(p));
            still->uvs.emplace_back(0.0f);
        }
        for (size_t i = 0; i + 2 < s.indices.size(); i += 3) { // meshes are clockwise, transport is not
            still->triangles.emplace_back(first + s.indices[i], first + s.indices[i + 2],
                                          first + s.indices[i + 1]);
            still->surface_of.push_back(uint32_t(still->surfaces.size()));
        }
        still->surfaces.emplace_back();
        still->surfaces.back().albedo = s.material->albedo[0];
    }
    return still;
}

const radiosity::Transport& transport() {
    static const std::shared_ptr<const radiosity::Transport> made = [] {
        const std::atomic<bool> stop{false};
        const radiosity::ProbeBox box{{}, {glm::vec3(-Room::kHalf_m), glm::vec3(2.0f * Room::kHalf_m)}};
        auto result = radiosity::make_transport(Room().still_scene(), std::span(&box, 1), stop);
        CL_ASSERT(result.has_value(), "the room's light transport is made");
        return *result;
    }();
    return *made;
}

} // namespace cl::bench
