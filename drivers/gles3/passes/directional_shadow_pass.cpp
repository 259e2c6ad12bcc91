#include "drivers/gles3/passes/directional_shadow_pass.h"

#include "drivers/gles3/gl/state.h"

#include <algorithm>
#include <utility>

namespace cl::gles3 {

namespace {

constexpr gl::SamplerDesc kCompareSampler{.filter = gl::Filter::Linear, .compare = gl::Compare::LessEqual};

gl::Rect texels_of(const MapArea& area, const gl::Rect& within) noexcept {
    const glm::vec2 size(within.size);
    return {within.position + glm::ivec2(area.position * size), glm::ivec2(area.size * size)};
}

} // namespace

Status DirectionalShadowPass::prepare_map(int size) {
    if (map_ && map_->texture.size().x == size) {
        return {};
    }
    drawn_.clear();
    map_.reset();
    Expected<gl::Texture2D> texture = gl::Texture2D::create({.size = {size, size},
                                                             .format = gl::Format::Depth24,
                                                             .sampler = kCompareSampler,
                                                             .label = "directional shadows"});
    if (!texture) {
        return texture.error();
    }
    Expected<gl::Framebuffer> framebuffer =
        gl::Framebuffer::create({.depth = {&*texture}, .label = "directional shadows"});
    if (!framebuffer) {
        return framebuffer.error();
    }
    map_.emplace(Map{*std::move(texture), *std::move(framebuffer)});
    return {};
}

Status DirectionalShadowPass::draw_light(const LightItem& light, const Drawn& now, const Resources& resources,
                                         CasterDraw& casters) {
    const bool is_whole = now.area.size == map_->framebuffer.size();
    gl::Pass pass({.label = "directional shadow",
                   .target = &map_->framebuffer,
                   .viewport = is_whole ? std::nullopt : std::optional(now.area),
                   .depth = gl::Load::Clear});
    for (int i = 0; i < now.shadow.count; ++i) {
        const DirectionalSplit& split = now.shadow.splits[static_cast<size_t>(i)];
        pass.set_viewport(texels_of({split.tile, split.tile_size}, now.area));
        const CasterView view{now.shadow.light_from_world, now.shadow.clip_from_light(i),
                              split.bias.caster_m};
        if (Status s = casters.draw(pass, light, view, resources); !s) {
            return s;
        }
    }
    return {};
}

Expected<std::vector<PlacedDirectionalShadow>>
DirectionalShadowPass::draw(const Frame& frame, const Resources& resources, CasterDraw& casters) {
    const auto count = static_cast<size_t>(std::min(frame.directional_count, kMaxDirectionalLights));
    const std::span<const LightItem> lights = frame.lights.first(count);
    std::vector<PlacedDirectionalShadow> placed(count);
    const auto with_shadow = static_cast<int>(
        std::count_if(lights.begin(), lights.end(), [](const LightItem& l) { return l.desc->shadow; }));
    if (with_shadow == 0) {
        return placed;
    }
    const int limit = gl::State::current().capabilities().max_texture_size;
    const int size = std::clamp(frame.directional_shadow_size, 16, limit);
    if (Status s = prepare_map(size); !s) {
        return s.error();
    }
    std::vector<Drawn> drawn;
    for (size_t i = 0; i < count; ++i) {
        const LightItem& light = lights[i];
        if (!light.desc->shadow) {
            continue;
        }
        placed[i].area = directional_area(static_cast<int>(drawn.size()), with_shadow);
        placed[i].map_size = size;
        const gl::Rect area = texels_of(placed[i].area, {glm::ivec2(0), glm::ivec2(size)});
        placed[i].shadow = fit_directional_shadow(light, frame, area.size);
        const Drawn now{light.key, area, placed[i].shadow, light.casters_version,
                        light.desc->shadow_reverse_cull_face};
        if (std::find(drawn_.begin(), drawn_.end(), now) == drawn_.end()) {
            if (Status s = draw_light(light, now, resources, casters); !s) {
                return s.error();
            }
        }
        drawn.push_back(now);
    }
    drawn_ = std::move(drawn);
    return placed;
}

} // namespace cl::gles3
