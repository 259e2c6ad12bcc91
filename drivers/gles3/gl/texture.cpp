#include "drivers/gles3/gl/texture.h"

#include "drivers/gles3/gl/state.h"

#include <fmt/core.h>
#include <glm/common.hpp>

#include <algorithm>

namespace cl::gles3::gl {

namespace {

/// Largest size the driver takes.
glm::ivec3 size_limit(GLenum target, const Capabilities& c) {
    switch (target) {
    case GL_TEXTURE_3D:
        return glm::ivec3(c.max_texture_3d_size);
    case GL_TEXTURE_CUBE_MAP:
        return {c.max_cube_size, c.max_cube_size, 1};
    default:
        return {c.max_texture_size, c.max_texture_size, 1};
    }
}

GLint gl_min_filter(const SamplerDesc& sampler) {
    const bool linear = sampler.filter == Filter::Linear;
    switch (sampler.mip_filter) {
    case MipFilter::None:
        return linear ? GL_LINEAR : GL_NEAREST;
    case MipFilter::Nearest:
        return linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
    case MipFilter::Linear:
        break;
    }
    return linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
}

GLint gl_wrap(Wrap wrap) {
    switch (wrap) {
    case Wrap::Repeat:
        return GL_REPEAT;
    case Wrap::Mirror:
        return GL_MIRRORED_REPEAT;
    case Wrap::Clamp:
        break;
    }
    return GL_CLAMP_TO_EDGE;
}

std::string describe(glm::ivec3 size) {
    return fmt::format("{}x{}x{}", size.x, size.y, size.z);
}

bool is_inside(glm::ivec3 offset, glm::ivec3 size, glm::ivec3 whole) {
    for (int i = 0; i < 3; ++i) {
        // Subtracted, not added: offset + size may overflow.
        if (offset[i] < 0 || size[i] < 1 || offset[i] > whole[i] || size[i] > whole[i] - offset[i]) {
            return false;
        }
    }
    return true;
}

/// GL's flag may still hold an older error, which the debug output has told already.
void drop_old_errors() {
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; ++i) {
    }
}

} // namespace

int full_mip_count(glm::ivec3 size) noexcept {
    int count = 1;
    for (int edge = std::max({size.x, size.y, size.z}); edge > 1; edge /= 2) {
        ++count;
    }
    return count;
}

Texture::Texture(Texture&& other) noexcept
    : id_(std::exchange(other.id_, 0)), target_(other.target_), format_(other.format_), mips_(other.mips_),
      size_(other.size_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(id_, other.id_);
    target_ = other.target_;
    format_ = other.format_;
    mips_ = other.mips_;
    size_ = other.size_;
    return *this;
}

Texture::~Texture() {
    if (id_) {
        State::current().destroy(ObjectKind::Texture, id_);
    }
}

glm::ivec3 Texture::size(int mip) const noexcept {
    return glm::max(glm::ivec3(size_.x >> mip, size_.y >> mip, size_.z >> mip), 1);
}

Expected<Texture> Texture::allocate(const Storage& storage) {
    State& state = State::current();
    const glm::ivec3 limit = size_limit(storage.target, state.capabilities());
    const std::string_view format = format_info(storage.format).name;
    if (!is_inside(glm::ivec3(0), storage.size, limit)) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("texture {}: expected a size of 1 to {}, found {}", storage.label,
                                 describe(limit), describe(storage.size))};
    }
    const int most_mips = full_mip_count(storage.size);
    if (storage.mips < 1 || storage.mips > most_mips) {
        return Error{ErrorCode::InvalidArgument, fmt::format("texture {}: expected 1 to {} mips, found {}",
                                                             storage.label, most_mips, storage.mips)};
    }
    Texture texture;
    texture.id_ = state.create(ObjectKind::Texture);
    texture.target_ = storage.target;
    texture.format_ = storage.format;
    texture.mips_ = storage.mips;
    texture.size_ = storage.size;
    state.bind_texture_for_edit(storage.target, texture.id_);
    drop_old_errors();
    const GLenum internal = format_info(storage.format).internal;
    if (storage.target == GL_TEXTURE_3D) {
        glTexStorage3D(storage.target, storage.mips, internal, storage.size.x, storage.size.y,
                       storage.size.z);
    } else {
        glTexStorage2D(storage.target, storage.mips, internal, storage.size.x, storage.size.y);
    }
    if (glGetError() != GL_NO_ERROR) {
        return Error{ErrorCode::Unsupported, fmt::format("texture {}: the driver has no room for {} of {}",
                                                         storage.label, describe(storage.size), format)};
    }
    state.label(ObjectKind::Texture, texture.id_, storage.label);
    glTexParameteri(storage.target, GL_TEXTURE_MAX_LEVEL, storage.mips - 1);
    texture.set_sampler(storage.sampler);
    return texture;
}

Status Texture::check_upload(int mip, glm::ivec3 offset, glm::ivec3 box, size_t bytes) const {
    if (mip < 0 || mip >= mips_) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("expected a mip of 0 to {}, found {}", mips_ - 1, mip)};
    }
    if (!is_inside(offset, box, size(mip))) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("expected a box inside {}, found {} at {}", describe(size(mip)),
                                 describe(box), describe(offset))};
    }
    const size_t wanted = static_cast<size_t>(box.x) * static_cast<size_t>(box.y) *
                          static_cast<size_t>(box.z) *
                          static_cast<size_t>(format_info(format_).bytes_per_texel);
    if (bytes != wanted) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("expected {} bytes for {} texels of {}, found {}", wanted, describe(box),
                                 format_info(format_).name, bytes)};
    }
    return {};
}

void Texture::bind(int unit) const {
    State::current().bind_texture(unit, target_, id_);
}

void Texture::set_sampler(const SamplerDesc& sampler) {
    State& state = State::current();
    state.bind_texture_for_edit(target_, id_);
    glTexParameteri(target_, GL_TEXTURE_MIN_FILTER, gl_min_filter(sampler));
    glTexParameteri(target_, GL_TEXTURE_MAG_FILTER,
                    sampler.filter == Filter::Linear ? GL_LINEAR : GL_NEAREST);
    glTexParameteri(target_, GL_TEXTURE_WRAP_S, gl_wrap(sampler.wrap));
    glTexParameteri(target_, GL_TEXTURE_WRAP_T, gl_wrap(sampler.wrap));
    if (target_ == GL_TEXTURE_3D) {
        glTexParameteri(target_, GL_TEXTURE_WRAP_R, gl_wrap(sampler.wrap));
    }
    if (format_info(format_).kind == FormatClass::Depth ||
        format_info(format_).kind == FormatClass::DepthStencil) {
        const bool shadow = sampler.compare == Compare::LessEqual;
        glTexParameteri(target_, GL_TEXTURE_COMPARE_MODE, shadow ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
        glTexParameteri(target_, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    const float most = state.capabilities().max_anisotropy;
    if (most > 1.0f) {
        glTexParameterf(target_, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::clamp(sampler.anisotropy, 1.0f, most));
    }
}

void Texture::generate_mips() {
    State::current().bind_texture_for_edit(target_, id_);
    glGenerateMipmap(target_);
}

} // namespace cl::gles3::gl
