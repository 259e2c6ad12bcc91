#include "drivers/gles3/gl/program.h"

#include "drivers/gles3/gl/shader_log.h"
#include "drivers/gles3/gl/state.h"
#include "drivers/gles3/shaders.h"

#include "core/io/log.h"

#include <glm/gtc/type_ptr.hpp>

#include <numeric>
#include <string>

namespace cl::gles3::gl {

namespace {

/// One compiled stage, needed only until its program is linked.
class Stage {
public:
    explicit Stage(GLenum kind) : id_(glCreateShader(kind)) {}
    ~Stage() { glDeleteShader(id_); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    [[nodiscard]] GLuint id() const noexcept { return id_; }

    Status compile(const ShaderSource& source, const std::string& preamble, std::string_view text) {
        const GLchar* parts[] = {preamble.data(), text.data()};
        const GLint lengths[] = {static_cast<GLint>(preamble.size()), static_cast<GLint>(text.size())};
        glShaderSource(id_, 2, parts, lengths);
        glCompileShader(id_);
        GLint done = GL_FALSE;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &done);
        return done ? Status{} : error_from_shader_log(info_log(), source);
    }

private:
    [[nodiscard]] std::string info_log() const {
        GLint size = 0;
        glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &size);
        std::string log(static_cast<size_t>(size), '\0');
        glGetShaderInfoLog(id_, size, &size, log.data());
        log.resize(static_cast<size_t>(size));
        log_debug(log);
        return log;
    }
    GLuint id_;
};

/// What stands before a stage's text; shader_emit.py's preamble() builds the same for glslangValidator.
std::string preamble_of(const ShaderSource& source, uint32_t flags) {
    std::string text = "#version 300 es\n";
    for (size_t i = 0; i < source.flags.size(); ++i) {
        if (flags & (1u << i)) {
            text += "#define " + std::string(source.flags[i]) + " 1\n";
        }
    }
    text += shaders::precision();
    return text;
}

Status link(GLuint program, const ShaderSource& source, uint32_t flags) {
    const std::string preamble = preamble_of(source, flags);
    Stage vertex(GL_VERTEX_SHADER), fragment(GL_FRAGMENT_SHADER);
    if (Status s = vertex.compile(source, preamble, source.vertex); !s) {
        return s;
    }
    if (Status s = fragment.compile(source, preamble, source.fragment); !s) {
        return s;
    }
    glAttachShader(program, vertex.id());
    glAttachShader(program, fragment.id());
    glLinkProgram(program);
    glDetachShader(program, vertex.id());
    glDetachShader(program, fragment.id());
    GLint done = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done) {
        return {};
    }
    std::string log(1024, '\0');
    GLsizei size = 0;
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &size, log.data());
    log.resize(static_cast<size_t>(size));
    return error_from_shader_log(log, source);
}

/// GLSL ES 3.00 has no layout(binding): it is done here, once.
void tie_samplers_and_blocks(GLuint program, const ShaderSource& source) {
    State::current().use_program(program);
    for (const SamplerDecl& sampler : source.samplers) {
        const GLint location = glGetUniformLocation(program, std::string(sampler.name).c_str());
        if (location >= 0) {
            std::vector<GLint> units(static_cast<size_t>(sampler.count));
            std::iota(units.begin(), units.end(), sampler.unit);
            glUniform1iv(location, sampler.count, units.data());
        }
    }
    for (const BlockDecl& block : source.blocks) {
        const GLuint index = glGetUniformBlockIndex(program, std::string(block.name).c_str());
        if (index != GL_INVALID_INDEX) {
            glUniformBlockBinding(program, index, static_cast<GLuint>(block.binding));
        }
    }
}

} // namespace

Program::Program(GLuint id, const ShaderSource& source) : id_(id) {
    locations_.reserve(source.uniforms.size());
    for (const UniformDecl& uniform : source.uniforms) {
        locations_.push_back(glGetUniformLocation(id, std::string(uniform.name).c_str()));
    }
}

Expected<Program> Program::create(const ShaderSource& source, uint32_t flags) {
    CL_ASSERT(source.flags.size() == 32 || flags >> source.flags.size() == 0, "flags that the program has");
    State& state = State::current();
    const GLuint id = state.create(ObjectKind::Program);
    if (Status s = link(id, source, flags); !s) {
        state.destroy(ObjectKind::Program, id);
        return s.error();
    }
    tie_samplers_and_blocks(id, source);
    state.label(ObjectKind::Program, id, source.name);
    return Program(id, source);
}

Program::Program(Program&& other) noexcept
    : id_(std::exchange(other.id_, 0)), locations_(std::move(other.locations_)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(id_, other.id_);
    locations_.swap(other.locations_);
    return *this;
}

Program::~Program() {
    if (id_) {
        State::current().destroy(ObjectKind::Program, id_);
    }
}

GLint Program::use(int index) const {
    State::current().use_program(id_);
    return locations_[static_cast<size_t>(index)];
}

void Program::set_uniform(int index, float value) const {
    glUniform1f(use(index), value);
}
void Program::set_uniform(int index, int value) const {
    glUniform1i(use(index), value);
}
void Program::set_uniform(int index, uint32_t value) const {
    glUniform1ui(use(index), value);
}
void Program::set_uniform(int index, const glm::ivec2& v) const {
    glUniform2i(use(index), v.x, v.y);
}
void Program::set_uniform(int index, const glm::ivec3& v) const {
    glUniform3i(use(index), v.x, v.y, v.z);
}
void Program::set_uniform(int index, const glm::vec2& v) const {
    glUniform2f(use(index), v.x, v.y);
}
void Program::set_uniform(int index, const glm::vec3& v) const {
    glUniform3f(use(index), v.x, v.y, v.z);
}
void Program::set_uniform(int index, const glm::vec4& v) const {
    glUniform4f(use(index), v.x, v.y, v.z, v.w);
}
void Program::set_uniform(int index, const glm::mat3& value) const {
    glUniformMatrix3fv(use(index), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set_uniform(int index, const glm::mat4& value) const {
    glUniformMatrix4fv(use(index), 1, GL_FALSE, glm::value_ptr(value));
}

// Spans of glm types are arrays of their floats: the types are packed.
void Program::set_uniform(int index, std::span<const float> v) const {
    glUniform1fv(use(index), static_cast<GLsizei>(v.size()), v.data());
}
void Program::set_uniform(int index, std::span<const int> v) const {
    glUniform1iv(use(index), static_cast<GLsizei>(v.size()), v.data());
}
void Program::set_uniform(int index, std::span<const glm::vec2> v) const {
    glUniform2fv(use(index), static_cast<GLsizei>(v.size()), reinterpret_cast<const GLfloat*>(v.data()));
}
void Program::set_uniform(int index, std::span<const glm::vec3> v) const {
    glUniform3fv(use(index), static_cast<GLsizei>(v.size()), reinterpret_cast<const GLfloat*>(v.data()));
}
void Program::set_uniform(int index, std::span<const glm::vec4> v) const {
    glUniform4fv(use(index), static_cast<GLsizei>(v.size()), reinterpret_cast<const GLfloat*>(v.data()));
}
void Program::set_uniform(int index, std::span<const glm::mat4> v) const {
    glUniformMatrix4fv(use(index), static_cast<GLsizei>(v.size()), GL_FALSE,
                       reinterpret_cast<const GLfloat*>(v.data()));
}

} // namespace cl::gles3::gl
