#include "tests/scene/property_laws.h"
#include "tests/scene/scene_fixture.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace cl;
using cl::tests::check_choice;
using cl::tests::Choice;
using cl::tests::own_stored_properties;
using cl::tests::register_types;

namespace {

struct Row {
    const char* name;
    Variant value; ///< of a fresh object
};

/// Rows in save order, from the property tables of spec scene-classes and gi-probe-data section 1.
struct Table {
    const char* class_name;
    const char* base;
    std::vector<Row> rows; ///< own properties that are stored
};

std::vector<Table> tables() {
    const Variant null;
    const Color white{1, 1, 1, 1};
    const Color black{0, 0, 0, 1};
    return {
        {"Node", "Object", {{"_import_path", NodePath()}, {"pause_mode", 0}, {"process_priority", 0}}},
        {"Spatial", "Node", {{"transform", Transform()}, {"visible", true}}},
        {"VisualInstance", "Spatial", {{"layers", 1}}},
        {"GeometryInstance",
         "VisualInstance",
         {{"material_override", null},
          {"cast_shadow", 1},
          {"extra_cull_margin", 0.0},
          {"use_in_baked_light", false},
          {"lod_min_distance", 0.0},
          {"lod_min_hysteresis", 0.0},
          {"lod_max_distance", 0.0},
          {"lod_max_hysteresis", 0.0}}},
        {"MeshInstance", "GeometryInstance", {{"mesh", null}, {"skin", null}, {"skeleton", NodePath("..")}}},
        {"Camera",
         "Spatial",
         {{"keep_aspect", 1},
          {"cull_mask", 1048575},
          {"environment", null},
          {"h_offset", 0.0},
          {"v_offset", 0.0},
          {"doppler_tracking", 0},
          {"projection", 0},
          {"current", false},
          {"fov", 70.0},
          {"size", 1.0},
          {"frustum_offset", glm::vec2(0)},
          {"near", 0.05f},
          {"far", 100.0}}},
        {"Light",
         "VisualInstance",
         {{"light_color", white},
          {"light_energy", 1.0},
          {"light_indirect_energy", 1.0},
          {"light_negative", false},
          {"light_specular", 0.5},
          {"light_bake_mode", 1},
          {"light_cull_mask", int64_t{4294967295}},
          {"shadow_enabled", false},
          {"shadow_color", black},
          {"shadow_bias", 0.15f},
          {"shadow_contact", 0.0},
          {"shadow_reverse_cull_face", false},
          {"editor_only", false}}},
        {"DirectionalLight",
         "Light",
         {{"directional_shadow_mode", 2},
          {"directional_shadow_split_1", 0.1f},
          {"directional_shadow_split_2", 0.2f},
          {"directional_shadow_split_3", 0.5f},
          {"directional_shadow_blend_splits", false},
          {"directional_shadow_normal_bias", 0.8f},
          {"directional_shadow_bias_split_scale", 0.25},
          {"directional_shadow_depth_range", 0},
          {"directional_shadow_max_distance", 100.0}}},
        {"OmniLight",
         "Light",
         {{"omni_range", 5.0},
          {"omni_attenuation", 1.0},
          {"omni_shadow_mode", 1},
          {"omni_shadow_detail", 1}}},
        {"SpotLight",
         "Light",
         {{"spot_range", 5.0},
          {"spot_attenuation", 1.0},
          {"spot_angle", 45.0},
          {"spot_angle_attenuation", 1.0}}},
        {"GIProbe",
         "VisualInstance",
         {{"subdiv", 1},
          {"extents", glm::vec3(10)},
          {"dynamic_range", 4},
          {"energy", 1.0},
          {"propagation", 0.7f},
          {"bias", 1.5},
          {"normal_bias", 0.0},
          {"interior", false},
          {"compress", false},
          {"data", null}}},
        {"WorldEnvironment", "Node", {{"environment", null}}},
    };
}

} // namespace

TEST_SUITE("scene/register_types") {
    TEST_CASE(
        "every class has the properties of its table, in save order, with their defaults and a sentence") {
        register_types();
        for (const Table& table : tables()) {
            CAPTURE(table.class_name);
            const ClassInfo* info = ClassRegistry::instance().find(table.class_name);
            REQUIRE(info != nullptr);
            REQUIRE(info->parent != nullptr);
            CHECK(info->parent->name.str() == table.base);
            CHECK(!info->doc.empty());
            const std::vector<const PropertyInfo*> own = own_stored_properties(*info);
            REQUIRE(own.size() == table.rows.size());
            for (size_t i = 0; i < own.size(); ++i) {
                CAPTURE(table.rows[i].name);
                CHECK(own[i]->name.str() == table.rows[i].name);
                CHECK(info->default_of(*own[i]) == table.rows[i].value);
                REQUIRE(own[i]->declared_default.has_value());
                CHECK(*own[i]->declared_default == table.rows[i].value);
                CHECK(!own[i]->doc.empty());
            }
        }
    }

    TEST_CASE("a directional light starts with a smaller shadow bias than other lights") {
        register_types();
        const ClassInfo* info = ClassRegistry::instance().find("DirectionalLight");
        REQUIRE(info != nullptr);
        const PropertyInfo* bias = info->find_property("shadow_bias");
        REQUIRE(bias != nullptr);
        CHECK(info->default_of(*bias) == Variant(0.1f));
    }

    TEST_CASE("a fresh node has nothing to save, and each property keeps what it is given") {
        register_types();
        for (const Table& table : tables()) {
            CAPTURE(table.class_name);
            const std::unique_ptr<Object> object = ClassRegistry::instance().create(table.class_name);
            if (!object) {
                continue; // abstract
            }
            CHECK(object->stored_properties().empty());
            for (const PropertyInfo* p : own_stored_properties(object->class_info())) {
                CAPTURE(p->name.str());
                CHECK(object->set(p->name, object->get(p->name)) == SetResult::Done);
                CHECK(object->set(p->name, Dictionary()) == SetResult::WrongType);
            }
            CHECK(object->stored_properties().empty());
        }
    }

    TEST_CASE("numbers beyond an enumeration are refused and the old one is kept") {
        register_types();
        const Choice kChoices[] = {
            {"MeshInstance", "cast_shadow"},
            {"Camera", "keep_aspect"},
            {"Camera", "projection"},
            {"DirectionalLight", "directional_shadow_mode"},
            {"OmniLight", "omni_shadow_mode"},
            {"OmniLight", "omni_shadow_detail"},
            {"SpotLight", "light_bake_mode"},
            {"GIProbe", "subdiv"},
            {"DirectionalLight", "directional_shadow_depth_range"},
        };
        for (const Choice& choice : kChoices) {
            check_choice(choice, {4, 256, int64_t{1} << 40}, 0);
        }
    }

    TEST_CASE("numbers that would break a projection, a box or a division are refused") {
        register_types();
        struct Case {
            const char* class_name;
            const char* property;
            double wrong;
        };
        for (const Case& c :
             {Case{"Camera", "fov", 0.5}, Case{"Camera", "fov", 180.0}, Case{"Camera", "fov", NAN},
              Case{"Camera", "size", 0.0}, Case{"MeshInstance", "extra_cull_margin", -1.0},
              Case{"GIProbe", "dynamic_range", 0.0}}) {
            CAPTURE(c.class_name);
            CAPTURE(c.property);
            const std::unique_ptr<Object> object = ClassRegistry::instance().create(c.class_name);
            REQUIRE(object != nullptr);
            const Variant before = object->get(c.property);
            CHECK(object->set(c.property, c.wrong) == SetResult::Refused);
            CHECK(object->get(c.property) == before);
        }
    }
}
