#include "servers/visual/material_storage.h"

#include "servers/visual/rid_kinds.h"

#include <algorithm>

namespace cl {
namespace {

const MaterialDesc& default_material() {
    static const MaterialDesc kDefault = [] {
        MaterialDesc desc;
        desc.is_default = true;
        return desc;
    }();
    return kDefault;
}

} // namespace

MaterialStorage::MaterialStorage(TextureStorage& textures, VersionClock& clock)
    : textures_(textures), clock_(clock), materials_(static_cast<uint32_t>(RIDKind::Material)) {}

RID MaterialStorage::make(const MaterialDesc& desc) {
    const RID rid = materials_.make({});
    set(rid, desc);
    return rid;
}

void MaterialStorage::set(RID rid, const MaterialDesc& desc) {
    Material* material = materials_.get(rid);
    CL_ASSERT(material, "set() of a material that is not live");
    count_uses(desc, +1);
    count_uses(material->desc, -1);
    material->desc = desc;
    material->version = clock_.tick();
    material->resolved_epoch = 0;
}

bool MaterialStorage::free(RID rid) {
    if (const Material* material = materials_.get(rid)) {
        count_uses(material->desc, -1);
        last_freed_ = clock_.tick();
    }
    return materials_.free(rid);
}

void MaterialStorage::count_uses(const MaterialDesc& desc, int delta) {
    for_each_texture(desc, [this, delta](RID texture, TextureColorSpace space) {
        textures_.count_use(texture, space, delta);
    });
}

MaterialStorage::Described MaterialStorage::describe_first(std::span<const RID> choices) const noexcept {
    for (RID rid : choices) {
        if (const Material* material = materials_.get(rid)) {
            return {&material->desc, std::max(material->version, last_freed_)};
        }
    }
    return {&default_material(), last_freed_};
}

MaterialStorage::Resolved MaterialStorage::resolve_first(std::span<const RID> choices, FirstError& errors) {
    for (RID rid : choices) {
        if (Material* material = materials_.get(rid)) {
            return {rid, &resolve(*material, errors), std::max(material->version, last_freed_)};
        }
    }
    return {{}, &default_material(), last_freed_};
}

const MaterialDesc& MaterialStorage::resolve(Material& material, FirstError& errors) {
    if (material.resolved_epoch != textures_epoch_) {
        material.resolved = material.desc;
        for_each_texture(material.resolved, [this, &errors](RID& texture, TextureColorSpace space) {
            texture = textures_.uploaded(texture, space, errors);
        });
        material.resolved_epoch = textures_epoch_;
    }
    return material.resolved;
}

} // namespace cl
