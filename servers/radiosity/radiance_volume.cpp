#include "servers/radiosity/radiance_volume.h"

#include "core/threads.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace cl::radiosity {
namespace {

/// Radiance weighted by opacity, and opacity; as RadianceVolume's texels but in floats.
struct Texels {
    glm::ivec3 size{0};
    std::vector<glm::vec4> values;

    [[nodiscard]] size_t at(int x, int y, int z) const noexcept {
        return (size_t(z) * size_t(size.y) + size_t(y)) * size_t(size.x) + size_t(x);
    }
};

Texels finest(const Patches& patches, size_t probe, const glm::ivec3& size, std::span<const Rgb4> leaving) {
    Texels out{size,
               std::vector<glm::vec4>(size_t(size.x) * size_t(size.y) * size_t(size.z), glm::vec4(0.0f))};
    const std::vector<uint32_t>& first = patches.grids[probe].first;
    for (size_t cell = 0; cell + 1 < first.size(); ++cell) {
        glm::vec3 sum(0.0f);
        float area = 0.0f;
        for (uint32_t p = first[cell]; p < first[cell + 1]; ++p) {
            sum += patches.area_m2[p] * rgb(leaving[p]);
            area += patches.area_m2[p];
        }
        const glm::ivec3 c = patches.grids[probe].cells.cell_at(patches.order[first[cell]]);
        out.values[out.at(c.x, c.y, c.z)] = glm::vec4(area > 0.0f ? sum / area : sum, 1.0f);
    }
    return out;
}

Texels coarser(const Texels& fine) {
    Texels out{glm::max(fine.size / 2, glm::ivec3(1)), {}};
    out.values.resize(size_t(out.size.x) * size_t(out.size.y) * size_t(out.size.z));
    parallel_for(size_t(out.size.z), 1, [&](size_t begin, size_t end) {
        for (int z = int(begin); z < int(end); ++z) {
            for (int y = 0; y < out.size.y; ++y) {
                for (int x = 0; x < out.size.x; ++x) {
                    glm::vec4 sum(0.0f);
                    for (int i = 0; i < 8; ++i) {
                        const glm::ivec3 f = glm::min(
                            2 * glm::ivec3(x, y, z) + glm::ivec3(i & 1, i >> 1 & 1, i >> 2), fine.size - 1);
                        sum += fine.values[fine.at(f.x, f.y, f.z)];
                    }
                    const float opacity = std::min(sum.a / 4.0f, 1.0f);
                    out.values[out.at(x, y, z)] = sum.a > 0.0f ? sum * (opacity / sum.a) : sum;
                }
            }
        }
    });
    return out;
}

/// @param v  0 to 1
uint8_t to_byte(float v) noexcept {
    return uint8_t(v * 255.0f + 0.5f); // NOLINT(bugprone-incorrect-roundings): not negative, and no call
}

std::vector<uint8_t> encoded(const Texels& texels, float range) {
    std::vector<uint8_t> out(texels.values.size() * 4);
    parallel_for(texels.values.size(), 1 << 15, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::vec4& v = texels.values[i];
            if (v.a <= 0.0f) {
                continue;
            }
            for (int c = 0; c < 3; ++c) {
                out[i * 4 + size_t(c)] = to_byte(std::sqrt(std::clamp(v[c] * v.a / range, 0.0f, 1.0f)));
            }
            out[i * 4 + 3] = to_byte(v.a);
        }
    });
    return out;
}

} // namespace

glm::ivec3 radiance_volume_size(const CellGrid& grid) noexcept {
    glm::ivec3 size;
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = int(std::bit_ceil(unsigned(std::max(grid.dims[axis], 1))));
    }
    return size;
}

RadianceVolume make_radiance_volume(const Transport& transport, size_t probe, const Solution& solution) {
    RadianceVolume volume;
    Texels texels = finest(transport.patches, probe,
                           radiance_volume_size(transport.patches.grids[probe].cells), solution.leaving);
    volume.range = 1e-6f;
    for (const glm::vec4& v : texels.values) {
        volume.range = std::max(volume.range, std::max(v.r, std::max(v.g, v.b)));
    }
    for (;;) {
        volume.levels.push_back({texels.size, encoded(texels, volume.range)});
        if (texels.size == glm::ivec3(1)) {
            return volume;
        }
        texels = coarser(texels);
    }
}

} // namespace cl::radiosity
