#include "scene/3d/light.h"

#include "scene/3d/server_call.h"
#include "scene/resources/struct_properties.h"

#include "servers/visual_server.h"

#include "core/object/class_registry.h"

namespace cl::scene {

void Light::bind(ClassBuilder<Light>& c) {
    c.doc("A light. Abstract.");
    StructProperties<Light, LightDesc> p(c, &Light::desc, &Light::set_desc);
    p.field("light_color", &LightDesc::color)
        .doc("Colour, sRGB; linear for direct light, its numbers as they are for GI.")
        .default_value(Color{1, 1, 1, 1});
    p.field("light_energy", &LightDesc::energy)
        .doc("Factor on the colour: 1 lights a white surface facing it to 1.")
        .range("0,16,0.01,or_greater")
        .default_value(1.0);
    p.field("light_indirect_energy", &LightDesc::indirect_energy)
        .doc("Further factor for GI.")
        .range("0,16,0.01,or_greater")
        .default_value(1.0);
    p.field("light_negative", &LightDesc::negative).doc("Takes direct light away.").default_value(false);
    p.field("light_specular", &LightDesc::specular)
        .doc("Factor on the direct specular reflection.")
        .range("0,1,0.01")
        .default_value(0.5);
    p.choice("light_bake_mode", &LightDesc::bake_mode, "Disable,Indirect,All")
        .doc("Whether it takes part in GI; Indirect and All are the same for a GIProbe.")
        .default_value(1);
    p.field("light_cull_mask", &LightDesc::cull_mask)
        .doc("Bit mask of the layers that are lit; not for GI and shadow casters.")
        .hint(PropertyHint::Flags, "32 layers")
        .default_value(int64_t{4294967295});
    p.field("shadow_enabled", &LightDesc::shadow).doc("Casts shadows in direct light.").default_value(false);
    p.field("shadow_color", &LightDesc::shadow_color)
        .doc("Share of the light that is left in a shadow, sRGB.")
        .default_value(Color{0, 0, 0, 1});
    p.field("shadow_bias", &LightDesc::shadow_bias_m)
        .doc("Distance by which shadows start behind their caster [m].")
        .range("-10,10,0.01")
        .default_value(0.15);
    p.field("shadow_contact", &LightDesc::shadow_contact_m)
        .doc("Length of screen-space contact shadows [m]; 0: none.")
        .default_value(0.0);
    p.field("shadow_reverse_cull_face", &LightDesc::shadow_reverse_cull_face)
        .doc("Back faces cast the shadows.")
        .default_value(false);
    c.property("editor_only", &Light::is_editor_only, &Light::set_editor_only)
        .doc("Lights nothing in a running program.")
        .default_value(false);
}

Light::Light(LightType type) {
    desc_.type = type;
    ignore_scale();
}

void Light::set_desc(const LightDesc& desc) {
    const LightType type = desc_.type;
    desc_ = desc;
    desc_.type = type;
    if (rid_.get()) {
        tell(server()->light_set(rid_.get(), desc_));
    }
}

void Light::set_editor_only(bool on) {
    editor_only_ = on;
    show_or_hide();
}

RID Light::base_rid(VisualServer& server) {
    if (!rid_.in(server)) {
        rid_.adopt(server, server.light_create(desc_));
    }
    return rid_.get();
}

bool Light::is_shown() const {
    return !editor_only_ && VisualInstance::is_shown();
}

void Light::notification(Notification what) {
    VisualInstance::notification(what);
    if (what == Notification::ExitTree) {
        rid_.reset();
    }
}

} // namespace cl::scene
