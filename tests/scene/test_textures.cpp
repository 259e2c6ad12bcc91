#include "tests/scene/text_scene.h"

#include "scene/io/imported_texture.h"
#include "scene/resources/texture.h"

#include "core/variant/variant_parser.h"

#include <array>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

std::string refusal_of(std::string_view data) {
    register_types();
    ImageResource image;
    const Expected<Variant> value = parse_variant(data);
    REQUIRE(value.has_value());
    return image.set("data", *value) == SetResult::Done ? "accepted" : image.refusal();
}

Expected<Ref<StreamTexture>> import(const std::filesystem::path& file, Diagnostics& diagnostics) {
    const std::array<std::filesystem::path, 1> files{file};
    return import_textures(files, diagnostics).front();
}

Image red_pixel() {
    return {.size = {1, 1}, .format = PixelFormat::RGBA8, .data = {255, 0, 0, 255}};
}

} // namespace

TEST_SUITE("scene/resources/texture") {
    TEST_CASE("an image in a file is its base level in one of our formats") {
        register_types();
        ImageResource image;
        const Expected<Variant> value = parse_variant(
            R"({ "data": PoolByteArray( 1, 2, 3, 4, 5, 6, 9 ), "format": "RGB8", "height": 1, "mipmaps": true, "width": 2 })");
        REQUIRE(image.set("data", *value) == SetResult::Done);
        REQUIRE(image.image() != nullptr);
        CHECK(image.image()->size == glm::ivec2(2, 1));
        CHECK(image.image()->format == PixelFormat::RGB8);
        CHECK(image.image()->data == std::vector<uint8_t>{1, 2, 3, 4, 5, 6}); // the mipmap's byte stays out
        CHECK(Variant(image.data()) == *value);
    }

    TEST_CASE("sizes of a billion and bytes that are not there are refused") {
        CHECK(refusal_of(
                  R"({ "data": PoolByteArray( 1 ), "format": "L8", "height": 1, "width": 1000000000 })") ==
              "expected \"width\" and \"height\" from 1 to 16384, found 1000000000 and 1");
        CHECK(refusal_of(
                  R"({ "data": PoolByteArray( 1 ), "format": "RGB8", "height": 16384, "width": 16384 })") ==
              "expected at least 16384 * 16384 * 3 = 805306368 bytes of data, found 1");
        CHECK(refusal_of(R"({ "data": PoolByteArray( 1 ), "height": 1, "width": 1 })") ==
              "expected a format name as \"format\", found none");
        CHECK(refusal_of(R"({ "data": [ 1 ], "format": "RGB8", "height": 1, "width": 1 })") ==
              "expected a PoolByteArray as \"data\", found none");
    }

    TEST_CASE("a format that we do not read is kept for saving and gives no image") {
        register_types();
        ImageResource image;
        const Expected<Variant> value = parse_variant(
            R"({ "data": PoolByteArray( 1 ), "format": "DXT5", "height": 4, "mipmaps": false, "width": 4 })");
        CHECK(image.set("data", *value) == SetResult::Done);
        CHECK(image.image() == nullptr);
        CHECK(image.problem() == "image format \"DXT5\" is not supported");
        CHECK(Variant(image.data()) == *value);
    }

    TEST_CASE("an image texture shows its image") {
        register_types();
        auto image = make_ref<ImageResource>();
        image->set_image(std::make_shared<const Image>(red_pixel()));
        ImageTexture texture;
        texture.set_image_resource(image);
        CHECK(texture.image() == image->image());
        CHECK(texture.display_size() == glm::vec2(1.0f));
    }

    TEST_CASE(
        "the flags of an imported image come from its settings, else they are mipmaps, repeat and filter") {
        const cl::tests::TestProject project;
        Diagnostics diagnostics;
        REQUIRE(save_image(red_pixel(), project.file("a.png")).ok());
        const Expected<Ref<StreamTexture>> plain = import(project.file("a.png"), diagnostics);
        REQUIRE(plain.has_value());
        CHECK((*plain)->flags() == 7);

        project.write("a.png.import",
                      "[remap]\n\nimporter=\"texture\"\npath=\"res://.import/a.stex\"\n\n[params]\n\n"
                      "flags/repeat=2\nflags/filter=false\nflags/mipmaps=true\n");
        const Expected<Ref<StreamTexture>> mirrored = import(project.file("a.png"), diagnostics);
        REQUIRE(mirrored.has_value());
        CHECK((*mirrored)->flags() == (texture_flag::kMipmaps | texture_flag::kMirroredRepeat));
        CHECK(diagnostics.warnings().empty());
    }

    TEST_CASE("settings that cannot be read are a warning, and the defaults count") {
        const cl::tests::TestProject project;
        Diagnostics diagnostics;
        REQUIRE(save_image(red_pixel(), project.file("a.png")).ok());
        project.write("a.png.import", "[params]\nflags/repeat=(\n");
        const Expected<Ref<StreamTexture>> texture = import(project.file("a.png"), diagnostics);
        REQUIRE(texture.has_value());
        CHECK((*texture)->flags() == 7);
        CHECK(diagnostics.warnings().size() == 1);
    }

    TEST_CASE("image files are known by their names") {
        CHECK(is_image_name("res://A.PNG"));
        CHECK(is_image_name("sky.hdr"));
        CHECK(!is_image_name("png"));
        CHECK(!is_image_name("a.tscn"));
    }
}
