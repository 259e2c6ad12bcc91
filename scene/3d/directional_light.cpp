#include "scene/3d/directional_light.h"

#include "scene/resources/struct_properties.h"

#include "core/object/class_registry.h"

#include <array>

namespace cl::scene {

void DirectionalLight::bind(ClassBuilder<DirectionalLight>& c) {
    c.doc("Parallel light along the local -Z.");
    StructProperties<DirectionalLight, LightDesc> p(c, &DirectionalLight::desc, &DirectionalLight::set_desc);
    p.choice("directional_shadow_mode", &LightDesc::directional_mode,
             "Orthogonal,PSSM 2 Splits,PSSM 4 Splits")
        .doc("Into how many parts the shadow range is split.")
        .default_value(2);
    constexpr std::array<float, 3> kSplits{0.1f, 0.2f, 0.5f};
    for (size_t i = 0; i < kSplits.size(); ++i) {
        c.property(
             "directional_shadow_split_" + std::to_string(i + 1),
             [i](const DirectionalLight& o) { return o.desc().directional_splits[i]; },
             [i](DirectionalLight& o, float share) {
                 o.edit([&](LightDesc& d) { d.directional_splits[i] = share; });
             })
            .doc("Where the next part starts, as a share of the shadow range.")
            .range("0,1,0.001")
            .default_value(kSplits[i]);
    }
    p.field("directional_shadow_blend_splits", &LightDesc::directional_blend_splits)
        .doc("Parts fade into each other.")
        .default_value(false);
    p.field("directional_shadow_normal_bias", &LightDesc::directional_normal_bias)
        .doc("Moves shadow casters along their normals.")
        .range("0,16,0.01")
        .default_value(0.8);
    p.field("directional_shadow_bias_split_scale", &LightDesc::directional_bias_split_scale)
        .doc("How much the bias grows with the size of a part.")
        .range("0,1,0.01")
        .default_value(0.25);
    p.choice("directional_shadow_depth_range", &LightDesc::directional_depth_range, "Stable,Optimized")
        .doc("Whether the parts keep their size when the camera turns.")
        .default_value(0);
    p.field("directional_shadow_max_distance", &LightDesc::directional_max_distance_m)
        .doc("Distance from the camera up to which there are shadows [m].")
        .range("0,8192,0.1,or_greater")
        .default_value(100.0);
}

DirectionalLight::DirectionalLight() : Light(LightType::Directional) {
    edit([](LightDesc& d) { d.shadow_bias_m = 0.1f; });
}

} // namespace cl::scene
