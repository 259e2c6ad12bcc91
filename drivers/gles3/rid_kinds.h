#pragma once

#include <cstdint>

namespace cl::gles3 {

/// Kinds for RID_Owner: a RID of one kind is refused by the owners of all others.
enum class RIDKind : uint32_t { Texture = 1, Mesh, Sky, GIVolume, Target, GIField };

} // namespace cl::gles3
