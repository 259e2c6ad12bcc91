#include "scene/3d/spot_light.h"

#include "scene/resources/struct_properties.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void SpotLight::bind(ClassBuilder<SpotLight>& c) {
    c.doc("Light in a cone along the local -Z.");
    StructProperties<SpotLight, LightDesc> p(c, &SpotLight::desc, &SpotLight::set_desc);
    p.field("spot_range", &LightDesc::range_m)
        .doc("Distance at which the light ends [m].")
        .range("0,4096,0.1,or_greater")
        .default_value(5.0);
    p.field("spot_attenuation", &LightDesc::attenuation)
        .doc("Exponent of the fall-off (1 - distance / range).")
        .default_value(1.0);
    p.field("spot_angle", &LightDesc::spot_angle_deg)
        .doc("Half angle of the cone [degrees].")
        .range("0,180,0.1")
        .default_value(45.0);
    p.field("spot_angle_attenuation", &LightDesc::spot_angle_attenuation)
        .doc("Exponent of the fall-off towards the cone's rim.")
        .default_value(1.0);
}

SpotLight::SpotLight() : Light(LightType::Spot) {}

} // namespace cl::scene
