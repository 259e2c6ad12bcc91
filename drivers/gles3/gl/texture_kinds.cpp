// Making and filling the three kinds of textures; what they share is in texture.cpp.
#include "drivers/gles3/gl/state.h"
#include "drivers/gles3/gl/texture.h"

#include <fmt/core.h>

namespace cl::gles3::gl {

Expected<Texture2D> Texture2D::create(const Texture2DDesc& d) {
    Expected<Texture> base =
        allocate({GL_TEXTURE_2D, glm::ivec3(d.size, 1), d.format, d.mips, d.sampler, d.label});
    if (!base) {
        return base.error();
    }
    return Texture2D(*std::move(base));
}

Status Texture2D::upload(int mip, glm::ivec2 offset, glm::ivec2 box, std::span<const std::byte> texels) {
    if (Status s = check_upload(mip, glm::ivec3(offset, 0), glm::ivec3(box, 1), texels.size()); !s) {
        return s;
    }
    const FormatInfo& f = format_info(format_);
    State::current().bind_texture_for_edit(target_, id_);
    glTexSubImage2D(target_, mip, offset.x, offset.y, box.x, box.y, f.transfer, f.type, texels.data());
    return {};
}

Expected<Texture3D> Texture3D::create(const Texture3DDesc& d) {
    Expected<Texture> base = allocate({GL_TEXTURE_3D, d.size, d.format, d.mips, d.sampler, d.label});
    if (!base) {
        return base.error();
    }
    return Texture3D(*std::move(base));
}

Status Texture3D::upload(int mip, glm::ivec3 offset, glm::ivec3 box, std::span<const std::byte> texels) {
    if (Status s = check_upload(mip, offset, box, texels.size()); !s) {
        return s;
    }
    const FormatInfo& f = format_info(format_);
    State::current().bind_texture_for_edit(target_, id_);
    glTexSubImage3D(target_, mip, offset.x, offset.y, offset.z, box.x, box.y, box.z, f.transfer, f.type,
                    texels.data());
    return {};
}

Expected<TextureCube> TextureCube::create(const TextureCubeDesc& d) {
    Expected<Texture> base =
        allocate({GL_TEXTURE_CUBE_MAP, glm::ivec3(d.size, d.size, 1), d.format, d.mips, d.sampler, d.label});
    if (!base) {
        return base.error();
    }
    return TextureCube(*std::move(base));
}

Status TextureCube::upload(CubeFace face, int mip, std::span<const std::byte> texels) {
    const glm::ivec3 box = size(mip);
    if (Status s = check_upload(mip, glm::ivec3(0), box, texels.size()); !s) {
        return s;
    }
    const FormatInfo& f = format_info(format_);
    State::current().bind_texture_for_edit(target_, id_);
    glTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), mip, 0, 0, box.x, box.y,
                    f.transfer, f.type, texels.data());
    return {};
}

} // namespace cl::gles3::gl
