#include "drivers/gles3/gi_field_storage.h"

#include <glm/common.hpp>

#include <algorithm>
#include <vector>

namespace cl::gles3 {

namespace {

/// As large or a little larger. llvmpipe compiles a shader again for textures whose sizes are powers of two
/// if those before were not: with sizes that never are, the shaders that the empty field was drawn with are
/// the ones that real fields need. Large sizes stay: drivers have their limits.
int no_power_of_two(int size) noexcept {
    const bool is_power = (size & (size - 1)) == 0;
    return size < 3 ? 3 : (is_power && size < 1024 ? size + 1 : size);
}

/// A list as a texture of full rows; about as few rows as hold it.
Expected<gl::Texture2D> make_list(gl::Format format, size_t entries, std::string_view label) {
    const int rows = no_power_of_two(static_cast<int>((entries + kFieldRow - 1) / kFieldRow));
    return gl::Texture2D::create({.size = {kFieldRow, rows},
                                  .format = format,
                                  .sampler = {.filter = gl::Filter::Nearest},
                                  .label = label});
}

/// Uploads whole rows, then what is left.
Status fill_list(gl::Texture2D& list, std::span<const uint32_t> words, size_t words_per_entry) {
    const size_t row_words = kFieldRow * words_per_entry;
    const int rows = static_cast<int>(words.size() / row_words);
    if (rows > 0) {
        const auto whole = words.first(static_cast<size_t>(rows) * row_words);
        if (Status s = list.upload(0, {0, 0}, {kFieldRow, rows}, std::as_bytes(whole)); !s) {
            return s;
        }
    }
    const auto rest = words.subspan(static_cast<size_t>(rows) * row_words);
    const int entries = static_cast<int>(rest.size() / words_per_entry);
    return entries > 0 ? list.upload(0, {0, rows}, {entries, 1}, std::as_bytes(rest)) : Status{};
}

Expected<StoredField> make_field(const GIFieldDesc& desc) {
    const size_t slots = desc.joints.size() / 2;
    Expected<gl::Texture2D> bricks =
        make_list(gl::Format::RGBA32UI, desc.brick_words.size() / 4, "GI bricks");
    if (!bricks) {
        return bricks.error();
    }
    Expected<gl::Texture2D> joints = make_list(gl::Format::RG32UI, slots, "GI joints");
    if (!joints) {
        return joints.error();
    }
    Expected<gl::Texture2D> light = make_list(gl::Format::RGB9E5, slots, "GI light");
    if (!light) {
        return light.error();
    }
    const glm::ivec3 air_size(no_power_of_two(desc.air.x), no_power_of_two(desc.air.y),
                              no_power_of_two(desc.air.z));
    Expected<gl::Texture3D> air = gl::Texture3D::create({.size = air_size,
                                                         .format = gl::Format::RGBA16F,
                                                         .sampler = {.filter = gl::Filter::Linear},
                                                         .label = "GI air"});
    if (!air) {
        return air.error();
    }
    StoredField field{*std::move(bricks), *std::move(joints), *std::move(light),
                      *std::move(air),    desc.air,           slots};
    if (Status s = fill_list(field.bricks, desc.brick_words, 4); !s) {
        return s.error();
    }
    if (Status s = fill_list(field.joints, desc.joints, 2); !s) {
        return s.error();
    }
    return field;
}

} // namespace

Expected<GIFieldStorage> GIFieldStorage::create() {
    Expected<StoredField> empty = make_field({.brick_words = {}, .joints = {}, .air = glm::ivec3(1)});
    if (!empty) {
        return empty.error();
    }
    return GIFieldStorage(*std::move(empty));
}

Expected<RID> GIFieldStorage::create(const GIFieldDesc& desc) {
    Expected<StoredField> field = make_field(desc);
    if (!field) {
        return field.error();
    }
    // Contents are undefined until written.
    const std::vector<uint32_t> dark(field->slots, 0u);
    const std::vector<uint16_t> dark_air(static_cast<size_t>(desc.air.x) * static_cast<size_t>(desc.air.y) *
                                         static_cast<size_t>(desc.air.z) * 4);
    const RID rid = fields_.make(*std::move(field));
    if (Status s = upload(rid, dark, dark_air); !s) {
        fields_.free(rid);
        return s.error();
    }
    return rid;
}

Status GIFieldStorage::upload(RID rid, std::span<const uint32_t> light, std::span<const uint16_t> air) {
    StoredField* field = fields_.get(rid);
    if (!field) {
        return Error{ErrorCode::InvalidArgument,
                     "GI field: expected a live field, found a stale or foreign RID"};
    }
    if (Status s = fill_list(field->light, light, 1); !s) {
        return s;
    }
    return field->air.upload(0, glm::ivec3(0), field->air_size, std::as_bytes(air));
}

} // namespace cl::gles3
