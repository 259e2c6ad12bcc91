#pragma once

#include "scene/3d/light.h"

namespace cl::scene {

/// Parallel light along the local -Z, from infinitely far away: the sun.
class DirectionalLight final : public Light {
public:
    static constexpr std::string_view kClassName = "DirectionalLight";
    static void bind(ClassBuilder<DirectionalLight>& c);
    DirectionalLight();
};

} // namespace cl::scene
