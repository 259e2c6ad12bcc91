#include "tests/process.h"
#include "tests/shared_dir.h"

#include "core/image.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace {

using cl::tests::ProcessResult;
using cl::tests::TemporaryFolder;

ProcessResult conelight(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), cl::tests::conelight_path());
    return cl::tests::run_process(arguments);
}

std::string demo_scene(const std::string& name) {
    return cl::tests::repository_dir() / "demo" / "scenes" / (name + ".tscn");
}

std::string read_text(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Mean of a channel of a 8-bit picture over a rectangle, 0 to 255.
double channel_mean(const cl::Image& image, int channel, glm::ivec2 from, glm::ivec2 to) {
    const int channels = cl::channel_count(image.format);
    double sum = 0.0;
    for (int y = from.y; y < to.y; ++y) {
        for (int x = from.x; x < to.x; ++x) {
            sum += image.data[(static_cast<size_t>(y) * image.size.x + x) * channels + channel];
        }
    }
    return sum / ((to.x - from.x) * (to.y - from.y));
}

bool is_one_line(const std::string& text) {
    return !text.empty() && text.back() == '\n' && std::count(text.begin(), text.end(), '\n') == 1;
}

} // namespace

TEST_SUITE("demo/cli") {
    TEST_CASE("help and version end with 0 and say what the program is") {
        const ProcessResult version = conelight({"--version"});
        CHECK(version.exit_status == 0);
        CHECK(version.output == "conelight 0.1.0\n");
        for (const char* command : {"", "render", "run", "bake", "reference", "inspect", "bench"}) {
            CAPTURE(command);
            const ProcessResult help = *command ? conelight({command, "--help"}) : conelight({"--help"});
            CHECK(help.exit_status == 0);
            CHECK(help.output.find("--help") != std::string::npos);
        }
    }

    TEST_CASE("a wrong command line ends with 2 and one line") {
        const std::vector<std::vector<std::string>> wrong = {
            {},
            {"paint", "a.tscn"},
            {"render"},
            {"render", "a.tscn", "--size", "640"},
            {"render", "a.tscn", "--size", "0x10"},
            {"render", "a.tscn", "--size", "99999x10"},
            {"render", "a.tscn", "--gi", "magic"},
            {"render", "a.tscn", "--driver", "vulkan"},
            {"render", "a.tscn", "--set", "no-colon"},
            {"render", "a.tscn", "--frames", "0"},
            {"bake", "a.tscn", "--subdiv", "100"},
        };
        for (const auto& arguments : wrong) {
            CAPTURE(arguments.size());
            const ProcessResult result = conelight(arguments);
            CHECK(result.exit_status == 2);
            CHECK(is_one_line(result.errors));
        }
    }

    TEST_CASE("[gl] the demo scene's picture shows red light on the tall box's left side and green on the "
              "right wall") {
        const TemporaryFolder folder;
        const std::string png = folder / "cornell.png";
        const std::string stats = folder / "stats.json";
        const ProcessResult result = conelight({"render", demo_scene("cornell"), "-q", "--gi", "cones",
                                                "--size", "240x135", "-o", png, "--stats", stats});
        REQUIRE(result.exit_status == 0);
        CHECK(result.errors == "");
        const auto image = cl::load_image(png);
        REQUIRE(image.has_value());
        REQUIRE(image->size == glm::ivec2(240, 135));
        const auto json = nlohmann::json::parse(read_text(stats));
        CHECK(json["probes"].size() == 1);
        CHECK(json["probes"][0]["path"] == "GIProbe");
        CHECK(json["gi"] == "cones");
        CHECK(json["size"] == nlohmann::json({240, 135}));
        CHECK(json["draw_calls"].get<int>() >= 9);
        CHECK(json["warnings"] == 0);
    }

    TEST_CASE("[gl] red light bounces off the Cornell box's wall onto the tall box, and only with GI") {
        const TemporaryFolder folder;
        for (const std::string mode : {"off", "cones"}) {
            CAPTURE(mode);
            const std::string png = folder / (mode + ".png");
            REQUIRE(conelight(
                        {"render", demo_scene("cornell"), "-q", "--gi", mode, "--size", "240x135", "-o", png})
                        .exit_status == 0);
            const auto image = cl::load_image(png);
            REQUIRE(image.has_value());
            // The tall box's side that faces the red wall and that no lamp reaches.
            const glm::ivec2 from(83, 66);
            const glm::ivec2 to(91, 98);
            const double red = channel_mean(*image, 0, from, to);
            const double green = channel_mean(*image, 1, from, to);
            if (mode == "off") {
                CHECK(red < 3.0);
            } else {
                CHECK(red > 60.0);
                CHECK(red > 1.3 * green);
            }
        }
    }

    TEST_CASE("a missing scene ends with 1, one located line, and leaves an existing picture alone") {
        const TemporaryFolder folder;
        const auto png = folder.write("out.png", "precious");
        const ProcessResult result = conelight({"render", folder / "none.tscn", "-o", png});
        CHECK(result.exit_status == 1);
        CHECK(is_one_line(result.errors));
        CHECK(result.errors.find("none.tscn") != std::string::npos);
        CHECK(read_text(png) == "precious");
    }

    TEST_CASE("broken scenes end with 1 and one located line each") {
        const TemporaryFolder folder;
        std::string rubbish(4096, '\0');
        for (size_t i = 0; i < rubbish.size(); ++i) {
            rubbish[i] = static_cast<char>((i * 2654435761u) >> 13);
        }
        const std::string head = "[gd_scene format=2]\n\n";
        const std::vector<std::pair<std::string, std::string>> scenes = {
            {"empty.tscn", ""},
            {"truncated.tscn", read_text(demo_scene("cornell")).substr(0, 170)},
            {"rubbish.tscn", rubbish},
            {"no_root.tscn", head},
            {"parent.tscn", head + "[node name=\"A\" type=\"Spatial\" parent=\"B\"]\n"},
            {"type.tscn", head + "[node name=3 type=\"Spatial\"]\n"},
            {"claims.tscn",
             head + "[sub_resource type=\"ArrayMesh\" id=1]\nsurfaces/0 = {\n\"aabb\": AABB( 0, 0, 0, 1, 1, "
                    "1 ),\n"
                    "\"array_data\": PoolByteArray( 0, 0 ),\n\"array_index_data\": PoolByteArray(  ),\n"
                    "\"format\": 97280,\n\"index_count\": 1000000000,\n\"primitive\": 4,\n"
                    "\"vertex_count\": 1000000000\n"},
            {"deep.tscn", head + "[node name=\"A\" type=\"Node\"]\na = " + std::string(100000, '[')},
        };
        for (const auto& scene : scenes) {
            CAPTURE(scene.first);
            const auto path = folder.write(scene.first, scene.second);
            const ProcessResult result = conelight({"render", path, "-o", folder / "o.png"});
            CHECK(result.exit_status == 1);
            CHECK(is_one_line(result.errors));
            CHECK(result.errors.find(scene.first) != std::string::npos);
            CHECK_FALSE(std::filesystem::exists(folder / "o.png"));
        }
        const ProcessResult folder_result = conelight({"render", folder.path()});
        CHECK(folder_result.exit_status == 1);
        CHECK(is_one_line(folder_result.errors));
    }

    TEST_CASE("baking twice writes once and says so") {
        const TemporaryFolder folder;
        const std::filesystem::path made = folder / "new" / "baked";
        const std::vector<std::string> bake = {
            "bake", demo_scene("corridor"), "-o", made, "--compat", "--json", "-"};
        const ProcessResult first = conelight(bake);
        CHECK(first.exit_status == 0);
        const auto json = nlohmann::json::parse(first.output);
        CHECK(json["probes"].size() == 2);
        CHECK(json["probes"][0]["cells"] > json["probes"][0]["leaves"]);
        CHECK(json["bake_ms"] > 0);
        for (const char* not_run : {"driver", "renderer", "size", "gi", "frame_ms", "relight_ms"}) {
            CAPTURE(not_run);
            CHECK(json.at(not_run).is_null());
        }
        const auto file = made / "ProbeNear.tres";
        REQUIRE(std::filesystem::exists(file));
        REQUIRE(std::filesystem::exists(made / "ProbeFar.tres"));
        const std::string bytes = read_text(file);
        const auto time = std::filesystem::last_write_time(file);
        const ProcessResult second = conelight(bake);
        CHECK(second.exit_status == 0);
        CHECK(second.errors.find("nothing changed") != std::string::npos);
        CHECK(std::filesystem::last_write_time(file) == time);
        CHECK(read_text(file) == bytes);
    }

    TEST_CASE("a wrong override ends with one line: 1 if the scene has no such place, 2 if it is no value") {
        const TemporaryFolder folder;
        const ProcessResult unknown_node = conelight(
            {"render", demo_scene("cornell"), "--set", "Nowhere:visible=false", "-o", folder / "o.png"});
        CHECK(unknown_node.exit_status == 1);
        CHECK(is_one_line(unknown_node.errors));
        const ProcessResult bad_value = conelight(
            {"render", demo_scene("cornell"), "--set", "Lamp:light_energy=Vector3(", "-o", folder / "o.png"});
        CHECK(bad_value.exit_status == 2);
        CHECK(
            bad_value.errors ==
            "conelight: error: --set: light_energy:1:9: error: Vector3: expected a number, found end of text "
            "(see conelight --help)\n");
        CHECK_FALSE(std::filesystem::exists(folder / "o.png"));
    }

    TEST_CASE("inspect gives the nodes in file order with the text that saving writes") {
        const ProcessResult result = conelight({"inspect", demo_scene("cornell"), "--json"});
        REQUIRE(result.exit_status == 0);
        const auto json = nlohmann::json::parse(result.output);
        CHECK(json["kind"] == "scene");
        CHECK(json["nodes"][0]["path"] == ".");
        CHECK(json["nodes"][0]["type"] == "Spatial");
        CHECK(json["nodes"][1]["path"] == "./Floor");
        CHECK(json["nodes"][1]["properties"]["use_in_baked_light"] == "true");
        CHECK(json["nodes"][1]["properties"]["mesh"] == "SubResource( 1 )");
        CHECK(json["resources"][0]["type"] == "CubeMesh");
        CHECK(json["resources"][0]["properties"]["size"] == "Vector3( 1, 1, 1 )");
    }
}
