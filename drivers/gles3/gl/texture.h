#pragma once

#include "drivers/gles3/gl/format.h"

#include "core/expected.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

namespace cl::gles3::gl {

enum class Filter : uint8_t { Nearest, Linear };
enum class MipFilter : uint8_t { None, Nearest, Linear };
enum class Wrap : uint8_t { Clamp, Repeat, Mirror };
enum class Compare : uint8_t {
    None,      ///< sampling returns the value
    LessEqual, ///< a shadow sampler: 1 where reference <= depth, filtered if `filter` is Linear
};

struct SamplerDesc {
    Filter filter = Filter::Linear; ///< both directions; integer and, without float_linear, 32F need Nearest
    MipFilter mip_filter = MipFilter::None;
    Wrap wrap = Wrap::Clamp;
    Compare compare = Compare::None;
    float anisotropy = 1.0f; ///< clamped to what the driver has
};

/// Levels of a full mip chain down to 1 texel.
[[nodiscard]] int full_mip_count(glm::ivec3 size) noexcept;

struct Texture2DDesc {
    glm::ivec2 size{0};
    Format format = Format::RGBA8;
    int mips = 1; ///< levels with storage; sampling never goes beyond them
    SamplerDesc sampler{};
    std::string_view label{};
};
struct Texture3DDesc {
    glm::ivec3 size{0};
    Format format = Format::RGBA8;
    int mips = 1;
    SamplerDesc sampler{};
    std::string_view label{};
};
struct TextureCubeDesc {
    int size = 0; ///< edge of a face [texels]
    Format format = Format::RGBA8;
    int mips = 1;
    SamplerDesc sampler{};
    std::string_view label{};
};
/// Faces in GL's order; images of a face have row 0 where t = 0.
enum class CubeFace : uint8_t { PositiveX, NegativeX, PositiveY, NegativeY, PositiveZ, NegativeZ };

/// What all kinds of textures share: one name, its immutable storage, its sampler. Made by the types below.
class Texture {
public:
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;
    ~Texture();

    [[nodiscard]] GLuint id() const noexcept { return id_; }
    [[nodiscard]] GLenum target() const noexcept { return target_; }
    [[nodiscard]] Format format() const noexcept { return format_; }
    [[nodiscard]] int mips() const noexcept { return mips_; }
    /// z: depth, else 1. Of a mip: halved per level, at least 1.
    [[nodiscard]] glm::ivec3 size(int mip = 0) const noexcept;

    /// For sampling by a program; see ShaderProgram::bind, which checks the kind.
    void bind(int unit) const;
    void set_sampler(const SamplerDesc& sampler);
    /// Fills levels 1.. from level 0 (a box filter on llvmpipe; of colour formats only).
    void generate_mips();

protected:
    struct Storage {
        GLenum target = 0;
        glm::ivec3 size{0};
        Format format = Format::RGBA8;
        int mips = 1;
        SamplerDesc sampler{};
        std::string_view label{};
    };
    /// Checks limits, makes the storage; contents are undefined.
    static Expected<Texture> allocate(const Storage& storage);
    /// @return InvalidArgument if the box leaves the level or the bytes do not fill it.
    Status check_upload(int mip, glm::ivec3 offset, glm::ivec3 size, size_t bytes) const;

    GLuint id_ = 0; ///< 0 after a move: nothing to delete
    GLenum target_ = 0;
    Format format_ = Format::RGBA8;
    int mips_ = 1;
    glm::ivec3 size_{0};

private:
    Texture() = default;
};

/// Uploads take tightly packed texels of the format's transfer layout (format_info), x fastest, and copy
/// them.
class Texture2D final : public Texture {
public:
    /// @return Unsupported if the size is 0, beyond the driver's limit, or memory ran out.
    [[nodiscard]] static Expected<Texture2D> create(const Texture2DDesc& desc);
    Status upload(int mip, glm::ivec2 offset, glm::ivec2 size, std::span<const std::byte> texels);

private:
    explicit Texture2D(Texture&& base) : Texture(std::move(base)) {}
};

class Texture3D final : public Texture {
public:
    [[nodiscard]] static Expected<Texture3D> create(const Texture3DDesc& desc);
    Status upload(int mip, glm::ivec3 offset, glm::ivec3 size, std::span<const std::byte> texels);

private:
    explicit Texture3D(Texture&& base) : Texture(std::move(base)) {}
};

class TextureCube final : public Texture {
public:
    [[nodiscard]] static Expected<TextureCube> create(const TextureCubeDesc& desc);
    Status upload(CubeFace face, int mip, std::span<const std::byte> texels);

private:
    explicit TextureCube(Texture&& base) : Texture(std::move(base)) {}
};

} // namespace cl::gles3::gl
