#include "drivers/gles3/light_sets.h"

#include "drivers/gles3/frame_block.h"
#include "drivers/gles3/omni_faces.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::gles3 {

namespace {

constexpr uint16_t kSeparator = 0xFFFFu;
constexpr size_t kMaxLocalLights = 8;

/// What look-ups in an omni's map need of its place.
void place_omni(shaders::LocalLight& out, const PlacedLocalShadow& shadow) noexcept {
    if (shadow.fit == ShadowFit::AsSet) {
        return; // two paraboloids fill the slot
    }
    const OmniFaces faces(shadow.rect);
    out.shadow_rect = faces.uv_tiles(shadow.atlas_size);
    out.shadow_near = local_shadow_near_m(shadow.fit, out.range);
    out.shadow_step = shadow.step_texels * faces.texel_at_one_metre();
}

} // namespace

glm::mat4 spot_clip_from_light(const LightDesc& light, ShadowFit fit) noexcept {
    CameraDesc camera;
    camera.fov_deg = 2.0f * light.spot_angle_deg;
    camera.near_m = local_shadow_near_m(fit, light.range_m);
    camera.far_m = std::max(light.range_m, 2.0f * camera.near_m);
    return projection_matrix(camera, glm::ivec2(1));
}

shaders::LocalLight make_local_light(const LightItem& light, const Transform& world_from_view,
                                     const std::optional<PlacedLocalShadow>& shadow) noexcept {
    const LightDesc& desc = *light.desc;
    const Transform view_from_world = world_from_view.inverse();
    const Transform view_from_light = view_from_world * light.world_from_light;
    shaders::LocalLight out;
    out.position = view_from_light.origin;
    out.range = desc.range_m;
    out.color = light_color(desc);
    out.attenuation = desc.attenuation;
    out.shadow_color = linear_from_srgb(desc.shadow_color.rgb());
    out.specular = desc.specular;
    out.axis = glm::normalize(view_from_light.basis[2]);
    out.cos_angle = std::cos(glm::radians(desc.spot_angle_deg));
    out.angle_attenuation = desc.spot_angle_attenuation;
    out.has_shadow = shadow.has_value();
    if (!shadow) {
        return out;
    }
    out.shadow_rect =
        glm::vec4(shadow->rect.position, shadow->rect.size) / static_cast<float>(shadow->atlas_size);
    const glm::mat4 light_from_view = view_from_light.inverse().to_mat4();
    if (desc.type == LightType::Omni) {
        out.shadow_from_view = light_from_view;
        place_omni(out, *shadow);
        return out;
    }
    const float edge_at_one_metre = 2.0f * std::tan(glm::radians(desc.spot_angle_deg));
    out.shadow_step = shadow->step_texels * (edge_at_one_metre / static_cast<float>(shadow->rect.size.x));
    glm::mat4 unit_from_clip(0.5f);
    unit_from_clip[3] = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    out.shadow_from_view = unit_from_clip * spot_clip_from_light(desc, shadow->fit) * light_from_view;
    return out;
}

int LightSets::set_of(const DrawItem& item) {
    const size_t omnis = std::min<size_t>(item.omni_count, kMaxLocalLights);
    const size_t spots = std::min<size_t>(item.spot_count, kMaxLocalLights);
    std::vector<uint16_t> key(item.omnis.begin(), item.omnis.begin() + static_cast<std::ptrdiff_t>(omnis));
    key.push_back(kSeparator);
    key.insert(key.end(), item.spots.begin(), item.spots.begin() + static_cast<std::ptrdiff_t>(spots));
    const auto [found, is_new] = known_.try_emplace(std::move(key), static_cast<int>(blocks_.size()));
    if (is_new) {
        shaders::LightSetBlock block;
        block.set_omni_count = static_cast<int>(omnis);
        block.set_spot_count = static_cast<int>(spots);
        for (size_t i = 0; i < omnis; ++i) {
            block.set_omnis[i] = lights_[item.omnis[i]];
        }
        for (size_t i = 0; i < spots; ++i) {
            block.set_spots[i] = lights_[item.spots[i]];
        }
        blocks_.push_back(block);
    }
    return found->second;
}

} // namespace cl::gles3
