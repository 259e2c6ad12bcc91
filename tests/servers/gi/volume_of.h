#pragma once

#include "servers/gi/cone_trace.h"

#include <glm/ext/vector_uint4_sized.hpp>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace cl::tests {

/// A cubic volume with all its mips, which a test fills texel by texel.
struct FilledVolume {
    std::vector<glm::ivec3> sizes;
    std::vector<std::vector<uint8_t>> levels;

    /// @param texel  (level, its linear index) to r, g, b, a
    FilledVolume(int size, const std::function<glm::u8vec4(int, int)>& texel) {
        for (int level = 0; size > 0; ++level, size /= 2) {
            sizes.emplace_back(size);
            std::vector<uint8_t>& bytes = levels.emplace_back();
            for (int i = 0; i < size * size * size; ++i) {
                const glm::u8vec4 t = texel(level, i);
                bytes.insert(bytes.end(), {t.r, t.g, t.b, t.a});
            }
        }
    }
    /// Borrows this volume.
    [[nodiscard]] gi::VolumeSampler sampler() const {
        std::vector<gi::VolumeSampler::Level> spans;
        for (size_t i = 0; i < levels.size(); ++i) {
            spans.push_back({sizes[i], levels[i]});
        }
        return gi::VolumeSampler(std::move(spans));
    }
};

} // namespace cl::tests
