#include "servers/visual/still_items.h"

#include "core/math/color.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace cl {
namespace {

std::array<RID, 3> material_choices(const Instance& instance, const Mesh& mesh, size_t surface) noexcept {
    const RID own = surface < instance.surface_materials.size() ? instance.surface_materials[surface] : RID{};
    return {instance.material_override, own, mesh.surfaces[surface].material};
}

/// Farther away nothing is lit that anyone sees, and areas and distances would not be finite.
bool is_in_reach(const glm::vec3& v) noexcept {
    constexpr float kReach_m = 1e9f;
    return std::abs(v.x) < kReach_m && std::abs(v.y) < kReach_m && std::abs(v.z) < kReach_m;
}

/// Colours of a file may be anything.
glm::vec3 sane(const glm::vec3& radiance) noexcept {
    constexpr float kMost = 1e6f;
    glm::vec3 out;
    for (int i = 0; i < 3; ++i) {
        out[i] = radiance[i] > 0.0f ? std::min(radiance[i], kMost) : 0.0f; // 0 for NaN
    }
    return out;
}

/// Corners of triangles, three each, whatever way the surface lists them.
std::vector<uint32_t> triangle_corners(const SurfaceArrays& arrays, PrimitiveType primitive) {
    std::vector<uint32_t> listed = arrays.indices;
    if (listed.empty()) {
        for (uint32_t i = 0; i < arrays.positions.size(); ++i) {
            listed.push_back(i);
        }
    }
    if (primitive == PrimitiveType::Triangles) {
        listed.resize(listed.size() / 3 * 3);
        return listed;
    }
    std::vector<uint32_t> corners;
    const bool is_strip = primitive == PrimitiveType::TriangleStrip;
    if (is_strip || primitive == PrimitiveType::TriangleFan) {
        for (size_t i = 2; i < listed.size(); ++i) {
            const uint32_t a = is_strip ? listed[i - 2] : listed[0], b = listed[i - 1], c = listed[i];
            const bool turned = is_strip && i % 2 == 1;
            corners.insert(corners.end(), {turned ? b : a, turned ? a : b, c});
        }
    }
    return corners;
}

class SceneMaker {
public:
    void add(const StillItem& item) {
        // Front faces are clockwise; a mirroring transform turns them over once more.
        const bool mirrored = glm::determinant(item.world_from_local.basis) < 0.0f;
        for (size_t i = 0; i < item.surfaces.size() && i < item.mesh->size(); ++i) {
            const StillItem::Surface& surface = item.surfaces[i];
            const Expected<SurfaceArrays> arrays = decode_surface((*item.mesh)[i]);
            if (!arrays || !is_solid(surface.material)) {
                continue;
            }
            const bool front_culled = surface.material.cull_mode == CullMode::Front;
            add_surface(*arrays, (*item.mesh)[i].primitive, item.world_from_local, mirrored != front_culled,
                        add_material(surface));
        }
    }
    radiosity::StillScene take() { return std::move(scene_); }

private:
    void add_surface(const SurfaceArrays& arrays, PrimitiveType primitive, const Transform& world_from_local,
                     bool keep_order, uint32_t surface) {
        const uint32_t first = uint32_t(scene_.positions.size());
        for (const glm::vec3& p : arrays.positions) {
            scene_.positions.push_back(world_from_local.xform(p));
        }
        for (size_t i = 0; i < arrays.positions.size(); ++i) {
            scene_.uvs.push_back(i < arrays.uvs.size() ? arrays.uvs[i] : glm::vec2(0.0f));
        }
        const std::vector<uint32_t> corners = triangle_corners(arrays, primitive);
        for (size_t i = 0; i + 2 < corners.size(); i += 3) {
            const uint32_t a = first + corners[i], b = first + corners[i + 1], c = first + corners[i + 2];
            if (is_in_reach(scene_.positions[a]) && is_in_reach(scene_.positions[b]) &&
                is_in_reach(scene_.positions[c])) {
                scene_.triangles.push_back(keep_order ? glm::uvec3(a, b, c) : glm::uvec3(a, c, b));
                scene_.surface_of.push_back(surface);
            }
        }
        for (uint32_t i = first; i < scene_.positions.size(); ++i) {
            if (!is_in_reach(scene_.positions[i])) {
                scene_.positions[i] = glm::vec3(0.0f); // no triangle uses it, but libraries would read it
            }
        }
    }

