#include "drivers/dummy/dummy_rasterizer.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

namespace cl::dummy {
namespace {

/// RIDs of this rasteriser start above those of any server's kinds, so that a server that mixes them up is
/// told.
enum class Kind : uint32_t { Texture = 129, Mesh, Sky, Volume, Target, Field };

constexpr uint32_t first_slot(Kind kind) {
    return static_cast<uint32_t>(kind);
}

uint64_t hash_of(std::span<const uint8_t> bytes) {
    return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Error stale(const char* what) {
    return {ErrorCode::InvalidArgument, std::string("dummy rasteriser: expected a live ") + what, {}};
}

int64_t triangle_count(const MeshSurface& surface) {
    const int64_t corners = surface.index_count > 0 ? surface.index_count : surface.vertex_count;
    switch (surface.primitive) {
    case PrimitiveType::Triangles:
        return corners / 3;
    case PrimitiveType::TriangleStrip:
    case PrimitiveType::TriangleFan:
        return std::max<int64_t>(corners - 2, 0);
    default:
        return 0;
    }
}

uint8_t to_byte(float v) {
    return static_cast<uint8_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f));
}

} // namespace

std::string_view to_string(CallKind kind) noexcept {
    switch (kind) {
    case CallKind::TextureCreate:
        return "texture_create";
    case CallKind::MeshCreate:
        return "mesh_create";
    case CallKind::SkyCreate:
        return "sky_create";
    case CallKind::VolumeCreate:
        return "gi_volume_create";
    case CallKind::VolumeUpload:
        return "gi_volume_upload";
    case CallKind::FieldCreate:
        return "gi_field_create";
    case CallKind::FieldUpload:
        return "gi_field_upload";
    case CallKind::TargetCreate:
        return "target_create";
    case CallKind::Free:
        return "free";
    case CallKind::Draw:
        return "draw";
    case CallKind::TargetRead:
        return "target_read";
    case CallKind::Present:
        return "present";
    }
    return "?";
}

DummyRasterizer::DummyRasterizer()
    : textures_(first_slot(Kind::Texture)), meshes_(first_slot(Kind::Mesh)), skies_(first_slot(Kind::Sky)),
      volumes_(first_slot(Kind::Volume)), targets_(first_slot(Kind::Target)),
      fields_(first_slot(Kind::Field)) {}

RasterizerInfo DummyRasterizer::info() const {
    return {"dummy", "no graphics", "none", cpu_frame_ms_ > 0.0};
}

Expected<RID> DummyRasterizer::texture_create(const Image& image, const TextureParams&,
                                              TextureColorSpace space) {
    if (auto failure = take_failure(CallKind::TextureCreate)) {
        return *failure;
    }
    const RID rid = textures_.make({image.size, space});
    record(CallKind::TextureCreate, rid, {image.size, 1}, 0, image.data);
    return rid;
}

Expected<RID> DummyRasterizer::mesh_create(std::span<const MeshSurface> surfaces) {
    if (auto failure = take_failure(CallKind::MeshCreate)) {
        return *failure;
    }
    Mesh mesh;
    for (const MeshSurface& surface : surfaces) {
        mesh.triangles.push_back(triangle_count(surface));
    }
    const RID rid = meshes_.make(std::move(mesh));
    record(CallKind::MeshCreate, rid, {static_cast<int>(surfaces.size()), 1, 1}, 0,
           surfaces.empty() ? std::span<const uint8_t>{} : surfaces.front().vertices);
    return rid;
}

Expected<RID> DummyRasterizer::sky_create(const SkyDesc& sky) {
    if (auto failure = take_failure(CallKind::SkyCreate)) {
        return *failure;
    }
    const RID rid = skies_.make({});
    record(CallKind::SkyCreate, rid, {sky.size, 1}, 0,
           {reinterpret_cast<const uint8_t*>(sky.radiance.data()), sky.radiance.size() * sizeof(float)});
    return rid;
}

