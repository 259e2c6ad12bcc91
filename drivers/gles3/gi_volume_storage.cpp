#include "drivers/gles3/gi_volume_storage.h"

#include <fmt/core.h>
#include <glm/vector_relational.hpp>

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

/// Contents are undefined until written.
Expected<gl::Texture3D> make_texture(const glm::ivec3& size, int mips) {
    return gl::Texture3D::create(
        {.size = size,
         .format = gl::Format::RGBA8,
         .mips = mips,
         .sampler = {.filter = gl::Filter::Linear, .mip_filter = gl::MipFilter::Linear},
         .label = "GI volume"});
}

Expected<gl::Texture3D> make_dark_texture(const GIVolumeDesc& desc) {
    Expected<gl::Texture3D> volume = make_texture(desc.size, desc.mip_count);
    if (!volume) {
        return volume;
    }
    // One slice of zeros at a time bounds the memory this takes.
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

Expected<gl::Texture3D> copy_to_texture(const cones::Volume& from) {
    Expected<gl::Texture3D> texture = make_texture(from.size(0), from.level_count());
    for (int mip = 0; texture && mip < from.level_count(); ++mip) {
        if (Status s = texture->upload(mip, glm::ivec3(0), from.size(mip), std::as_bytes(from.rgba8(mip)));
            !s) {
            return s.error();
        }
    }
    return texture;
}

/// Whether the kernel's 32-bit offsets reach all of a volume.
bool fits_cpu(const GIVolumeDesc& desc) {
    const auto texels = static_cast<uint64_t>(desc.size.x) * static_cast<uint64_t>(desc.size.y) *
                        static_cast<uint64_t>(desc.size.z);
    return texels <= (1u << 28);
}

bool is_inside(const cones::Volume& volume, int mip, const glm::ivec3& offset, const glm::ivec3& size) {
    return mip >= 0 && mip < volume.level_count() && glm::all(glm::greaterThanEqual(offset, glm::ivec3(0))) &&
           glm::all(glm::greaterThanEqual(size, glm::ivec3(1))) &&
           glm::all(glm::lessThanEqual(offset, volume.size(mip) - size));
}

} // namespace

Expected<GIVolumeStorage> GIVolumeStorage::create(ConePath cones) {
    Expected<gl::Texture3D> empty = make_dark_texture({.size = glm::ivec3(1), .mip_count = 1});
    if (!empty) {
        return empty.error();
    }
    return GIVolumeStorage(*std::move(empty), cones);
}

Expected<RID> GIVolumeStorage::create(const GIVolumeDesc& desc) {
    if (Status s = check(desc); !s) {
        return s.error();
    }
    Stored stored;
    if (cones_ == ConePath::Gathered && desc.use == GIVolumeUse::Cones) {
        if (!fits_cpu(desc)) {
            return Error{ErrorCode::Unsupported, "GI volume: expected at most 2^28 cells"};
        }
        stored.cpu.emplace(desc.size, desc.mip_count);
        return volumes_.make(std::move(stored));
    }
    Expected<gl::Texture3D> texture = make_dark_texture(desc);
    if (!texture) {
        return texture.error();
    }
    stored.texture = *std::move(texture);
    return volumes_.make(std::move(stored));
}

Status GIVolumeStorage::upload(RID rid, int mip, glm::ivec3 offset, glm::ivec3 size,
                               std::span<const uint8_t> rgba8) {
    Stored* stored = volumes_.get(rid);
    if (!stored) {
        return Error{ErrorCode::InvalidArgument,
                     "GI volume: expected a live volume, found a stale or foreign RID"};
    }
    if (stored->cpu) {
        const size_t bytes =
            static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z) * 4;
        if (!is_inside(*stored->cpu, mip, offset, size) || rgba8.size() != bytes) {
            return Error{ErrorCode::InvalidArgument, "GI volume: expected a box of the level and its texels"};
        }
        stored->cpu->upload(mip, offset, size, rgba8);
    }
    return stored->texture ? stored->texture->upload(mip, offset, size, std::as_bytes(rgba8)) : Status{};
}

const gl::Texture3D* GIVolumeStorage::get(RID rid) {
    Stored* stored = volumes_.get(rid);
    if (!stored) {
        return nullptr;
    }
    if (!stored->texture) {
        if (Expected<gl::Texture3D> texture = copy_to_texture(*stored->cpu)) {
            stored->texture = *std::move(texture);
        }
    }
    return stored->texture ? &*stored->texture : nullptr;
}

cones::Volume* GIVolumeStorage::cpu_volume(RID rid) noexcept {
    Stored* stored = volumes_.get(rid);
    return stored && stored->cpu ? &*stored->cpu : nullptr;
}

} // namespace cl::gles3
