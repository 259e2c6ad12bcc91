#include "drivers/dummy/dummy_rasterizer.h"

#include <doctest/doctest.h>

#include <vector>

using namespace cl;
using dummy::CallKind;
using dummy::DummyRasterizer;

TEST_SUITE("drivers/dummy/dummy_rasterizer") {
    TEST_CASE("a box of texels lands where it was sent, x fastest, and nowhere else") {
        DummyRasterizer dummy;
        const RID volume = dummy.gi_volume_create({{4, 4, 2}, 2}).value();
        std::vector<uint8_t> box(2 * 1 * 2 * 4);
        for (size_t i = 0; i < box.size(); ++i) {
            box[i] = static_cast<uint8_t>(i + 1);
        }
        REQUIRE(dummy.gi_volume_upload(volume, 0, {1, 2, 0}, {2, 1, 2}, box));
        const std::span<const uint8_t> texels = dummy.volume_texels(volume, 0);
        REQUIRE(texels.size() == 4 * 4 * 2 * 4);
        size_t written = 0;
        for (size_t i = 0; i < texels.size(); ++i) {
            written += texels[i] != 0 ? 1 : 0;
        }
        CHECK(written == box.size());
        const auto texel = [&texels](size_t x, size_t y, size_t z) {
            return texels[4 * ((z * 4 + y) * 4 + x)];
        };
        CHECK(texel(1, 2, 0) == 1);
        CHECK(texel(2, 2, 0) == 5);
        CHECK(texel(1, 2, 1) == 9);
        CHECK(texel(2, 2, 1) == 13);
    }

    TEST_CASE("a new volume is black in every mip") {
        DummyRasterizer dummy;
        const RID volume = dummy.gi_volume_create({{8, 2, 8}, 2}).value();
        CHECK(dummy.volume_texels(volume, 0).size() == 8 * 2 * 8 * 4);
        CHECK(dummy.volume_texels(volume, 1).size() == 4 * 1 * 4 * 4);
        CHECK(dummy.volume_texels(volume, 2).empty());
        for (uint8_t byte : dummy.volume_texels(volume, 0)) {
            REQUIRE(byte == 0);
        }
    }

    TEST_CASE("calls are recorded in order with what was made and a hash of its bytes") {
        DummyRasterizer dummy;
        Image image;
        image.size = {2, 1};
        image.data.assign(8, 1);
        const RID a = dummy.texture_create(image, {}, TextureColorSpace::Srgb).value();
        image.data[3] = 2;
        REQUIRE(dummy.texture_create(image, {}, TextureColorSpace::Linear));
        REQUIRE(dummy.free(a));
        REQUIRE(dummy.calls().size() == 3);
        CHECK(dummy.calls()[0].kind == CallKind::TextureCreate);
        CHECK(dummy.calls()[0].rid == a);
        CHECK(dummy.calls()[0].size == glm::ivec3(2, 1, 1));
        CHECK(dummy.calls()[0].bytes_hash != dummy.calls()[1].bytes_hash);
        CHECK(dummy.calls()[2].kind == CallKind::Free);
        CHECK(dummy.live() == dummy::LiveCounts{.textures = 1});
        CHECK(!dummy.free(a));
    }

    TEST_CASE("a failure that was asked for comes once, with its error, and records nothing") {
        DummyRasterizer dummy;
        dummy.fail_next(CallKind::TargetCreate, {ErrorCode::OutOfMemory, "full", {}});
        CHECK(dummy.gi_volume_create({{2, 2, 2}, 1})); // another kind
        CHECK(dummy.target_create({1, 1}).error().message == "full");
        CHECK(dummy.count(CallKind::TargetCreate) == 0);
        CHECK(dummy.target_create({1, 1}));
    }

    TEST_CASE("a target reads as the clear colour of the last frame, encoded or linear") {
        DummyRasterizer dummy;
        const RID target = dummy.target_create({2, 3}).value();
        Frame frame;
        frame.size = {2, 3};
        frame.clear_color = {1.0f, 0.5f, 0.0f, 1.0f};
        REQUIRE(dummy.draw(target, frame));
        const Image encoded = dummy.target_read(target, TargetFormat::Srgb8).value();
        REQUIRE(encoded.data.size() == 2 * 3 * 4);
        CHECK(encoded.data[1] == 128);
        const Image linear = dummy.target_read(target, TargetFormat::LinearFloat).value();
        REQUIRE(linear.floats().size() == 2 * 3 * 3);
        CHECK(linear.floats()[0] == doctest::Approx(1.0));
        CHECK(linear.floats()[1] == doctest::Approx(0.214).epsilon(0.01));
    }
}
