#include "tests/drivers/gl_test.h"

#include "drivers/gles3/gl/pass.h"
#include "drivers/gles3/target_storage.h"

#include <doctest/doctest.h>

using namespace cl;
using namespace cl::gles3;
using tests::GLTest;
using tests::on_each_gl;

namespace {

void fill(const gl::Framebuffer& target, const gl::Rect& rect, glm::vec4 value) {
    gl::PassDesc desc{.label = "fill", .target = &target, .viewport = rect};
    desc.colors[0] = gl::Load::Clear;
    desc.clear_colors[0] = value;
    const gl::Pass pass(desc);
}

} // namespace

TEST_SUITE("drivers/gles3/target_storage") {
    TEST_CASE("[gl] pictures are read with their top row first, radiance unclamped and signed") {
        on_each_gl([](GLTest&) {
            TargetStorage targets;
            const Expected<RID> rid = targets.create({3, 2});
            REQUIRE(rid);
            RenderTarget& target = *targets.get(*rid);
            for (const gl::Framebuffer* f : {&target.scene, &target.output}) {
                fill(*f, {{0, 0}, {3, 1}}, glm::vec4(0.0f, -2.0f, 0.0f, 1.0f)); // the bottom row of GL
                fill(*f, {{0, 1}, {3, 1}}, glm::vec4(40.0f, 0.2f, 1.0f, 1.0f));
            }
            const Expected<Image> radiance = targets.read(*rid, TargetFormat::LinearFloat);
            REQUIRE(radiance);
            CHECK(radiance->size == glm::ivec2(3, 2));
            CHECK(radiance->format == PixelFormat::RGBF);
            REQUIRE(radiance->floats().size() == 18);
            CHECK(radiance->floats()[0] == 40.0f);
            CHECK(radiance->floats()[9] == 0.0f);
            CHECK(radiance->floats()[10] == -2.0f);
            const Expected<Image> picture = targets.read(*rid, TargetFormat::Srgb8);
            REQUIRE(picture);
            CHECK(picture->format == PixelFormat::RGBA8);
            REQUIRE(picture->data.size() == 24);
            CHECK(picture->data[0] == 255);
            CHECK(picture->data[1] == 51);
            CHECK(picture->data[12] == 0);
        });
    }

    TEST_CASE("[gl] the scene and its depth prepass share one depth buffer") {
        on_each_gl([](GLTest&) {
            TargetStorage targets;
            const Expected<RID> rid = targets.create({2, 2});
            REQUIRE(rid);
            const RenderTarget& target = *targets.get(*rid);
            CHECK(target.scene.has_depth());
            CHECK(target.depth_only.has_depth());
            CHECK(target.depth_only.color_count() == 0);
            CHECK(target.depth_only.size() == target.scene.size());
        });
    }

    TEST_CASE("[gl] sizes that cannot be and handles that are stale are refused") {
        on_each_gl([](GLTest&) {
            TargetStorage targets;
            CHECK(targets.create({0, 4}).error().code == ErrorCode::Unsupported);
            CHECK(targets.create({4, 1 << 24}).error().code == ErrorCode::Unsupported);
            const Expected<RID> rid = targets.create({1, 1});
            REQUIRE(rid);
            CHECK(targets.free(*rid));
            CHECK_FALSE(targets.free(*rid));
            CHECK(targets.get(*rid) == nullptr);
            CHECK(targets.read(*rid, TargetFormat::Srgb8).error().message ==
                  "expected a live render target, found a stale or foreign RID");
            CHECK(targets.read({}, TargetFormat::Srgb8).error().code ==
                  ErrorCode::InvalidArgument); // no window
        });
    }
}
