#pragma once

#include "scene/io/resource_link.h"

#include "core/expected.h"
#include "core/variant/variant.h"

#include <functional>

namespace cl::scene {

/// Gives the resource behind a link, or Nil.
using LinkResolver = std::function<Expected<Variant>(const ResourceLink& link)>;

/// A copy of `value` with every link in it, at any depth, replaced. Values without links are shared, not
/// copied.
[[nodiscard]] Expected<Variant> resolve_links(const Variant& value, const LinkResolver& resolver);

} // namespace cl::scene
