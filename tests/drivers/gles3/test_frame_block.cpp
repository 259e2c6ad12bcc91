#include "drivers/gles3/frame_block.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

using namespace cl;
using namespace cl::gles3;

namespace {

/// Three suns, of which the last two have shadows.
struct ThreeSuns {
    LightDesc sun;
    std::array<LightItem, 3> lights;
    std::array<PlacedDirectionalShadow, 3> shadows;
    Frame frame;

    ThreeSuns() {
        sun.type = LightType::Directional;
        for (LightItem& light : lights) {
            light.desc = &sun;
        }
        for (size_t i = 1; i < 3; ++i) {
            shadows[i].shadow.count = 1;
            shadows[i].shadow.splits[0].high_m = glm::vec3(1.0f);
            shadows[i].area.size = glm::vec2(1.0f);
        }
        frame.size = {16, 16};
        frame.lights = lights;
        frame.directional_count = 3;
    }
    shaders::FrameBlock block(GIMode mode) {
        frame.gi_mode = mode;
        return make_frame_block(frame, shadows);
    }
};

} // namespace

TEST_SUITE("drivers/gles3/frame_block") {
    TEST_CASE("each directional light counts emission once more in cones mode, and in no other") {
        ThreeSuns suns;
        CHECK(suns.block(GIMode::Cones).frame_light_passes == 3.0f);
        CHECK(suns.block(GIMode::Off).frame_light_passes == 1.0f);
        CHECK(suns.block(GIMode::Auto).frame_light_passes == 1.0f);
        suns.frame.directional_count = 0;
        CHECK(make_frame_block(suns.frame, {}).frame_light_passes == 1.0f);
    }

    TEST_CASE("in cones mode only the first shadow of the directional lights is drawn") {
        ThreeSuns suns;
        const auto splits = [](const shaders::FrameBlock& block) {
            std::vector<int> count;
            for (size_t i = 0; i < 3; ++i) {
                count.push_back(block.frame_directional[i].splits);
            }
            return count;
        };
        CHECK(splits(suns.block(GIMode::Cones)) == std::vector<int>{0, 1, 0});
        CHECK(splits(suns.block(GIMode::Auto)) == std::vector<int>{0, 1, 1});
        CHECK(splits(suns.block(GIMode::Off)) == std::vector<int>{0, 1, 1});
    }
}
