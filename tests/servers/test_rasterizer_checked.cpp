#include "tests/servers/server_fixture.h"

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/rasterizer_checked.h"

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

using namespace cl;

namespace {

struct Checked {
    dummy::DummyRasterizer* dummy;
    RasterizerChecked checked;

    Checked() : Checked(std::make_unique<dummy::DummyRasterizer>()) {}

private:
    explicit Checked(std::unique_ptr<dummy::DummyRasterizer> recorder)
        : dummy(recorder.get()), checked(std::move(recorder)) {}
};

Image image_of(glm::ivec2 size, size_t bytes) {
    Image image;
    image.size = size;
    image.data.resize(bytes);
    return image;
}

/// A frame with one of everything, all of it right.
struct WholeFrame {
    Checked c;
    RID mesh, volume, texture, target;
    MaterialDesc material;
    LightDesc sun, omni;
    std::vector<CasterItem> casters;
    std::vector<DrawItem> opaque;
    std::vector<LightItem> lights;
    std::vector<GIProbeShading> probes;
    Frame frame;

    WholeFrame() {
        const std::vector<MeshSurface> surfaces{tests::box_surface()};
        mesh = c.checked.mesh_create(surfaces).value();
        volume = c.checked.gi_volume_create({{8, 8, 8}, 4}).value();
        texture = c.checked.texture_create(image_of({1, 1}, 4), {}, TextureColorSpace::Srgb).value();
        target = c.checked.target_create({4, 4}).value();
        material.albedo_texture = texture;
        sun.type = LightType::Directional;
        casters.resize(1);
        casters[0].mesh = mesh;
        casters[0].material = &material;
        lights.resize(2);
        lights[0].desc = &sun;
        lights[1].desc = &omni;
        lights[1].casters = casters;
        probes.resize(1);
        probes[0].volume = volume;
        probes[0].size = {8, 8, 8};
        opaque.resize(1);
        opaque[0].mesh = mesh;
        opaque[0].material = &material;
        opaque[0].gi_probes = {0, -1};
        opaque[0].omni_count = 1;
        opaque[0].omnis[0] = 1;
        frame.size = {4, 4};
        frame.opaque = opaque;
        frame.lights = lights;
        frame.directional_count = 1;
        frame.gi_probes = probes;
    }
    std::string draw() {
        const Status status = c.checked.draw(target, frame);
        return status ? std::string() : status.error().message;
    }
};

std::string draw_after(const std::function<void(WholeFrame&)>& spoil) {
    WholeFrame f;
    spoil(f);
    const std::string message = f.draw();
    CHECK(f.c.dummy->count(dummy::CallKind::Draw) == (message.empty() ? 1 : 0)); // never reaches the backend
    return message;
}

} // namespace

