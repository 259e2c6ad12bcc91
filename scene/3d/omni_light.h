#pragma once

#include "scene/3d/light.h"

namespace cl::scene {

/// Light in all directions from one point: a bulb.
class OmniLight final : public Light {
public:
    static constexpr std::string_view kClassName = "OmniLight";
    static void bind(ClassBuilder<OmniLight>& c);
    OmniLight();

    enum class ShadowDetail : uint8_t { Vertical, Horizontal };

private:
    ShadowDetail shadow_detail_ = ShadowDetail::Horizontal; // kept for saving, without effect
};

} // namespace cl::scene
