#include "servers/gi/voxelizer.h"

#include <doctest/doctest.h>

namespace {

using namespace cl;

Image image_of(glm::ivec2 size, const std::vector<uint8_t>& rgba8) {
    Image image;
    image.size = size;
    image.format = PixelFormat::RGBA8;
    image.data = rgba8;
    return image;
}

Image plain_image(glm::ivec2 size, uint8_t r, uint8_t g, uint8_t b) {
    std::vector<uint8_t> bytes;
    for (int i = 0; i < size.x * size.y; ++i) {
        bytes.insert(bytes.end(), {r, g, b, 255});
    }
    return image_of(size, bytes);
}

bool is_plain(const gi::CapturedMap& map, const glm::vec3& color) {
    return map.size() == 1 && map[0] == color && map[77] == color;
}

TEST_SUITE("servers/gi/material_capture") {
    TEST_CASE("a material without textures is one texel of its numbers as they are") {
        gi::CaptureInput input;
        input.albedo_color = {0.25f, 0.5f, 1.0f};
        input.emission_color = {1.0f, 0.5f, 0.0f};
        input.emission_energy = 3.0f;
        const gi::MaterialCapture add = gi::capture_material(input);
        CHECK(is_plain(add.albedo, {0.25f, 0.5f, 1.0f}));
        CHECK(is_plain(add.emission, {3.0f, 1.5f, 0.0f}));
        input.emission_multiply = true;
        CHECK(is_plain(gi::capture_material(input).emission, glm::vec3(0.0f)));
    }

    TEST_CASE("textures scale the albedo, and add to or multiply the emission") {
        const Image texture = plain_image({128, 128}, 51, 102, 255); // 0.2, 0.4, 1
        gi::CaptureInput input;
        input.albedo_color = {1.0f, 0.5f, 0.5f};
        input.albedo_texture = &texture;
        input.emission_color = {0.5f, 0.0f, 1.0f};
        input.emission_energy = 2.0f;
        input.emission_texture = &texture;
        const gi::MaterialCapture add = gi::capture_material(input);
        REQUIRE(add.albedo.size() == 128 * 128);
        CHECK(add.albedo[77].g == doctest::Approx(0.2f));
        CHECK(add.emission[77].r == doctest::Approx(0.2f * 2.0f + 1.0f));
        CHECK(add.emission[77].b == doctest::Approx(1.0f * 2.0f + 2.0f));
        input.emission_multiply = true;
        const gi::MaterialCapture multiply = gi::capture_material(input);
        CHECK(multiply.emission[77].r == doctest::Approx(0.2f));
        CHECK(multiply.emission[77].g == 0.0f);
        CHECK(multiply.emission[77].b == doctest::Approx(2.0f));
    }

    TEST_CASE("a texture that has no pixels counts as black") {
        const Image none;
        gi::CaptureInput input;
        input.albedo_texture = &none;
        input.emission_texture = &none;
        input.emission_color = glm::vec3(0.5f);
        CHECK(is_plain(gi::capture_material(input).albedo, glm::vec3(0.0f)));
        CHECK(is_plain(gi::capture_material(input).emission, glm::vec3(0.5f)));
        input.emission_multiply = true;
        CHECK(is_plain(gi::capture_material(input).emission, glm::vec3(0.0f)));
    }

    TEST_CASE("resizing to the same size shifts content by half a texel, as Godot's filter does") {
        // Place x - 0.5 between texels x - 1 and x: weights -1/16, 9/16, 9/16, -1/16. At x = 0 the place
        // truncates to 0 with a fraction of -0.5, whose taps lie at -1, 0, 1, 2 with weights K(0.5), K(0.5),
        // K(1.5), K(2.5).
        const Image ramp = image_of({4, 1}, {0, 0, 0, 255, 64, 0, 0, 255, //
                                             128, 0, 0, 255, 192, 0, 0, 255});
        const Image resized = gi::resize_cubic_rgba8(ramp, {4, 1});
        // Along y the single row takes K(0.5) + K(0.5) + K(1.5) + K(2.5) = 9/16 + 9/16 - 1/16 + 0 = 17/16.
        const double row = 17.0 / 16.0;
        const auto red = [&](int x) { return int(resized.data[size_t(x) * 4]); };
        CHECK(red(0) == int(row * (9.0 / 16 * 0 + 9.0 / 16 * 0 - 1.0 / 16 * 64) < 0 ? 0 : 1));
        CHECK(red(1) == int(row * (9.0 / 16 * 0 + 9.0 / 16 * 64 - 1.0 / 16 * 0 - 1.0 / 16 * 128) + 0.5));
        CHECK(red(2) == int(row * (9.0 / 16 * 64 + 9.0 / 16 * 128 - 1.0 / 16 * 0 - 1.0 / 16 * 192) + 0.5));
        CHECK(red(3) == int(row * (9.0 / 16 * 128 + 9.0 / 16 * 192 - 1.0 / 16 * 64 - 1.0 / 16 * 192) + 0.5));
    }

    TEST_CASE("an even image stays even but where taps hang over the first texel") {
        const Image small = gi::resize_cubic_rgba8(plain_image({300, 200}, 10, 100, 200), {128, 128});
        REQUIRE(small.size == glm::ivec2(128, 128));
        for (size_t i = 129; i < 128 * 128; i += 129) { // the diagonal, off the first row and column
            CHECK(small.data[i * 4 + 0] == 10);
            CHECK(small.data[i * 4 + 1] == 100);
            CHECK(small.data[i * 4 + 2] == 200);
        }
    }

    TEST_CASE("sums beyond a byte clamp") {
        std::vector<uint8_t> bytes;
        for (int x = 0; x < 8; ++x) {
            const uint8_t v = x < 4 ? 0 : 255;
            bytes.insert(bytes.end(), {v, v, v, v});
        }
        const Image resized = gi::resize_cubic_rgba8(image_of({8, 1}, bytes), {32, 32});
        bool overshoots = false;
        for (size_t i = 0; i < 32; ++i) {
            overshoots = overshoots || resized.data[i * 4] == 255;
        }
        CHECK(overshoots);
        CHECK(resized.data[0] == 0);
    }
}

} // namespace
