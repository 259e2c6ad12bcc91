// VisualServer: textures, materials, meshes, lights, skies, environments and cameras.
#include "servers/visual/finite.h"
#include "servers/visual_server.h"
#include "servers/visual_server_impl.h"

#include "core/io/log.h"

#include <fmt/format.h>

namespace cl {
namespace {

bool is_whole(const Image& image) {
    const glm::ivec2 size = image.size;
    return size.x > 0 && size.y > 0 && size.x <= kMaxImageEdge && size.y <= kMaxImageEdge &&
           image.data.size() == size_t(size.x) * size_t(size.y) * size_t(bytes_per_pixel(image.format));
}

} // namespace

RID VisualServer::texture_create(Image image, const TextureParams& params) {
    return texture_create(std::make_shared<const Image>(std::move(image)), params);
}

RID VisualServer::texture_create(std::shared_ptr<const Image> image, const TextureParams& params) {
    if (!image || !is_whole(*image)) {
        static_cast<void>(edit().stale.refuse("texture_create: expected an image with all its pixels"));
        return {};
    }
    return edit().storage.textures.make(std::move(image), params);
}

Expected<glm::ivec2> VisualServer::texture_size(RID texture) const {
    if (!impl_->storage.textures.owns(texture)) {
        return impl_->stale.refuse("texture_size", "a texture", texture).error();
    }
    return impl_->storage.textures.size_of(texture);
}

RID VisualServer::material_create(const MaterialDesc& desc) {
    const RID material = edit().storage.materials.make({});
    static_cast<void>(
        material_set(material, desc)); // said in the log; the material stays as it is by default
    return material;
}

Status VisualServer::material_set(RID material, const MaterialDesc& desc) {
    if (!edit().storage.materials.owns(material)) {
        return edit().stale.refuse("material_set", "a material", material);
    }
    FirstError errors;
    for_each_texture(desc, [this, &errors](RID texture, TextureColorSpace) {
        errors.note(edit().check_or_null("material_set", "a texture", texture, edit().storage.textures));
    });
    if (errors.status().ok()) {
        edit().storage.materials.set(material, desc);
    }
    return errors.status();
}

Expected<RID> VisualServer::mesh_create(std::vector<MeshSurface> surfaces) {
    for (const MeshSurface& surface : surfaces) {
        if (Status valid = validate_surface(surface); !valid) {
            return valid.error();
        }
    }
    return edit().storage.meshes.make(std::move(surfaces));
}

Status VisualServer::mesh_surface_set_material(RID mesh, int surface, RID material) {
    const Mesh* found = edit().storage.meshes.get(mesh);
    if (!found) {
        return edit().stale.refuse("mesh_surface_set_material", "a mesh", mesh);
    }
    if (surface < 0 || static_cast<size_t>(surface) >= found->surfaces.size()) {
        return edit().stale.refuse(
            fmt::format("mesh_surface_set_material: expected a surface below {}, found {}",
                        found->surfaces.size(), surface));
    }
    if (Status live = edit().check_or_null("mesh_surface_set_material", "a material", material,
                                           edit().storage.materials);
        !live) {
        return live;
    }
    edit().storage.meshes.set_material(mesh, surface, material);
    return {};
}

RID VisualServer::light_create(const LightDesc& desc) {
    const RID light = edit().storage.lights.make({});
    static_cast<void>(light_set(light, desc)); // said in the log; the light stays as it is by default
    return light;
}

Status VisualServer::light_set(RID rid, const LightDesc& desc) {
    Light* light = edit().storage.lights.get(rid);
    if (!light) {
        return edit().stale.refuse("light_set", "a light", rid);
    }
    if (!is_finite(desc)) {
        return edit().stale.refuse(
            "light_set: expected finite colour, energies, range, attenuations and angle");
    }
    if (light->desc == desc) {
        return {};
    }
    light->desc = desc;
    light->version = edit().storage.clock.tick();
    edit().instances.base_changed(rid);
    return {};
}

RID VisualServer::sky_create(SkyDesc desc) {
    return edit().storage.skies.make(std::move(desc));
}

RID VisualServer::environment_create(const EnvironmentDesc& desc) {
    return edit().storage.environments.make(desc);
}

Status VisualServer::environment_set(RID rid, const EnvironmentDesc& desc) {
    EnvironmentDesc* environment = edit().storage.environments.get(rid);
    if (!environment) {
        return edit().stale.refuse("environment_set", "an environment", rid);
    }
    if (Status live = edit().check_or_null("environment_set", "a sky", desc.sky, edit().storage.skies);
        !live) {
        return live;
    }
    *environment = desc;
    return {};
}

RID VisualServer::camera_create(const CameraDesc& desc) {
    const RID camera = edit().storage.cameras.make({});
    static_cast<void>(camera_set(camera, desc)); // said in the log; the camera stays as it is by default
    return camera;
}

Status VisualServer::camera_set(RID rid, const CameraDesc& desc) {
    CameraDesc* camera = edit().storage.cameras.get(rid);
    if (!camera) {
        return edit().stale.refuse("camera_set", "a camera", rid);
    }
    if (!is_finite(desc.world_from_camera)) {
        return edit().stale.refuse("camera_set: expected a transform of finite numbers");
    }
    if (Status live = edit().check_or_null("camera_set", "an environment", desc.environment,
                                           edit().storage.environments);
        !live) {
        return live;
    }
    *camera = desc;
    return {};
}

} // namespace cl
