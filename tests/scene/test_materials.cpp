#include "tests/scene/scene_fixture.h"

#include "scene/resources/spatial_material.h"

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/visual_server.h"

#include <doctest/doctest.h>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

std::vector<std::string> stored_names(const Object& object) {
    std::vector<std::string> names;
    for (const Object::PropertyValue& p : object.stored_properties()) {
        names.push_back(p.name.str());
    }
    return names;
}

Ref<ImageTexture> texture_of(Color texel) {
    const auto byte = [](float v) { return static_cast<uint8_t>(v * 255.0f); };
    auto texture = make_ref<ImageTexture>();
    texture->set_image(
        std::make_shared<const Image>(Image{.size = {1, 1},
                                            .format = PixelFormat::RGBA8,
                                            .data = {byte(texel.r), byte(texel.g), byte(texel.b), 255}}));
    return texture;
}

} // namespace

TEST_SUITE("scene/resources/materials") {
    TEST_CASE(
        "the properties of a feature are saved while it is on, even at their defaults, and never otherwise") {
        register_types();
        SpatialMaterial material;
        SpatialParams params;
        params.emission_energy = 3.0f; // of a feature that is off
        material.set_params(params);
        CHECK(stored_names(material).empty());
        params.emission_enabled = true;
        material.set_params(params);
        CHECK(stored_names(material) == std::vector<std::string>{"emission_enabled", "emission",
                                                                 "emission_energy", "emission_operator",
                                                                 "emission_on_uv2"});
        params = {};
        params.use_alpha_scissor = true;
        params.ao_enabled = true;
        material.set_params(params);
        CHECK(stored_names(material) ==
              std::vector<std::string>{"params_use_alpha_scissor", "params_alpha_scissor_threshold",
                                       "ao_enabled", "ao_light_affect", "ao_on_uv2", "ao_texture_channel"});
    }

    TEST_CASE("any property is accepted from a file, whatever is switched on") {
        register_types();
        SpatialMaterial material;
        CHECK(material.set("emission", Color{1, 0.5f, 0, 1}) == SetResult::Done);
        CHECK(material.set("normal_scale", 2) == SetResult::Done);
        CHECK(material.params().emission == Color{1, 0.5f, 0, 1});
        CHECK(material.params().normal_scale == 2.0f);
    }

    TEST_CASE("the server is told of the material when it is first drawn, and of each change after that") {
        register_types();
        VisualServer server(std::make_unique<dummy::DummyRasterizer>());
        SpatialMaterial material;
        SpatialParams params;
        params.roughness = 0.25f;
        material.set_params(params);
        const RID rid = material.rid(server);
        CHECK(rid.is_valid());
        CHECK(material.describe(server).roughness == 0.25f);
        params.metallic = 1.0f;
        material.set_params(params);
        CHECK(material.rid(server) == rid);
    }

    TEST_CASE("a material frees its RID with itself, or not at all if the server went first") {
        register_types();
        auto server = std::make_unique<VisualServer>(std::make_unique<dummy::DummyRasterizer>());
        RID rid;
        {
            SpatialMaterial gone;
            rid = gone.rid(*server);
            CHECK(server->material_set(rid, MaterialDesc{}).ok());
        }
        CHECK(!server->material_set(rid, MaterialDesc{}).ok());
        SpatialMaterial survivor;
        static_cast<void>(survivor.rid(*server));
        server.reset();
        VisualServer other(std::make_unique<dummy::DummyRasterizer>());
        CHECK(survivor.rid(other).is_valid());
    }

    TEST_CASE("textures of features that are off stay out of the description") {
        register_types();
        VisualServer server(std::make_unique<dummy::DummyRasterizer>());
        SpatialMaterial material;
        material.set_texture(TextureSlot::Albedo, texture_of({1, 0, 0, 1}));
        material.set_texture(TextureSlot::Normal, texture_of({0.5f, 0.5f, 1, 1}));
        CHECK(material.describe(server).albedo_texture.is_valid());
        CHECK(!material.describe(server).normal_texture.is_valid());
        SpatialParams params;
        params.normal_enabled = true;
        material.set_params(params);
        CHECK(material.describe(server).normal_texture.is_valid());
    }

    TEST_CASE("another image in a texture changes the material that uses it") {
        register_types();
        SpatialMaterial material;
        const Ref<ImageTexture> texture = texture_of({1, 0, 0, 1});
        material.set_texture(TextureSlot::Albedo, texture);
        int told = 0;
        material.on_changed([&told] { ++told; });
        texture->set_image(texture_of({0, 1, 0, 1})->image());
        CHECK(told == 1);
        material.set_texture(TextureSlot::Albedo, nullptr);
        told = 0;
        texture->set_flags(0);
        CHECK(told == 0);
    }

    TEST_CASE("a bake reads colours as they are stored and takes emission even when it is switched off") {
        register_types();
        SpatialMaterial material;
        SpatialParams params;
        params.albedo = {0.8f, 0.4f, 0.2f, 1};
        params.emission = {1, 0.5f, 0, 1};
        params.emission_energy = 2.0f;
        material.set_params(params);
        const gi::MaterialCapture capture = gi::capture_material(material.bake_material().input);
        CHECK(capture.albedo[0] == glm::vec3(0.8f, 0.4f, 0.2f));
        CHECK(capture.emission[0] == glm::vec3(2, 1, 0));
    }

    TEST_CASE("a texture without pixels bakes black, no texture bakes the colour") {
        register_types();
        SpatialMaterial material;
        material.set_texture(TextureSlot::Albedo, make_ref<ImageTexture>());
        const BakeMaterial without_pixels = material.bake_material();
        CHECK(gi::capture_material(without_pixels.input).albedo[0] == glm::vec3(0.0f));
        material.set_texture(TextureSlot::Albedo, nullptr);
        CHECK(gi::capture_material(material.bake_material().input).albedo[0] == glm::vec3(1.0f));
    }

    TEST_CASE("a shader material keeps its parameters for saving and is drawn and baked white") {
        register_types();
        VisualServer server(std::make_unique<dummy::DummyRasterizer>());
        ShaderMaterial material;
        CHECK(material.set("shader_param/glow", 0.5) == SetResult::Done);
        CHECK(material.get("shader_param/glow") == Variant(0.5));
        CHECK(stored_names(material) == std::vector<std::string>{"shader_param/glow"});
        CHECK(material.describe(server).albedo == Color{1, 1, 1, 1});
        CHECK(gi::capture_material(material.bake_material().input).albedo[0] == glm::vec3(1.0f));
    }

    TEST_CASE("passes that would follow themselves are refused") {
        register_types();
        const auto a = make_ref<SpatialMaterial>(), b = make_ref<SpatialMaterial>();
        CHECK(a->set_next_pass(b) == SetResult::Done);
        CHECK(b->set_next_pass(a) == SetResult::Refused);
        CHECK(a->set_next_pass(a) == SetResult::Refused);
        CHECK(a->set_render_priority(200) == SetResult::Refused);
        CHECK(a->render_priority() == 0);
    }
}
