#include "servers/visual/sky_storage.h"

#include "servers/visual/rid_kinds.h"

#include <utility>

namespace cl {

SkyStorage::SkyStorage(Rasterizer& rasterizer)
    : rasterizer_(rasterizer), skies_(static_cast<uint32_t>(RIDKind::Sky)) {}

RID SkyStorage::make(SkyDesc desc) {
    return skies_.make({std::move(desc), {}});
}

bool SkyStorage::free(RID rid) {
    const Sky* sky = skies_.get(rid);
    if (sky && sky->upload) {
        static_cast<void>(rasterizer_.free(sky->upload)); // a backend that lost it has nothing left to free
    }
    return skies_.free(rid);
}

RID SkyStorage::uploaded(RID rid, FirstError& errors) {
    Sky* sky = skies_.get(rid);
    if (!sky || !sky->desc) {
        return sky ? sky->upload : RID{};
    }
    Expected<RID> created = rasterizer_.sky_create(*sky->desc);
    sky->desc.reset(); // uploaded, or refused once and for all
    if (!created) {
        errors.note(created.error());
        return {};
    }
    return sky->upload = *created;
}

} // namespace cl