Expected<RID> DummyRasterizer::gi_volume_create(const GIVolumeDesc& desc) {
    if (auto failure = take_failure(CallKind::VolumeCreate)) {
        return *failure;
    }
    Volume volume;
    volume.desc = desc;
    for (int mip = 0; mip < desc.mip_count; ++mip) {
        const glm::ivec3 size = glm::max(desc.size >> mip, glm::ivec3(1));
        volume.mips.emplace_back(size_t{4} * size_t(size.x) * size_t(size.y) * size_t(size.z));
    }
    const RID rid = volumes_.make(std::move(volume));
    record(CallKind::VolumeCreate, rid, desc.size, desc.mip_count, {});
    return rid;
}

Status DummyRasterizer::gi_volume_upload(RID rid, int mip, glm::ivec3 offset, glm::ivec3 size,
                                         std::span<const uint8_t> rgba8) {
    if (auto failure = take_failure(CallKind::VolumeUpload)) {
        return *failure;
    }
    Volume* volume = volumes_.get(rid);
    if (!volume || mip < 0 || mip >= volume->desc.mip_count) {
        return stale("GI volume with that mip");
    }
    const glm::ivec3 whole = glm::max(volume->desc.size >> mip, glm::ivec3(1));
    const glm::ivec3 end = offset + size;
    if (glm::any(glm::lessThan(offset, glm::ivec3(0))) || glm::any(glm::greaterThan(end, whole)) ||
        rgba8.size() != size_t{4} * size_t(size.x) * size_t(size.y) * size_t(size.z)) {
        return stale("GI volume with room for that box"); // RasterizerChecked says it better
    }
    std::vector<uint8_t>& texels = volume->mips[static_cast<size_t>(mip)];
    const auto row_bytes = static_cast<std::ptrdiff_t>(4) * size.x;
    auto source = rgba8.begin();
    for (int z = offset.z; z < end.z; ++z) {
        for (int y = offset.y; y < end.y; ++y) {
            const auto at =
                static_cast<std::ptrdiff_t>(4) * ((std::ptrdiff_t{z} * whole.y + y) * whole.x + offset.x);
            std::copy(source, source + row_bytes, texels.begin() + at);
            source += row_bytes;
        }
    }
    record(CallKind::VolumeUpload, rid, size, mip, rgba8);
    return {};
}

Expected<RID> DummyRasterizer::gi_field_create(const GIFieldDesc& desc) {
    if (auto failure = take_failure(CallKind::FieldCreate)) {
        return *failure;
    }
    const RID rid = fields_.make({});
    record(CallKind::FieldCreate, rid, desc.air, 0, {});
    return rid;
}

Status DummyRasterizer::gi_field_upload(RID rid, std::span<const uint32_t> light,
                                        std::span<const uint16_t> air) {
    if (auto failure = take_failure(CallKind::FieldUpload)) {
        return *failure;
    }
    if (!fields_.get(rid)) {
        return stale("GI field");
    }
    std::vector<uint8_t> bytes;
    for (const std::span<const std::byte> part : {std::as_bytes(light), std::as_bytes(air)}) {
        std::transform(part.begin(), part.end(), std::back_inserter(bytes),
                       [](std::byte b) { return uint8_t(b); });
    }
    record(CallKind::FieldUpload, rid, {static_cast<int>(light.size()), 1, 1}, 0, bytes);
    return {};
}

Expected<RID> DummyRasterizer::target_create(glm::ivec2 size) {
    if (auto failure = take_failure(CallKind::TargetCreate)) {
        return *failure;
    }
    const RID rid = targets_.make({size, {}});
    record(CallKind::TargetCreate, rid, {size, 1}, 0, {});
    return rid;
}

Status DummyRasterizer::free(RID rid) {
    if (auto failure = take_failure(CallKind::Free)) {
        return *failure;
    }
    if (!textures_.free(rid) && !meshes_.free(rid) && !skies_.free(rid) && !volumes_.free(rid) &&
        !targets_.free(rid) && !fields_.free(rid)) {
        return stale("RID to free");
    }
    record(CallKind::Free, rid, {}, 0, {});
    return {};
}

