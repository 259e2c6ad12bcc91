#pragma once

#include "core/rid.h"
#include "servers/render_types.h"
#include "servers/visual/first_error.h"
#include "servers/visual/texture_storage.h"
#include "servers/visual/version_clock.h"

#include <cstdint>

namespace cl {

/// Materials as the scene describes them, and as the rasteriser wants them: with its own textures' RIDs.
class MaterialStorage {
public:
    MaterialStorage(TextureStorage& textures, VersionClock& clock);

    RID make(const MaterialDesc& desc);
    /// `material` must be live.
    void set(RID material, const MaterialDesc& desc);
    bool free(RID material);
    [[nodiscard]] bool owns(RID material) const noexcept { return materials_.owns(material); }
    [[nodiscard]] size_t size() const noexcept { return materials_.size(); }
    /// To be called when a texture was freed: materials forget what they resolved it to.
    void forget_resolved() noexcept { ++textures_epoch_; }

    /// A material ready to draw with. Good until the next make() or set().
    struct Resolved {
        const MaterialDesc* desc = nullptr; ///< null: not a material
        uint64_t version = 0;
    };
    /// Uploads the textures that are not yet.
    Resolved resolved(RID material, FirstError& errors);
    /// What is drawn with where no material is set at all.
    [[nodiscard]] static const MaterialDesc& default_material() noexcept;

private:
    struct Material {
        MaterialDesc desc;           ///< the server's texture RIDs
        MaterialDesc resolved;       ///< the rasteriser's
        uint64_t version = 0;
        uint64_t resolved_epoch = 0; ///< 0: not resolved
    };
    void count_uses(const MaterialDesc& desc, int delta);

    TextureStorage& textures_;
    VersionClock& clock_;
    RID_Owner<Material> materials_;
    uint64_t textures_epoch_ = 1;
};

} // namespace cl
