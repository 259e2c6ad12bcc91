#pragma once

#include "drivers/gl_api.h"
#include "drivers/gles3/gl/capabilities.h"
#include "drivers/gles3/gl/draw_state.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cl::gles3::gl {

enum class ObjectKind : uint8_t { Texture, Buffer, VertexArray, Framebuffer, Program };
inline constexpr int kObjectKinds = 5;

/// The one place that binds, enables, makes and deletes GL objects. It mirrors the context, so that redundant
/// calls are skipped; nobody else may change these parts of GL state. One State per context, on one thread.
class State {
public:
    /// Needs a current context. Applies the workarounds and sets what is the same for all our drawing;
    /// becomes current().
    State();
    /// Every object must have been deleted before.
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// The State of the context that is current.
    [[nodiscard]] static State& current();
    /// Call whenever its context is made current again.
    void make_current() noexcept;
    [[nodiscard]] const Capabilities& capabilities() const noexcept { return capabilities_; }

    // --- names: used by the RAII types of this folder only
    // -----------------------------------------------------
    [[nodiscard]] GLuint create(ObjectKind kind);
    /// 0 is ignored. Bindings of the name are forgotten, for GL uses names again.
    void destroy(ObjectKind kind, GLuint name);
    void label(ObjectKind kind, GLuint name, std::string_view text);
    /// Objects made and not yet deleted.
    [[nodiscard]] int live(ObjectKind kind) const noexcept { return live_[static_cast<size_t>(kind)]; }

    // --- bindings
    // ----------------------------------------------------------------------------------------------
    void use_program(GLuint program);
    void bind_vertex_array(GLuint vertex_array);
    /// For sampling. `target`: GL_TEXTURE_2D, _3D or _CUBE_MAP.
    void bind_texture(int unit, GLenum target, GLuint texture);
    /// For uploads and parameters: binds to a unit that no program samples from.
    void bind_texture_for_edit(GLenum target, GLuint texture);
    /// GL_ARRAY_BUFFER, GL_UNIFORM_BUFFER, GL_PIXEL_PACK_BUFFER... Element buffers belong to vertex arrays:
    /// bind_vertex_array() first.
    void bind_buffer(GLenum target, GLuint buffer);
    /// A piece of a buffer as the uniform block of binding point `index`; offset aligned as capabilities()
    /// say.
    void bind_uniform_range(int index, GLuint buffer, GLintptr offset, GLsizeiptr size);
    void bind_draw_framebuffer(GLuint framebuffer);
    void bind_read_framebuffer(GLuint framebuffer);

    // --- fixed function
    // ----------------------------------------------------------------------------------------
    void apply(const DrawState& state);
    void set_viewport(const Rect& rect);
    void set_scissor(const std::optional<Rect>& rect); ///< nullopt: off

private:
    static constexpr int kUnits = 32;
    static constexpr int kUniformBindings = 24;
    struct TextureUnit {
        GLuint names[3] = {};
    };
    struct UniformRange {
        GLuint buffer = 0;
        GLintptr offset = 0;
        GLsizeiptr size = 0;
        friend bool operator==(const UniformRange&, const UniformRange&) = default;
    };
    void activate_unit(int unit);
    void forget_texture(GLuint name);

    Capabilities capabilities_;
    std::array<int, kObjectKinds> live_{};
    GLuint program_ = 0, vertex_array_ = 0, draw_framebuffer_ = 0, read_framebuffer_ = 0;
    GLuint default_vertex_array_ = 0; ///< desktop core has none; bound while no other is
    int active_unit_ = 0;
    std::array<TextureUnit, kUnits> units_{};
    std::array<UniformRange, kUniformBindings> uniforms_{};
    std::optional<DrawState> draw_; ///< nullopt: unknown
    Rect viewport_{{-1, -1}, {-1, -1}};
    std::optional<Rect> scissor_;
};

} // namespace cl::gles3::gl
