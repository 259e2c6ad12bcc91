#pragma once

#include "scene/resources/server_rid.h"

#include "servers/gi/voxelizer.h"
#include "servers/render_types.h"

#include "core/object/resource.h"
#include "core/ref.h"

#include <memory>

namespace cl::scene {

/// What a GI bake reads of a material: the input of gi::capture_material() and the images it points into.
struct BakeMaterial {
    gi::CaptureInput input;                      ///< default: white, no emission (spec gi-bake section 3)
    std::shared_ptr<const Image> albedo_image;   ///< keeps input.albedo_texture alive
    std::shared_ptr<const Image> emission_image; ///< keeps input.emission_texture alive
};

/// How a surface reflects and emits light. Abstract.
class Material : public Resource {
public:
    static constexpr std::string_view kClassName = "Material";
    static void bind(ClassBuilder<Material>& c);

    [[nodiscard]] int render_priority() const noexcept { return render_priority_; }
    SetResult
    set_render_priority(int priority); ///< -128..127, later draws over earlier among transparent ones
    [[nodiscard]] const Ref<Material>& next_pass() const noexcept { return next_pass_; }
    /// Stored; further passes are not drawn. Refused if it would make a cycle.
    SetResult set_next_pass(Ref<Material> material);

    /// The material as the server takes it; textures become RIDs of `server`.
    [[nodiscard]] virtual MaterialDesc describe(VisualServer& server) const = 0;
    /// What the GI bake reads. Materials other than SpatialMaterial are white.
    [[nodiscard]] virtual BakeMaterial bake_material() const { return {}; }

    /// The material in `server`, made on the first call; later changes go to the same RID.
    [[nodiscard]] RID rid(VisualServer& server) const;

protected:
    /// Passes the change on to the server and tells the users.
    void material_changed();

private:
    int render_priority_ = 0;
    Ref<Material> next_pass_;
    mutable ServerRID rid_;
};

/// A material with shader code of its own. Stored and written back; drawn and baked as plain white.
class ShaderMaterial final : public Material {
public:
    static constexpr std::string_view kClassName = "ShaderMaterial";
    static void bind(ClassBuilder<ShaderMaterial>& c);

    [[nodiscard]] MaterialDesc describe(VisualServer& server) const override;

    [[nodiscard]] const Ref<Resource>& shader() const noexcept { return shader_; }
    void set_shader(Ref<Resource> shader) { shader_ = std::move(shader); }

protected:
    SetResult set_dynamic(const StringName& property, const Variant& value) override;
    bool get_dynamic(const StringName& property, Variant& value) const override;
    void list_dynamic(std::vector<PropertyValue>& out) const override;

private:
    Ref<Resource> shader_;
    std::vector<PropertyValue> parameters_; ///< `shader_param/<name>`, in order of first assignment
};

} // namespace cl::scene