TEST_SUITE("servers/rasterizer_checked") {
    TEST_CASE(
        "images, skies, volumes and targets of impossible sizes are refused before the backend sees them") {
        Checked c;
        const auto message = [](const auto& result) { return result.error().message; };
        const TextureParams params;
        CHECK(message(c.checked.texture_create(image_of({0, 1}, 0), params, TextureColorSpace::Linear)) ==
              "texture_create: expected a size above 0, found 0x1");
        CHECK(message(c.checked.texture_create(image_of({2, 2}, 15), params, TextureColorSpace::Linear)) ==
              "texture_create: expected 16 bytes, found 15");
        SkyDesc sky;
        sky.size = {2, 1};
        sky.radiance.resize(5);
        CHECK(message(c.checked.sky_create(sky)) == "sky_create: expected 6 numbers, found 5");
        sky.radiance.resize(6);
        sky.radiance_map_size = 100;
        CHECK(message(c.checked.sky_create(sky)) ==
              "sky_create: expected a radiance map size that is a power of two, found 100");
        CHECK(message(c.checked.gi_volume_create({{8, 0, 8}, 1})) ==
              "gi_volume_create: expected edges that are powers of two up to 2048, found 8x0x8");
        CHECK(message(c.checked.gi_volume_create({{8, 4, 8}, 5})) ==
              "gi_volume_create: expected 1 to 4 mips, found 5");
        CHECK(message(c.checked.target_create({0, 9})) ==
              "target_create: expected a size of 1 to 16384, found 0x9");
        MeshSurface torn = tests::box_surface();
        torn.vertices.pop_back();
        CHECK(message(c.checked.mesh_create(std::span(&torn, 1))).starts_with("mesh_create: "));
        CHECK(c.dummy->calls().empty());
    }

    TEST_CASE("an upload must fit its mip, start inside it and bring its bytes") {
        Checked c;
        const RID volume = c.checked.gi_volume_create({{8, 4, 8}, 3}).value();
        std::vector<uint8_t> texels(4 * 4 * 2 * 4);
        const auto message = [&](int mip, glm::ivec3 offset, glm::ivec3 size) {
            const Status status = c.checked.gi_volume_upload(volume, mip, offset, size, texels);
            return status ? std::string() : status.error().message;
        };
        CHECK(message(1, {0, 0, 0}, {4, 2, 4}).empty());
        CHECK(message(3, {0, 0, 0}, {1, 1, 1}) == "gi_volume_upload: expected a mip below 3, found 3");
        CHECK(message(1, {1, 0, 0}, {4, 2, 4}) ==
              "gi_volume_upload: expected a box inside 4x2x4, found 4x2x4 at 1x0x0");
        CHECK(
            message(1, {2147483647, 0, 0}, {4, 2, 4}).starts_with("gi_volume_upload: expected a box inside"));
        CHECK(message(1, {0, 0, 0}, {4, 2, 3}) == "gi_volume_upload: expected 96 bytes, found 128");
        CHECK(!c.checked.gi_volume_upload(RID{9, 9}, 0, {}, {1, 1, 1}, texels));
    }

    TEST_CASE("what was freed is unknown from then on") {
        Checked c;
        const RID target = c.checked.target_create({2, 2}).value();
        CHECK(c.checked.free(target));
        CHECK(!c.checked.free(target));
        CHECK(!c.checked.target_read(target, TargetFormat::Srgb8));
        Frame frame;
        frame.size = {2, 2};
        CHECK(c.checked.draw(target, frame).error().message ==
              "draw: expected a live target or the null RID");
    }

    TEST_CASE("a frame in order is drawn, one with any wrong part is refused with the part's name") {
        CHECK(draw_after([](WholeFrame&) {}).empty());
        CHECK(draw_after([](WholeFrame& f) {
                  f.frame.size = {0, 4};
              }) == "draw: expected a size above 0, found 0x4");
        CHECK(draw_after([](WholeFrame& f) { f.opaque[0].material = nullptr; }) ==
              "draw: expected a material in each item");
        CHECK(draw_after([](WholeFrame& f) { f.opaque[0].mesh = f.texture; }) ==
              "draw: expected a live mesh in each item");
        CHECK(draw_after([](WholeFrame& f) { f.opaque[0].surface = 1; }) ==
              "draw: expected a surface below 1, found 1");
        CHECK(draw_after([](WholeFrame& f) { f.material.ao_texture = f.mesh; }) ==
              "draw: expected live textures or null RIDs in each material");
        CHECK(draw_after([](WholeFrame& f) { f.material.transparent = true; }) ==
              "draw: expected each item in the list that its material belongs to");
        CHECK(draw_after([](WholeFrame& f) {
                  f.opaque[0].gi_probes = {1, -1};
              }) == "draw: expected a probe below 1, found 1");
        CHECK(draw_after([](WholeFrame& f) {
                  f.opaque[0].gi_probes = {-1, 0};
              }) == "draw: expected a first probe wherever there is a second");
        CHECK(draw_after([](WholeFrame& f) { f.opaque[0].omnis[0] = 0; }) ==
              "draw: expected an index of a light of the right type, found 0");
        CHECK(draw_after([](WholeFrame& f) { f.opaque[0].spot_count = 9; }) ==
              "draw: expected at most 8 omni and spot lights, found 1 and 9");
        CHECK(draw_after([](WholeFrame& f) { f.frame.directional_count = 2; }) ==
              "draw: expected the directional lights, and only those, to come first");
        CHECK(draw_after([](WholeFrame& f) { f.frame.directional_count = 3; }) ==
              "draw: expected a directional_count of at most 16 and 2 lights, found 3");
        CHECK(draw_after([](WholeFrame& f) { f.lights[1].desc = nullptr; }) ==
              "draw: expected a description of each light");
        CHECK(draw_after([](WholeFrame& f) { f.casters[0].mesh = {}; }) ==
              "draw: expected a live mesh in each item");
        CHECK(draw_after([](WholeFrame& f) { f.probes[0].volume = f.mesh; }) ==
              "draw: expected a live GI volume or the null RID in each probe");
        CHECK(draw_after([](WholeFrame& f) {
                  f.probes[0].size = {8, 8, 4};
              }) == "draw: expected the probe to have its volume's size 8x8x8, found 8x8x4");
        CHECK(draw_after([](WholeFrame& f) {
                  f.frame.has_environment = true;
                  f.frame.environment.sky = f.mesh;
              }) == "draw: expected a live sky or the null RID in the environment");
    }
}
