#pragma once

#include "scene/3d/light.h"

namespace cl::scene {

/// Light in a cone along the local -Z: a torch.
class SpotLight final : public Light {
public:
    static constexpr std::string_view kClassName = "SpotLight";
    static void bind(ClassBuilder<SpotLight>& c);
    SpotLight();
};

} // namespace cl::scene
