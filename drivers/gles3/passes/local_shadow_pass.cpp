#include "drivers/gles3/passes/local_shadow_pass.h"

#include "drivers/gles3/gl/state.h"
#include "drivers/gles3/omni_faces.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cl::gles3 {

namespace {

constexpr gl::SamplerDesc kCompareSampler{.filter = gl::Filter::Linear, .compare = gl::Compare::LessEqual};

bool casts_local_shadow(const LightItem& light, ShadowFit fit) noexcept {
    const LightDesc& d = *light.desc;
    // A spot of 90 degrees and more has no perspective that could hold its map.
    return d.shadow && d.range_m > 2.0f * local_shadow_near_m(fit, d.range_m) &&
           (d.type == LightType::Omni || (d.type == LightType::Spot && d.spot_angle_deg < 90.0f));
}

/// Longest edge of the box that a light reaches.
float reach_m(const LightItem& light) noexcept {
    const glm::vec3 size = transformed(light.world_from_light, light_bounds(*light.desc)).size;
    return std::max(size.x, std::max(size.y, size.z));
}

} // namespace

float light_coverage(const LightItem& light, const CameraDesc& camera, glm::ivec2 frame_size) noexcept {
    const LightDesc& d = *light.desc;
    // An omni's ball; of a spot, the disc where its cone ends.
    const float angle_rad = glm::radians(d.spot_angle_deg);
    const bool is_spot = d.type == LightType::Spot;
    const float radius_m = is_spot ? d.range_m * std::sin(angle_rad) : d.range_m;
    const float ahead_m = is_spot ? d.range_m * std::cos(angle_rad) : 0.0f;
    const glm::vec3 center = light.world_from_light.xform({0.0f, 0.0f, -ahead_m});
    const float depth_m = -camera.world_from_camera.inverse().xform(center).z;
    const glm::mat4 clip_from_view = projection_matrix(camera, frame_size);
    const float mean_half_extent = 0.5f / clip_from_view[0][0] + 0.5f / clip_from_view[1][1];
    const bool perspective = clip_from_view[2][3] != 0.0f;
    if (perspective && depth_m <= 0.0f) {
        return 1.0f;
    }
    return std::min(1.0f, radius_m / (mean_half_extent * (perspective ? depth_m : 1.0f)));
}

Status LocalShadowPass::prepare_atlas(int size) {
    if (atlas_ && atlas_->slots.size() == size) {
        return {};
    }
    drawn_.clear();
    atlas_.reset();
    Expected<gl::Texture2D> texture = gl::Texture2D::create({.size = {size, size},
                                                             .format = gl::Format::Depth24,
                                                             .sampler = kCompareSampler,
                                                             .label = "shadow atlas"});
    if (!texture) {
        return texture.error();
    }
    Expected<gl::Framebuffer> framebuffer =
        gl::Framebuffer::create({.depth = {&*texture}, .label = "shadow atlas"});
    if (!framebuffer) {
        return framebuffer.error();
    }
    atlas_.emplace(Atlas{*std::move(texture), *std::move(framebuffer), ShadowAtlas(size)});
    return {};
}

Status LocalShadowPass::draw_spot(const LightItem& light, const Drawn& now, const Resources& resources,
                                  CasterDraw& casters) {
    gl::Pass pass({.label = "spot shadow",
                   .target = &atlas_->framebuffer,
                   .viewport = now.rect,
                   .depth = gl::Load::Clear});
    const CasterView view{light.world_from_light.inverse(), spot_clip_from_light(*light.desc, now.fit),
                          now.bias.caster_m};
    return casters.draw(pass, light, view, resources);
}

Status LocalShadowPass::draw_faces(const LightItem& light, const Drawn& now, const Resources& resources,
                                   CasterDraw& casters) {
    const OmniFaces faces(now.rect);
    gl::Pass pass({.label = "omni shadow",
                   .target = &atlas_->framebuffer,
                   .viewport = faces.rect(),
                   .depth = gl::Load::Clear});
    const Transform light_from_world = light.world_from_light.inverse();
    const glm::mat4 clip_from_face = faces.clip_from_face(local_shadow_near_m(now.fit, light.desc->range_m));
    for (int face = 0; face < 6; ++face) {
        pass.set_viewport(faces.rect(face));
        const CasterView view{OmniFaces::face_from_light(face) * light_from_world, clip_from_face,
                              now.bias.caster_m};
        if (Status s = casters.draw(pass, light, view, resources); !s) {
            return s;
        }
    }
    return {};
}

Status LocalShadowPass::draw_light(const LightItem& light, const Drawn& now, const Resources& resources,
                                   CasterDraw& casters) {
    if (now.type == LightType::Spot) {
        return draw_spot(light, now, resources, casters);
    }
    if (now.fit == ShadowFit::ByTexel) {
        return draw_faces(light, now, resources, casters);
    }
    return paraboloids_.draw(atlas_->framebuffer, now.rect, light, now.bias.caster_m.x, resources, casters);
}

Expected<std::vector<std::optional<PlacedLocalShadow>>>
LocalShadowPass::draw(const Frame& frame, const Resources& resources, CasterDraw& casters) {
    std::vector<std::optional<PlacedLocalShadow>> placed(frame.lights.size());
    std::vector<ShadowAtlas::Request> requests;
    std::vector<size_t> owners; // light index by request
    const int limit = gl::State::current().capabilities().max_texture_size;
    const int atlas_size = std::clamp(frame.shadow_atlas_size, 0, limit);
    for (size_t i = 0; i < frame.lights.size(); ++i) {
        const LightItem& light = frame.lights[i];
        if (casts_local_shadow(light, frame.shadow_fit)) {
            const float coverage = light_coverage(light, frame.camera, frame.size);
            requests.push_back({light.key, wanted_slot_size(coverage, atlas_size), reach_m(light)});
            owners.push_back(i);
        }
    }
    if (requests.empty()) {
        return placed;
    }
    if (Status s = prepare_atlas(std::max(atlas_size, 1)); !s) {
        return s.error();
    }
    const std::vector<std::optional<gl::Rect>> slots = atlas_->slots.assign(requests);
    std::map<RID, Drawn> drawn;
    for (size_t i = 0; i < requests.size(); ++i) {
        if (!slots[i]) {
            continue;
        }
        const LightItem& light = frame.lights[owners[i]];
        const LightDesc& d = *light.desc;
        const ShadowBias bias = shadow_bias(frame, glm::vec2(d.shadow_bias_m, 0.0f));
        const Drawn now{*slots[i],
                        bias,
                        light.world_from_light,
                        light.casters_version,
                        d.range_m,
                        d.spot_angle_deg,
                        d.shadow_reverse_cull_face,
                        d.type,
                        frame.shadow_fit};
        const auto before = drawn_.find(light.key);
        if (before == drawn_.end() || !(before->second == now)) {
            if (Status s = draw_light(light, now, resources, casters); !s) {
                return s.error();
            }
        }
        drawn.emplace(light.key, now);
        placed[owners[i]] = {*slots[i], atlas_->slots.size(), bias.step_texels, frame.shadow_fit};
    }
    drawn_ = std::move(drawn); // what was not asked for has lost its slot
    return placed;
}

} // namespace cl::gles3
