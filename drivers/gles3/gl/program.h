#pragma once

#include "drivers/gl_api.h"
#include "drivers/gles3/gl/shader_source.h"
#include "drivers/gles3/gl/texture.h"

#include "core/expected.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace cl::gles3::gl {

/// A linked program. Locations are looked up once; samplers and blocks are tied to their fixed units and
/// binding points when it is made. Use ShaderProgram below, which checks names and types at build time.
class Program {
public:
    /// Compiles one variant. @param flags  bits of source.flags to #define
    /// @return ParseError with the place in the .glsl file: "drivers/gles3/shaders/x.glsl:12: ...".
    [[nodiscard]] static Expected<Program> create(const ShaderSource& source, uint32_t flags = 0);
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program();

    [[nodiscard]] GLuint id() const noexcept { return id_; }

    // Setting a uniform makes the program the one in use. One that this variant does not have is ignored.
    void set_uniform(int index, float value) const;
    void set_uniform(int index, int value) const;
    void set_uniform(int index, uint32_t value) const;
    void set_uniform(int index, const glm::ivec2& value) const;
    void set_uniform(int index, const glm::ivec3& value) const;
    void set_uniform(int index, const glm::vec2& value) const;
    void set_uniform(int index, const glm::vec3& value) const;
    void set_uniform(int index, const glm::vec4& value) const;
    void set_uniform(int index, const glm::mat3& value) const;
    void set_uniform(int index, const glm::mat4& value) const;
    void set_uniform(int index, std::span<const float> values) const;
    void set_uniform(int index, std::span<const int> values) const;
    void set_uniform(int index, std::span<const glm::vec2> values) const;
    void set_uniform(int index, std::span<const glm::vec3> values) const;
    void set_uniform(int index, std::span<const glm::vec4> values) const;
    void set_uniform(int index, std::span<const glm::mat4> values) const;

private:
    Program(GLuint id, const ShaderSource& source);
    [[nodiscard]] GLint use(int index) const;

    GLuint id_ = 0;
    std::vector<GLint> locations_; ///< by UniformDecl; -1: not in this variant
};

/// A program whose uniforms are known to C++: `Shader` is a struct of the generated table.
template <typename Shader>
class ShaderProgram {
public:
    /// @param flags  Shader's kXxx constants or-ed together
    [[nodiscard]] static Expected<ShaderProgram> create(uint32_t flags = 0) {
        Expected<Program> program = Program::create(Shader::shader_source(), flags);
        if (!program) {
            return program.error();
        }
        return ShaderProgram(*std::move(program));
    }

    template <typename T>
    void set(Uniform<Shader, T> uniform, const std::type_identity_t<T>& value) const {
        program_.set_uniform(uniform.index, value);
    }
    /// At most `uniform.count` values; the rest keep theirs.
    template <typename T>
    void set(UniformArray<Shader, T> uniform, std::span<const std::type_identity_t<T>> values) const {
        CL_ASSERT(values.size() <= static_cast<size_t>(uniform.count),
                  "more values than the uniform array has");
        program_.set_uniform(uniform.index, values);
    }
    /// Binds a texture for the draws to come, whichever program does them.
    template <typename T>
    static void bind(Sampler<Shader, T> sampler, const std::type_identity_t<T>& texture, int element = 0) {
        CL_ASSERT(element >= 0 && element < sampler.count, "beyond the sampler array");
        texture.bind(sampler.unit + element);
    }

    operator const Program&() const noexcept { return program_; } ///< for Pass::draw
    [[nodiscard]] const Program& program() const noexcept { return program_; }

private:
    explicit ShaderProgram(Program program) : program_(std::move(program)) {}
    Program program_;
};

/// Variants of one shader, compiled when first asked for and kept.
template <typename Shader>
class ShaderVariants {
public:
    /// @param flags  Shader's kXxx constants or-ed together
    /// Pointers stay valid for the life of this object. An error is returned again each time, not compiled
    /// again.
    [[nodiscard]] Expected<const ShaderProgram<Shader>*> get(uint32_t flags) {
        auto found = variants_.find(flags);
        if (found == variants_.end()) {
            found = variants_.emplace(flags, ShaderProgram<Shader>::create(flags)).first;
        }
        if (!found->second) {
            return found->second.error();
        }
        return static_cast<const ShaderProgram<Shader>*>(&*found->second);
    }
    [[nodiscard]] size_t size() const noexcept { return variants_.size(); }

private:
    std::map<uint32_t, Expected<ShaderProgram<Shader>>> variants_;
};

} // namespace cl::gles3::gl
