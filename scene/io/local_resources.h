#pragma once

#include "core/object/resource.h"
#include "core/ref.h"
#include "core/variant/variant.h"

#include <unordered_map>

namespace cl::scene {

/// Gives one instance of a scene its own copies of the resources that say `resource_local_to_scene`, so that
/// changing one there leaves other instances as they are (spec tscn section 5).
class LocalResources {
public:
    /// `value` itself, unless it is such a resource: then this instance's copy of it.
    [[nodiscard]] Variant localized(const Variant& value);

private:
    std::unordered_map<const Resource*, Ref<Resource>> copies_;
};

} // namespace cl::scene
