#include "drivers/gles3/passes/tone_map_pass.h"

#include "drivers/gles3/gl/pass.h"

namespace cl::gles3 {

namespace {

using S = shaders::ToneMap;

uint32_t variant_of(const EnvironmentDesc& e) noexcept {
    const uint32_t adjust = e.adjustment_enabled ? S::kAdjust : 0u;
    switch (e.tone_mapper) {
    case ToneMapper::Linear:
        break;
    case ToneMapper::Reinhard:
        return adjust | S::kReinhard;
    case ToneMapper::Filmic:
        return adjust | S::kFilmic;
    case ToneMapper::Aces:
        return adjust | S::kAces;
    }
    return adjust;
}

} // namespace

Status ToneMapPass::draw(const RenderTarget& target, const Frame& frame, const Resources& resources) {
    // Without an environment radiance is shown as it is: the defaults of one change nothing either.
    const EnvironmentDesc environment = frame.has_environment ? frame.environment : EnvironmentDesc{};
    const auto program = programs_.get(variant_of(environment));
    if (!program) {
        return program.error();
    }
    (*program)->set(S::exposure, environment.exposure);
    (*program)->set(S::white, environment.white);
    (*program)->set(S::brightness_contrast_saturation,
                    glm::vec3(environment.brightness, environment.contrast, environment.saturation));
    (*program)->bind(S::radiance, target.radiance);
    gl::Pass pass({.label = "tone map", .target = &target.output, .colors = {gl::Load::DontCare}});
    pass.draw_fullscreen(**program, resources.no_vertices);
    return {};
}

} // namespace cl::gles3
