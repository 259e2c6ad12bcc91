#include "servers/rasterizer_checked.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

namespace cl {
namespace {

Error wrong(std::string message) {
    return {ErrorCode::InvalidArgument, std::move(message), {}};
}

std::string text(glm::ivec2 v) {
    return fmt::format("{}x{}", v.x, v.y);
}
std::string text(glm::ivec3 v) {
    return fmt::format("{}x{}x{}", v.x, v.y, v.z);
}

bool is_positive(glm::ivec2 v) {
    return v.x > 0 && v.y > 0;
}
bool is_power_of_two(int v) {
    return v > 0 && std::has_single_bit(static_cast<unsigned>(v));
}

/// Volume edges beyond this no GLES 3.0 driver must offer (GL_MAX_3D_TEXTURE_SIZE is at least 256).
constexpr int kMaxVolumeEdge = 2048;

} // namespace

RasterizerChecked::RasterizerChecked(std::unique_ptr<Rasterizer> backend) : backend_(std::move(backend)) {}

Expected<RID> RasterizerChecked::keep(Expected<RID> made, Thing thing) {
    if (made) {
        things_.insert_or_assign(*made, thing);
    }
    return made;
}

const RasterizerChecked::Thing* RasterizerChecked::find(RID rid, Kind kind) const noexcept {
    const auto found = things_.find(rid);
    return found != things_.end() && found->second.kind == kind ? &found->second : nullptr;
}

Expected<RID> RasterizerChecked::texture_create(const Image& image, const TextureParams& params,
                                                TextureColorSpace space) {
    if (!is_positive(image.size)) {
        return wrong("texture_create: expected a size above 0, found " + text(image.size));
    }
    const size_t bytes = size_t(image.size.x) * size_t(image.size.y) * size_t(bytes_per_pixel(image.format));
    if (image.data.size() != bytes) {
        return wrong(fmt::format("texture_create: expected {} bytes, found {}", bytes, image.data.size()));
    }
    return keep(backend_->texture_create(image, params, space), {Kind::Texture, 0, {}});
}

Expected<RID> RasterizerChecked::mesh_create(std::span<const MeshSurface> surfaces) {
    for (const MeshSurface& surface : surfaces) {
        if (const Status valid = validate_surface(surface); !valid) {
            return wrong("mesh_create: " + valid.error().message);
        }
    }
    return keep(backend_->mesh_create(surfaces), {Kind::Mesh, surfaces.size(), {}});
}

Expected<RID> RasterizerChecked::sky_create(const SkyDesc& sky) {
    if (!is_positive(sky.size)) {
        return wrong("sky_create: expected a size above 0, found " + text(sky.size));
    }
    const size_t floats = size_t{3} * size_t(sky.size.x) * size_t(sky.size.y);
    if (sky.radiance.size() != floats) {
        return wrong(fmt::format("sky_create: expected {} numbers, found {}", floats, sky.radiance.size()));
    }
    if (!is_power_of_two(sky.radiance_map_size)) {
        return wrong(fmt::format("sky_create: expected a radiance map size that is a power of two, found {}",
                                 sky.radiance_map_size));
    }
    return keep(backend_->sky_create(sky), {Kind::Sky, 0, {}});
}

Expected<RID> RasterizerChecked::gi_volume_create(const GIVolumeDesc& desc) {
    const int longest = std::max({desc.size.x, desc.size.y, desc.size.z});
    if (!is_power_of_two(desc.size.x) || !is_power_of_two(desc.size.y) || !is_power_of_two(desc.size.z) ||
        longest > kMaxVolumeEdge) {
        return wrong(fmt::format("gi_volume_create: expected edges that are powers of two up to {}, found {}",
                                 kMaxVolumeEdge, text(desc.size)));
    }
    const int full_chain = std::bit_width(static_cast<unsigned>(longest));
    if (desc.mip_count < 1 || desc.mip_count > full_chain) {
        return wrong(
            fmt::format("gi_volume_create: expected 1 to {} mips, found {}", full_chain, desc.mip_count));
    }
    return keep(backend_->gi_volume_create(desc), {Kind::Volume, 0, desc});
}

Status RasterizerChecked::gi_volume_upload(RID volume, int mip, glm::ivec3 offset, glm::ivec3 size,
                                           std::span<const uint8_t> rgba8) {
    const Thing* thing = find(volume, Kind::Volume);
    if (!thing) {
        return wrong("gi_volume_upload: expected a live GI volume");
    }
    if (mip < 0 || mip >= thing->volume.mip_count) {
        return wrong(
            fmt::format("gi_volume_upload: expected a mip below {}, found {}", thing->volume.mip_count, mip));
    }
    const glm::ivec3 whole = glm::max(thing->volume.size >> mip, glm::ivec3(1));
    for (int axis = 0; axis < 3; ++axis) { // no sums: they could overflow
        if (offset[axis] < 0 || size[axis] < 1 || size[axis] > whole[axis] ||
            offset[axis] > whole[axis] - size[axis]) {
            return wrong(fmt::format("gi_volume_upload: expected a box inside {}, found {} at {}",
                                     text(whole), text(size), text(offset)));
        }
    }
    const size_t bytes = size_t{4} * size_t(size.x) * size_t(size.y) * size_t(size.z);
    if (rgba8.size() != bytes) {
        return wrong(fmt::format("gi_volume_upload: expected {} bytes, found {}", bytes, rgba8.size()));
    }
    return backend_->gi_volume_upload(volume, mip, offset, size, rgba8);
}

Expected<RID> RasterizerChecked::gi_field_create(const GIFieldDesc& desc) {
    if (glm::any(glm::lessThan(desc.air, glm::ivec3(1))) ||
        glm::any(glm::greaterThan(desc.air, glm::ivec3(kMaxVolumeEdge)))) {
        return wrong(fmt::format("gi_field_create: expected edges of 1 to {}, found {}", kMaxVolumeEdge,
                                 text(desc.air)));
    }
    if (desc.brick_words.size() % 4 != 0 || desc.joints.size() % 2 != 0) {
        return wrong(
            fmt::format("gi_field_create: expected brick words in fours and joint words in pairs, found {} "
                        "and {}",
                        desc.brick_words.size(), desc.joints.size()));
    }
    const size_t points = size_t(desc.air.x) * size_t(desc.air.y) * size_t(desc.air.z);
    return keep(backend_->gi_field_create(desc), {Kind::Field, 0, {}, desc.joints.size() / 2, points});
}

Status RasterizerChecked::gi_field_upload(RID field, std::span<const uint32_t> light,
                                          std::span<const uint16_t> air) {
    const Thing* thing = find(field, Kind::Field);
    if (!thing) {
        return wrong("gi_field_upload: expected a live GI field");
    }
    if (light.size() != thing->field_slots || air.size() != 4 * thing->field_points) {
        return wrong(
            fmt::format("gi_field_upload: expected {} light words and {} air numbers, found {} and {}",
                        thing->field_slots, 4 * thing->field_points, light.size(), air.size()));
    }
    return backend_->gi_field_upload(field, light, air);
}

Expected<RID> RasterizerChecked::target_create(glm::ivec2 size) {
    if (!is_positive(size) || size.x > kMaxImageEdge || size.y > kMaxImageEdge) {
        return wrong(
            fmt::format("target_create: expected a size of 1 to {}, found {}", kMaxImageEdge, text(size)));
    }
    return keep(backend_->target_create(size), {Kind::Target, 0, {}});
}

Status RasterizerChecked::free(RID rid) {
    if (things_.erase(rid) == 0) {
        return wrong("free: expected a live RID of this rasteriser");
    }
    return backend_->free(rid);
}

Status RasterizerChecked::draw(RID target, const Frame& frame) {
    if (Status known = check_target("draw", target); !known) {
        return known;
    }
    if (Status valid = check_frame(frame); !valid) {
        return valid;
    }
    return backend_->draw(target, frame);
}

Expected<Image> RasterizerChecked::target_read(RID target, TargetFormat format) {
    if (const Status known = check_target("target_read", target); !known) {
        return known.error();
    }
    return backend_->target_read(target, format);
}

Status RasterizerChecked::check_target(const char* call, RID target) const {
    if (target && !find(target, Kind::Target)) {
        return wrong(fmt::format("{}: expected a live target or the null RID", call));
    }
    return {};
}

} // namespace cl
