#include "tests/servers/gi/relight_scene.h"

#include "tests/servers/gi/hand_made_octree.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace cl::tests {

glm::mat3 facing(const glm::vec3& travel) {
    const glm::vec3 z = -glm::normalize(travel);
    const glm::vec3 x =
        glm::normalize(glm::cross(std::abs(z.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), z));
    return {x, glm::cross(z, x), z};
}

gi::CachedLight omni(const glm::vec3& position, float range) {
    gi::CachedLight light;
    light.cells_from_light.origin = position;
    light.range_m = range;
    return light;
}
gi::CachedLight sun(const glm::vec3& travel) {
    gi::CachedLight light;
    light.type = LightType::Directional;
    light.cells_from_light.basis = facing(travel);
    return light;
}
gi::CachedLight spot(const glm::vec3& position, const glm::vec3& travel, float angle_deg, float range) {
    gi::CachedLight light = omni(position, range);
    light.type = LightType::Spot;
    light.cells_from_light.basis = facing(travel);
    light.spot_angle_deg = angle_deg;
    return light;
}

gi::Octree busy_octree() {
    std::vector<HandMadeLeaf> leaves;
    for (int z = 0; z < 64; ++z) {
        for (int x = 0; x < 64; ++x) {
            leaves.push_back({{x, 2, z}, kPlusY, 0xC0A080, (x + z) % 17 == 0 ? 0xFF8000A0u : 0u});
            if (x > 2 && z < 40) {
                leaves.push_back({{40, x, z}, kMinusX, 0x4080FF});
            }
        }
    }
    for (int z = 20; z < 40; ++z) {
        for (int y = 20; y < 40; ++y) {
            for (int x = 10; x < 30; ++x) {
                const glm::vec3 n = (glm::vec3(x, y, z) - glm::vec3(19.5f, 29.5f, 29.5f)) / 9.5f;
                if (std::abs(glm::length(n) - 0.95f) < 0.05f) {
                    const auto byte = [](float v) { return uint32_t((v * 0.5f + 0.5f) * 255.0f); };
                    leaves.push_back({{x, y, z}, byte(n.x) << 16 | byte(n.y) << 8 | byte(n.z), 0x808080});
                }
            }
        }
    }
    return tests::make_octree(leaves);
}

std::vector<gi::CachedLight> busy_lights() {
    std::vector<gi::CachedLight> lights = {omni({20.3f, 50.1f, 10.7f}, 80.0f), sun({0.3f, -1.0f, 0.2f}),
                                           spot({5.5f, 40.2f, 5.1f}, {0.5f, -1.0f, 0.6f}, 40.0f, 90.0f),
                                           omni({200.0f, 90.0f, -30.0f}, 400.0f), sun({-1.0f, -0.01f, 0.0f})};
    lights[0].color = {1.0f, 0.7f, 0.31f};
    lights[1].energy = 3.7f;
    lights[2].attenuation = 1.7f;
    lights[2].spot_attenuation = 0.6f;
    lights[3].energy = 20.0f;
    return lights;
}

} // namespace cl::tests
