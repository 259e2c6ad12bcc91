#include "scene/3d/omni_light.h"

#include "scene/resources/struct_properties.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void OmniLight::bind(ClassBuilder<OmniLight>& c) {
    c.doc("Light in all directions from one point.");
    StructProperties<OmniLight, LightDesc> p(c, &OmniLight::desc, &OmniLight::set_desc);
    p.field("omni_range", &LightDesc::range_m)
        .doc("Distance at which the light ends [m].")
        .range("0,4096,0.1,or_greater")
        .default_value(5.0);
    p.field("omni_attenuation", &LightDesc::attenuation)
        .doc("Exponent of the fall-off (1 - distance / range).")
        .default_value(1.0);
    p.choice("omni_shadow_mode", &LightDesc::omni_shadow_mode, "Dual Paraboloid,Cube")
        .doc("How the shadow map is drawn.")
        .default_value(1);
    c.property(
         "omni_shadow_detail", [](const OmniLight& o) { return o.shadow_detail_; },
         [](OmniLight& o, ShadowDetail detail) {
             if (detail > ShadowDetail::Horizontal) {
                 return SetResult::Refused;
             }
             o.shadow_detail_ = detail;
             return SetResult::Done;
         })
        .doc("Kept for saving, without effect.")
        .enumeration("Vertical,Horizontal")
        .default_value(1);
}

OmniLight::OmniLight() : Light(LightType::Omni) {}

} // namespace cl::scene