Status DummyRasterizer::draw(RID rid, const Frame& frame) {
    if (auto failure = take_failure(CallKind::Draw)) {
        return *failure;
    }
    Target* target = rid ? targets_.get(rid) : &window_;
    if (!target) {
        return stale("target");
    }
    target->clear_color = frame.clear_color;
    if (!rid) {
        window_.size = frame.size;
    }
    stats_ = {};
    stats_.gpu_ms = cpu_frame_ms_;
    for (std::span<const DrawItem> items : {frame.opaque, frame.transparent}) {
        for (const DrawItem& item : items) {
            const Mesh* mesh = meshes_.get(item.mesh);
            const size_t surface = static_cast<size_t>(item.surface);
            if (!mesh || surface >= mesh->triangles.size()) {
                return stale("mesh with that surface");
            }
            ++stats_.draw_calls;
            stats_.triangles += mesh->triangles[surface];
        }
    }
    frame_.emplace(rid, frame);
    record(CallKind::Draw, rid,
           {static_cast<int>(frame.opaque.size() + frame.transparent.size()),
            static_cast<int>(frame.lights.size()), static_cast<int>(frame.gi_probes.size())},
           0, {});
    return {};
}

Expected<Image> DummyRasterizer::target_read(RID rid, TargetFormat format) {
    if (auto failure = take_failure(CallKind::TargetRead)) {
        return *failure;
    }
    const Target* target = rid ? targets_.get(rid) : &window_;
    if (!target) {
        return stale("target");
    }
    const Color color = target->clear_color;
    const size_t pixels = size_t(target->size.x) * size_t(target->size.y);
    Image image;
    image.size = target->size;
    if (format == TargetFormat::Srgb8) {
        image.format = PixelFormat::RGBA8;
        const uint8_t texel[4] = {to_byte(color.r), to_byte(color.g), to_byte(color.b), 255};
        for (size_t i = 0; i < pixels; ++i) {
            image.data.insert(image.data.end(), std::begin(texel), std::end(texel));
        }
    } else {
        image.format = PixelFormat::RGBF;
        const glm::vec3 linear = linear_from_srgb(color.rgb());
        const auto* bytes = reinterpret_cast<const uint8_t*>(&linear);
        for (size_t i = 0; i < pixels; ++i) {
            image.data.insert(image.data.end(), bytes, bytes + sizeof(linear));
        }
    }
    record(CallKind::TargetRead, rid, {image.size, 1}, 0, image.data);
    return image;
}

void DummyRasterizer::present() {
    record(CallKind::Present, {}, {}, 0, {});
}

size_t DummyRasterizer::count(CallKind kind) const noexcept {
    return static_cast<size_t>(
        std::count_if(calls_.begin(), calls_.end(), [kind](const Call& call) { return call.kind == kind; }));
}

LiveCounts DummyRasterizer::live() const noexcept {
    return {textures_.size(), meshes_.size(),  skies_.size(),
            volumes_.size(),  targets_.size(), fields_.size()};
}

std::vector<RID> DummyRasterizer::volumes() {
    std::vector<RID> rids;
    volumes_.for_each([&rids](RID rid, const Volume&) { rids.push_back(rid); });
    return rids;
}

std::span<const uint8_t> DummyRasterizer::volume_texels(RID rid, int mip) const noexcept {
    const Volume* volume = volumes_.get(rid);
    return volume && mip >= 0 && mip < volume->desc.mip_count ? volume->mips[static_cast<size_t>(mip)]
                                                              : std::span<const uint8_t>{};
}

const GIVolumeDesc* DummyRasterizer::volume_desc(RID rid) const noexcept {
    const Volume* volume = volumes_.get(rid);
    return volume ? &volume->desc : nullptr;
}

std::optional<TextureColorSpace> DummyRasterizer::texture_space(RID rid) const noexcept {
    const Texture* texture = textures_.get(rid);
    return texture ? std::optional(texture->space) : std::nullopt;
}

std::optional<Error> DummyRasterizer::take_failure(CallKind kind) {
    if (!failure_ || failure_->kind != kind) {
        return std::nullopt;
    }
    Error error = std::move(failure_->error);
    failure_.reset();
    return error;
}

void DummyRasterizer::record(CallKind kind, RID rid, glm::ivec3 size, int mip,
                             std::span<const uint8_t> bytes) {
    calls_.push_back({kind, rid, size, mip, hash_of(bytes)});
}

} // namespace cl::dummy