    uint32_t add_material(const StillItem::Surface& in) {
        const MaterialDesc& m = in.material;
        radiosity::Surface out;
        out.albedo = sane(linear_from_srgb(m.albedo.rgb()));
        out.albedo_map = map(in.albedo_map);
        out.uv_scale = glm::vec2(m.uv1_scale);
        out.uv_offset = glm::vec2(m.uv1_offset);
        out.two_sided = m.cull_mode == CullMode::Disabled;
        out.alpha_cutoff = m.alpha_scissor ? m.alpha_scissor_threshold : 0.0f;
        if (m.emission_enabled) {
            out.emission = sane(linear_from_srgb(m.emission.rgb()) * m.emission_energy);
            out.emission_energy = sane(glm::vec3(m.emission_energy)).x;
            out.emission_multiplies = m.emission_operator == EmissionOperator::Multiply;
            out.emission_map = m.emission_texture ? map(in.emission_map) : nullptr;
            // A missing texture is black: multiplied by it, nothing is left.
            out.emission = out.emission_multiplies && !m.emission_texture ? glm::vec3(0.0f) : out.emission;
        }
        scene_.surfaces.push_back(std::move(out));
        return uint32_t(scene_.surfaces.size() - 1);
    }

    std::shared_ptr<const radiosity::ColorMap> map(const std::shared_ptr<const Image>& image) {
        if (!image) {
            return nullptr;
        }
        std::shared_ptr<const radiosity::ColorMap>& known = maps_[image.get()];
        if (!known) {
            known = std::make_shared<const radiosity::ColorMap>(*image);
        }
        return known;
    }

    radiosity::StillScene scene_;
    std::map<const Image*, std::shared_ptr<const radiosity::ColorMap>> maps_;
};

} // namespace

bool is_solid(const MaterialDesc& material) noexcept {
    return !material.is_transparent();
}

uint64_t look_of(const Storage& storage, const Instance& instance) noexcept {
    const Mesh* mesh = storage.meshes.get(instance.base);
    uint64_t newest = std::max(instance.version, mesh ? mesh->version : 0);
    for (size_t i = 0; mesh && i < mesh->surfaces.size(); ++i) {
        newest =
            std::max(newest, storage.materials.describe_first(material_choices(instance, *mesh, i)).version);
    }
    return newest;
}

namespace {

template <typename Test>
bool any_material(const Storage& storage, const Instance& instance, const Test& test) noexcept {
    const Mesh* mesh = storage.meshes.get(instance.base);
    for (size_t i = 0; mesh && i < mesh->surfaces.size(); ++i) {
        if (test(*storage.materials.describe_first(material_choices(instance, *mesh, i)).desc)) {
            return true;
        }
    }
    return false;
}

} // namespace

bool is_glossy(const Storage& storage, const Instance& instance) noexcept {
    return any_material(storage, instance, [](const MaterialDesc& m) { return m.is_glossy(); });
}

bool reads_air(const Storage& storage, const Instance& instance, bool is_still) noexcept {
    return instance.casting != ShadowCasting::ShadowsOnly &&
           any_material(storage, instance, [is_still](const MaterialDesc& m) {
               const bool is_bent = m.normal_enabled && m.normal_texture;
               return !m.unshaded && (!is_still || !is_solid(m) || is_bent);
           });
}

StillItem describe_still(const Storage& storage, RID rid, const Instance& instance) {
    StillItem item{rid, instance.version, look_of(storage, instance), instance.world_from_local, {}, {}};
    const Mesh* mesh = storage.meshes.get(instance.base);
    if (!mesh) {
        return item;
    }
    item.mesh = mesh->vertices;
    for (size_t i = 0; i < mesh->surfaces.size(); ++i) {
        const MaterialDesc& m = *storage.materials.describe_first(material_choices(instance, *mesh, i)).desc;
        item.surfaces.push_back(
            {m, storage.textures.image(m.albedo_texture), storage.textures.image(m.emission_texture)});
    }
    return item;
}

radiosity::StillScene make_still_scene(std::span<const StillItem> items) {
    SceneMaker maker;
    for (const StillItem& item : items) {
        if (item.mesh) {
            maker.add(item);
        }
    }
    return maker.take();
}

} // namespace cl
