#pragma once

#include "tests/servers/gi/volume_of.h"

#include "drivers/gles3/gi_volume_storage.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/mat4x4.hpp>

#include <random>
#include <string>

namespace cl::tests {

// For tests that hold a function of shaders/lib against its twin on the CPU.

/// Random texels with what a room has: fine levels mostly empty, so that cones go far.
inline FilledVolume sparse_volume(int size) {
    std::mt19937 random(3);
    return {size, [&random](int level, int) {
                const auto some = [&random] { return uint8_t(random() % 120); };
                return level < 3 && random() % 8 != 0 ? glm::u8vec4(0)
                                                      : glm::u8vec4(some(), some(), some(), some());
            }};
}

/// Makes a GPU copy of a volume, which lives as long as the storage, and binds it to unit 0.
inline void bind_volume(gles3::GIVolumeStorage& storage, const FilledVolume& filled) {
    const int mips = int(filled.levels.size());
    const Expected<RID> rid = storage.create({filled.sizes[0], mips});
    REQUIRE(rid);
    for (int m = 0; m < mips; ++m) {
        REQUIRE(storage.upload(*rid, m, glm::ivec3(0), filled.sizes[size_t(m)], filled.levels[size_t(m)]));
    }
    storage.get(*rid)->bind(0);
}

inline std::string glsl(float v) {
    return fmt::format("{:.9e}", v);
}
inline std::string glsl(const glm::vec3& v) {
    return fmt::format("vec3({:.9e}, {:.9e}, {:.9e})", v.x, v.y, v.z);
}
inline std::string glsl(const glm::vec4& v) {
    return fmt::format("vec4({:.9e}, {:.9e}, {:.9e}, {:.9e})", v.x, v.y, v.z, v.w);
}
inline std::string glsl(const glm::mat4& m) {
    return fmt::format("mat4({}, {}, {}, {})", glsl(m[0]), glsl(m[1]), glsl(m[2]), glsl(m[3]));
}

} // namespace cl::tests
