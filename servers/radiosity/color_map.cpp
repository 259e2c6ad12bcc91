#include "servers/radiosity/color_map.h"

#include "core/math/color.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cl::radiosity {
namespace {

constexpr int kMaxEdge = 256;

const std::array<float, 256>& linear_of_byte() {
    static const std::array<float, 256> kTable = [] {
        std::array<float, 256> table{};
        for (size_t i = 0; i < table.size(); ++i) {
            table[i] = linear_from_srgb(float(i) / 255.0f);
        }
        return table;
    }();
    return kTable;
}

/// Mean of the texels of one cell when an image is reduced to `size`.
glm::vec4 mean_of_box(const Image& rgba, glm::ivec2 size, glm::ivec2 at, bool is_float) {
    const auto first = [&](int axis) { return int(int64_t(at[axis]) * rgba.size[axis] / size[axis]); };
    const auto last = [&](int axis) {
        return std::max(first(axis) + 1, int((int64_t(at[axis]) + 1) * rgba.size[axis] / size[axis]));
    };
    glm::vec4 sum(0.0f);
    for (int y = first(1); y < last(1); ++y) {
        for (int x = first(0); x < last(0); ++x) {
            const size_t texel = (size_t(y) * size_t(rgba.size.x) + size_t(x)) * 4;
            if (is_float) {
                const float* p = rgba.floats().data() + texel;
                sum += glm::vec4(p[0], p[1], p[2], p[3]);
            } else {
                const uint8_t* p = rgba.data.data() + texel;
                const std::array<float, 256>& linear = linear_of_byte();
                sum += glm::vec4(linear[p[0]], linear[p[1]], linear[p[2]], float(p[3]) / 255.0f);
            }
        }
    }
    return sum / float((last(0) - first(0)) * (last(1) - first(1)));
}

} // namespace

ColorMap::ColorMap(const Image& image) {
    if (image.size.x < 1 || image.size.y < 1) {
        levels_.push_back({glm::ivec2(1), {glm::vec4(1.0f)}});
        return;
    }
    const bool is_float = is_float_format(image.format);
    const Image rgba = image.converted_to(is_float ? PixelFormat::RGBAF : PixelFormat::RGBA8);
    Level top{glm::min(rgba.size, glm::ivec2(kMaxEdge)), {}};
    top.texels.reserve(size_t(top.size.x) * size_t(top.size.y));
    for (int y = 0; y < top.size.y; ++y) {
        for (int x = 0; x < top.size.x; ++x) {
            top.texels.push_back(mean_of_box(rgba, top.size, {x, y}, is_float));
        }
    }
    levels_.push_back(std::move(top));
    while (levels_.back().size != glm::ivec2(1)) {
        const Level& fine = levels_.back();
        Level coarse{glm::max(fine.size / 2, glm::ivec2(1)), {}};
        for (int y = 0; y < coarse.size.y; ++y) {
            for (int x = 0; x < coarse.size.x; ++x) {
                const int x1 = std::min(2 * x + 1, fine.size.x - 1),
                          y1 = std::min(2 * y + 1, fine.size.y - 1);
                const auto texel = [&fine](int column, int row) {
                    return fine.texels[size_t(row) * size_t(fine.size.x) + size_t(column)];
                };
                coarse.texels.push_back(0.25f * (texel(std::min(2 * x, x1), std::min(2 * y, y1)) +
                                                 texel(x1, std::min(2 * y, y1)) +
                                                 texel(std::min(2 * x, x1), y1) + texel(x1, y1)));
            }
        }
        levels_.push_back(std::move(coarse));
    }
}

glm::vec4 ColorMap::sample(glm::vec2 uv, float footprint) const noexcept {
    const float texels = footprint * float(std::max(levels_[0].size.x, levels_[0].size.y));
    const float lod = texels > 1.0f ? std::log2(texels) + 0.5f : 0.0f;
    const size_t last = levels_.size() - 1;
    const Level& level = levels_[lod < float(last) ? size_t(lod) : last];
    const auto wrapped = [](float v, int edge) {
        const float share = v - std::floor(v);
        return std::isfinite(share) ? std::min(int(share * float(edge)), edge - 1) : 0;
    };
    return level.texels[size_t(wrapped(uv.y, level.size.y)) * size_t(level.size.x) +
                        size_t(wrapped(uv.x, level.size.x))];
}

} // namespace cl::radiosity
