#include "scene/resources/primitive_builder.h"

namespace cl::scene {

std::vector<float> run(float start, float length, int steps) {
    const float step = length / static_cast<float>(steps);
    std::vector<float> values;
    values.reserve(static_cast<size_t>(steps) + 1);
    float value = start;
    for (int i = 0; i <= steps; ++i) {
        values.push_back(value);
        value += step;
    }
    return values;
}

uint32_t ShapeBuilder::vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec4& tangent,
                              glm::vec2 uv) {
    arrays_.positions.push_back(position);
    arrays_.normals.push_back(normal);
    arrays_.tangents.push_back(tangent);
    arrays_.uvs.push_back(uv);
    return static_cast<uint32_t>(arrays_.positions.size() - 1);
}

void ShapeBuilder::triangle(uint32_t a, uint32_t b, uint32_t c) {
    arrays_.indices.insert(arrays_.indices.end(), {a, b, c});
}

void ShapeBuilder::end_grid(int rows, int columns) {
    const auto row_length = static_cast<uint32_t>(columns) + 1;
    for (uint32_t j = 1; j <= static_cast<uint32_t>(rows); ++j) {
        const uint32_t p = grid_start_ + (j - 1) * row_length;
        const uint32_t t = p + row_length;
        for (uint32_t i = 1; i < row_length; ++i) {
            triangle(p + i - 1, p + i, t + i - 1);
            triangle(p + i, t + i, t + i - 1);
        }
    }
}

void ShapeBuilder::end_paired_grid(int rows, int columns, FirstRow first_row) {
    const uint32_t row_length = 2 * (static_cast<uint32_t>(columns) + 1);
    for (uint32_t j = 1; j <= static_cast<uint32_t>(rows); ++j) {
        const uint32_t p = grid_start_ + (j - 1) * row_length;
        const uint32_t t = p + row_length;
        const bool apex = j == 1 && first_row == FirstRow::Apex;
        for (uint32_t i = 2; i < row_length; i += 2) {
            for (uint32_t face = 0; face < 2; ++face) {
                if (!apex) {
                    triangle(p + i - 2 + face, p + i + face, t + i - 2 + face);
                }
                triangle(p + i + face, t + i + face, t + i - 2 + face);
            }
        }
    }
}

} // namespace cl::scene
