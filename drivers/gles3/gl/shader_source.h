#pragma once

#include <cstdint>
#include <span>
#include <string_view>

// What the generated shader table (shader_table.py) is made of. A program's uniforms, samplers and blocks are
// typed constants of a generated struct, so that a renamed or retyped one fails the C++ build.
namespace cl::gles3::gl {

/// A uniform of program `Shader` with value type `T`; `index` into ShaderSource::uniforms.
template <typename Shader, typename T>
struct Uniform {
    int index;
};
/// An array of `count` values.
template <typename Shader, typename T>
struct UniformArray {
    int index;
    int count;
};
/// A sampler (or `count` of them in an array) and its fixed texture unit. `TextureType` is what may be bound.
template <typename Shader, typename TextureType>
struct Sampler {
    int unit;
    int count;
};

struct UniformDecl {
    std::string_view name;
    std::string_view type; ///< in GLSL
    int count = 1;
};
struct SamplerDecl {
    std::string_view name;
    std::string_view type;
    int unit = 0;
    int count = 1;
};
struct BlockDecl {
    std::string_view name;
    int binding = 0; ///< the same in all programs that declare this block
    int bytes = 0;   ///< std140 size
};

/// One program's text, without #version and variant defines.
struct ShaderSource {
    std::string_view name{};
    std::string_view vertex{}, fragment{};
    std::span<const std::string_view> files{}; ///< by the numbers in #line directives; paths from the root
    std::span<const UniformDecl> uniforms{};
    std::span<const SamplerDecl> samplers{};
    std::span<const BlockDecl> blocks{};
    std::span<const std::string_view> flags{}; ///< defines of the variants; flag i is bit i of a key
    std::span<const uint32_t> validated{};     ///< the variants that the build has checked
};

} // namespace cl::gles3::gl
