#include "tests/servers/gi/oracle_probe.h"

#include "tests/servers/gi/primitive_arrays.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace cl::tests {

namespace {

/// One `[...]` block: its heading and its `name = value` lines.
struct Block {
    std::string heading;
    std::map<std::string, std::string> values;
};

std::vector<Block> read_blocks(const std::filesystem::path& path) {
    std::vector<Block> blocks;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const size_t equals = line.find(" = ");
        if (!line.empty() && line[0] == '[') {
            blocks.push_back({line, {}});
        } else if (!blocks.empty() && equals != std::string::npos) {
            blocks.back().values[line.substr(0, equals)] = line.substr(equals + 3);
        }
    }
    return blocks;
}

/// The numbers between the brackets of `Name( 1, 2, 3 )`, or the value itself.
std::vector<float> numbers(const std::string& value) {
    const size_t open = value.find('(');
    std::istringstream text(open == std::string::npos ? value : value.substr(open + 1));
    std::vector<float> result;
    for (float v = 0.0f; text >> v; text.ignore(1)) {
        result.push_back(v);
    }
    return result;
}

Transform read_transform(const std::string& value) {
    const std::vector<float> n = numbers(value);
    Transform t;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            t.basis[column][row] = n[size_t(row * 3 + column)];
        }
        t.origin[row] = n[size_t(9 + row)];
    }
    return t;
}

glm::vec3 read_rgb(const std::string& value) {
    const std::vector<float> n = numbers(value);
    return {n[0], n[1], n[2]};
}

std::unique_ptr<gi::MaterialCapture> read_material(const Block& block) {
    gi::CaptureInput input;
    input.albedo_color = read_rgb(block.values.at("albedo_color"));
    if (const auto emission = block.values.find("emission"); emission != block.values.end()) {
        input.emission_color = read_rgb(emission->second);
        input.emission_energy = numbers(block.values.at("emission_energy"))[0];
    }
    return std::make_unique<gi::MaterialCapture>(gi::capture_material(input));
}

bool is_kind(const Block& block, const char* kind) {
    return block.heading.find(kind) != std::string::npos;
}

} // namespace

std::unique_ptr<OracleProbe> load_oracle_probe(const std::filesystem::path& scene, const std::string& probe,
                                               int subdivision) {
    auto result = std::make_unique<OracleProbe>();
    result->cube = as_stored(cube_arrays(glm::vec3(1.0f)));
    result->sphere = as_stored(sphere_arrays());
    const std::vector<Block> blocks = read_blocks(scene);
    std::map<std::string, const gi::MaterialCapture*> material_of_id;
    Transform local_from_world;
    for (const Block& b : blocks) {
        if (is_kind(b, "type=\"GIProbe\"") && is_kind(b, ("\"" + probe + "\"").c_str())) {
            result->grid = *gi::compute_grid(read_rgb(b.values.at("extents")), subdivision);
            local_from_world = read_transform(b.values.at("transform")).inverse();
        }
        if (is_kind(b, "type=\"SpatialMaterial\"")) {
            const size_t id = b.heading.find("id=") + 3;
            result->materials.push_back(read_material(b));
            material_of_id["SubResource( " + b.heading.substr(id, b.heading.find(']') - id) + " )"] =
                result->materials.back().get();
        }
    }
    for (const Block& b : blocks) {
        if (!is_kind(b, "type=\"MeshInstance\"")) {
            continue;
        }
        const bool is_cube = b.values.at("mesh") == "SubResource( 1 )";
        const SurfaceArrays& arrays = is_cube ? result->cube : result->sphere;
        const AABB bounds{glm::vec3(is_cube ? -0.5f : -1.0f), glm::vec3(is_cube ? 1.0f : 2.0f)};
        const Transform local = local_from_world * read_transform(b.values.at("transform"));
        if (transformed(local, bounds).intersects(result->grid.box)) {
            result->surfaces.push_back({local, arrays.positions, arrays.normals, arrays.uvs, arrays.indices,
                                        material_of_id.at(b.values.at("material/0"))});
        }
    }
    return result;
}

std::vector<int32_t> load_dynamic_data(const std::filesystem::path& tres_xz) {
    std::vector<int32_t> ints;
    FILE* pipe = popen(("xz -dc '" + tres_xz.string() + "'").c_str(), "r");
    if (!pipe) {
        return ints;
    }
    std::string text;
    char buffer[65536];
    for (size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) {
        text.append(buffer, n);
    }
    pclose(pipe);
    const std::string key = "dynamic_data = PoolIntArray( ";
    size_t at = text.find(key);
    if (at == std::string::npos) {
        return ints;
    }
    const char* p = text.c_str() + at + key.size();
    while (*p != ')' && *p != '\0') {
        char* end = nullptr;
        ints.push_back(int32_t(std::strtol(p, &end, 10)));
        p = end;
        while (*p == ',' || *p == ' ') {
            ++p;
        }
    }
    return ints;
}

} // namespace cl::tests
