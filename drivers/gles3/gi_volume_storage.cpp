#include "drivers/gles3/gi_volume_storage.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

namespace cl::gles3 {

namespace {

Status check(const GIVolumeDesc& desc) {
    for (int i = 0; i < 3; ++i) {
        const int edge = desc.size[i];
        if (edge < 1 || (edge & (edge - 1)) != 0) {
            return Error{ErrorCode::InvalidArgument,
                         fmt::format("GI volume: expected powers of two as size, found {}x{}x{}", desc.size.x,
                                     desc.size.y, desc.size.z)};
        }
    }
    const int most = gl::full_mip_count(desc.size);
    if (desc.mip_count < 1 || desc.mip_count > most) {
        return Error{ErrorCode::InvalidArgument,
                     fmt::format("GI volume: expected 1 to {} mips, found {}", most, desc.mip_count)};
    }
    return {};
}

Expected<gl::Texture3D> make_volume(const GIVolumeDesc& desc) {
    Expected<gl::Texture3D> volume =
        gl::Texture3D::create({.size = desc.size,
                               .format = gl::Format::RGBA8,
                               .mips = desc.mip_count,
                               .sampler = {.filter = gl::Filter::Linear, .mip_filter = gl::MipFilter::Linear},
                               .label = "GI volume"});
    if (!volume) {
        return volume;
    }
    // Contents are undefined until written: one slice of zeros at a time bounds the memory this takes.
    const std::vector<std::byte> zeros(static_cast<size_t>(desc.size.x) * static_cast<size_t>(desc.size.y) *
                                       4);
    for (int mip = 0; mip < desc.mip_count; ++mip) {
        const glm::ivec3 size = volume->size(mip);
        const size_t bytes = static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * 4;
        for (int z = 0; z < size.z; ++z) {
            if (Status s = volume->upload(mip, {0, 0, z}, {size.x, size.y, 1}, std::span(zeros).first(bytes));
                !s) {
                return s.error();
            }
        }
    }
    return volume;
}

} // namespace

Expected<GIVolumeStorage> GIVolumeStorage::create() {
    Expected<gl::Texture3D> empty = make_volume({.size = glm::ivec3(1), .mip_count = 1});
    if (!empty) {
        return empty.error();
    }
    return GIVolumeStorage(*std::move(empty));
}

Expected<RID> GIVolumeStorage::create(const GIVolumeDesc& desc) {
    if (Status s = check(desc); !s) {
        return s.error();
    }
    Expected<gl::Texture3D> volume = make_volume(desc);
    if (!volume) {
        return volume.error();
    }
    return volumes_.make(*std::move(volume));
}

Status GIVolumeStorage::upload(RID rid, int mip, glm::ivec3 offset, glm::ivec3 size,
                               std::span<const uint8_t> rgba8) {
    gl::Texture3D* volume = volumes_.get(rid);
    if (!volume) {
        return Error{ErrorCode::InvalidArgument,
                     "GI volume: expected a live volume, found a stale or foreign RID"};
    }
    return volume->upload(mip, offset, size, std::as_bytes(rgba8));
}

} // namespace cl::gles3
