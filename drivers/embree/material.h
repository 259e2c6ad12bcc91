#pragma once

#include "drivers/embree/texture.h"

#include "servers/render_types.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <functional>

namespace cl::embree {

/// What vertices say of a point on a surface.
struct SurfaceCoordinates {
    glm::vec2 uv{0.0f}, uv2{0.0f};
    glm::vec4 color{1.0f}; ///< linear
};

/// A material ready to be asked about points: the twin of drivers/gles3/draw_block.cpp and
/// shaders/lib/material.glsl. Colours it gives are linear.
class Material {
public:
    using FindTexture = std::function<const Texture*(RID)>;
    /// Borrows the textures.
    Material(const MaterialDesc& desc, const FindTexture& find);

    [[nodiscard]] const MaterialDesc& desc() const noexcept { return desc_; }
    [[nodiscard]] DiffuseMode diffuse_mode() const noexcept { return diffuse_mode_; }
    [[nodiscard]] SpecularMode specular_mode() const noexcept { return specular_mode_; }

    /// True if rays may pass where the surface is.
    [[nodiscard]] bool has_holes() const noexcept { return desc_.alpha_scissor || desc_.transparent; }
    /// Share of rays that the surface stops, 0 to 1.
    [[nodiscard]] float opacity(const SurfaceCoordinates& at) const noexcept;

    [[nodiscard]] glm::vec3 albedo(const SurfaceCoordinates& at) const noexcept;
    [[nodiscard]] float metallic(const SurfaceCoordinates& at) const noexcept;
    [[nodiscard]] float roughness(const SurfaceCoordinates& at) const noexcept;
    [[nodiscard]] float ambient_occlusion(const SurfaceCoordinates& at) const noexcept;

    /// False if no point of it sends out light of its own.
    [[nodiscard]] bool emits() const noexcept;
    /// Radiance of its own. An unshaded surface sends out its albedo.
    [[nodiscard]] glm::vec3 emission(const SurfaceCoordinates& at) const noexcept;

    /// Slopes of a normal map in tangent space, unit length; none: the surface's own normal.
    [[nodiscard]] bool has_normal_map() const noexcept { return desc_.normal_enabled && normal_map_; }
    [[nodiscard]] glm::vec3 tangent_normal(const SurfaceCoordinates& at) const noexcept;

private:
    [[nodiscard]] glm::vec2 uv1(const SurfaceCoordinates& at) const noexcept;
    [[nodiscard]] glm::vec4 albedo_and_alpha(const SurfaceCoordinates& at) const noexcept;

    MaterialDesc desc_;
    DiffuseMode diffuse_mode_;
    SpecularMode specular_mode_;
    glm::vec4 albedo_;   ///< linear, straight alpha
    glm::vec3 emission_; ///< linear, energy not applied
    const Texture *albedo_map_, *metallic_map_, *roughness_map_, *emission_map_, *normal_map_, *ao_map_;
};

} // namespace cl::embree
