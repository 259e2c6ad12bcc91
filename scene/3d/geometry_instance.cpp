#include "scene/3d/geometry_instance.h"

#include "scene/3d/server_call.h"
#include "scene/resources/struct_properties.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void GeometryInstance::bind(ClassBuilder<GeometryInstance>& c) {
    c.doc("A node with a surface. Abstract.").abstract();
    c.property("material_override", &GeometryInstance::material_override,
               &GeometryInstance::set_material_override)
        .doc("Replaces the materials of all surfaces.")
        .default_value(Variant());
    c.property("cast_shadow", &GeometryInstance::cast_shadow, &GeometryInstance::set_cast_shadow)
        .doc("Whether and how it casts shadows.")
        .enumeration("Off,On,Double-Sided,Shadows Only")
        .default_value(1);
    c.property("extra_cull_margin", &GeometryInstance::extra_cull_margin,
               &GeometryInstance::set_extra_cull_margin)
        .doc("Grows the box for culling and pairing [m].")
        .range("0,16384,0.01")
        .default_value(0.0);
    c.property("use_in_baked_light", &GeometryInstance::use_in_baked_light,
               &GeometryInstance::set_use_in_baked_light)
        .doc("Included in GI bakes, and shaded with the probe's biases.")
        .default_value(false);
    StructProperties<GeometryInstance, LodRange> lod(c, &GeometryInstance::lod_range,
                                                     &GeometryInstance::set_lod_range);
    constexpr auto kDoc = "Kept for saving, without effect [m].";
    lod.field("lod_min_distance", &LodRange::min_distance_m).doc(kDoc).default_value(0.0);
    lod.field("lod_min_hysteresis", &LodRange::min_hysteresis_m).doc(kDoc).default_value(0.0);
    lod.field("lod_max_distance", &LodRange::max_distance_m).doc(kDoc).default_value(0.0);
    lod.field("lod_max_hysteresis", &LodRange::max_hysteresis_m).doc(kDoc).default_value(0.0);
}

void GeometryInstance::set_material_override(Ref<Material> material) {
    material_override_ = std::move(material);
    if (instance_rid()) {
        VisualServer& s = *server();
        tell(s.instance_set_material_override(instance_rid(),
                                              material_override_ ? material_override_->rid(s) : RID{}));
    }
}

SetResult GeometryInstance::set_cast_shadow(ShadowCasting casting) {
    if (casting > ShadowCasting::ShadowsOnly) {
        return SetResult::Refused;
    }
    cast_shadow_ = casting;
    if (instance_rid()) {
        tell(server()->instance_set_casting(instance_rid(), casting));
    }
    return SetResult::Done;
}

SetResult GeometryInstance::set_extra_cull_margin(float margin_m) {
    if (!(margin_m >= 0.0f)) {
        return SetResult::Refused;
    }
    extra_cull_margin_m_ = margin_m;
    if (instance_rid()) {
        tell(server()->instance_set_extra_margin(instance_rid(), margin_m));
    }
    return SetResult::Done;
}

void GeometryInstance::set_use_in_baked_light(bool on) {
    use_in_baked_light_ = on;
    if (instance_rid()) {
        tell(server()->instance_set_use_in_baked_light(instance_rid(), on));
    }
}

void GeometryInstance::describe_instance(VisualServer& server, RID instance) {
    VisualInstance::describe_instance(server, instance);
    tell(server.instance_set_material_override(instance,
                                               material_override_ ? material_override_->rid(server) : RID{}));
    tell(server.instance_set_casting(instance, cast_shadow_));
    tell(server.instance_set_extra_margin(instance, extra_cull_margin_m_));
    tell(server.instance_set_use_in_baked_light(instance, use_in_baked_light_));
}

} // namespace cl::scene
