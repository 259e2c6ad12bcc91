#pragma once

#include "servers/render_types.h"
#include "servers/visual/first_error.h"
#include "servers/visual/texture_storage.h"
#include "servers/visual/version_clock.h"

#include "core/rid.h"

#include <cstdint>
#include <span>

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

    /// The first live material of `choices` as the scene describes it, with the server's textures, and its
    /// version; the default where none is live. Good until the next make() or set().
    struct Described {
        const MaterialDesc* desc = nullptr; ///< never null
        uint64_t version = 0;
    };
    [[nodiscard]] Described describe_first(std::span<const RID> choices) const noexcept;

    /// A material ready to draw with. Good until the next make() or set().
    struct Resolved {
        RID rid;                            ///< null: the default material
        const MaterialDesc* desc = nullptr; ///< never null from resolve_first()
        uint64_t version = 0; ///< another when another material, or other parameters, may result
    };
    /// The first live material of `choices`, or what is drawn where no material is set at all. Uploads its
    /// textures if they are not yet.
    Resolved resolve_first(std::span<const RID> choices, FirstError& errors);

private:
    struct Material {
        MaterialDesc desc;     ///< the server's texture RIDs
        MaterialDesc resolved; ///< the rasteriser's
        uint64_t version = 0;
        uint64_t resolved_epoch = 0; ///< 0: not resolved
    };
    const MaterialDesc& resolve(Material& material, FirstError& errors);
    void count_uses(const MaterialDesc& desc, int delta);

    TextureStorage& textures_;
    VersionClock& clock_;
    RID_Owner<Material> materials_;
    uint64_t textures_epoch_ = 1;
    uint64_t last_freed_ = 0; ///< version at which a choice may have fallen through to the next
};

} // namespace cl
