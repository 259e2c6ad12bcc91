#pragma once

#include "core/image.h"

namespace cl {

/// An RGBA8 image whose transparent pixels (alpha below 20) have the colour of the nearest opaque one within
/// four pixels on each axis, so that filtering draws no seam of hidden colours; of equally near ones the
/// first in rows from the top. Alpha is kept. Images of other formats come back as they are. Source: what
/// Godot 3.2.3's importer makes of test images by `process/fix_alpha_border`, byte for byte.
[[nodiscard]] Image with_fixed_alpha_border(const Image& image);

} // namespace cl
