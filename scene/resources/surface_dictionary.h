#pragma once

#include "scene/resources/array_mesh.h"

#include "servers/mesh_surface.h"

#include "core/expected.h"
#include "core/variant/variant.h"

namespace cl::scene {

/// A surface as it stands in a scene file.
struct StoredSurface {
    MeshSurface surface;
    ArrayMesh::SurfaceExtras extras;
};

/// Reads the dictionary of a `surfaces/<i>` property: packed bytes (spec tscn section 9.1) or plain arrays
/// (9.2). The old layout with 6-byte half positions is widened to today's 8 bytes.
/// @return ParseError that names the key, what it must be and what it is. Counts are checked against the
/// bytes
///         that are there before anything is made of them.
[[nodiscard]] Expected<StoredSurface> surface_from_dictionary(const Dictionary& dictionary);

/// The packed form, as Godot writes it.
[[nodiscard]] Dictionary dictionary_from_surface(const MeshSurface& surface,
                                                 const ArrayMesh::SurfaceExtras& extras);

} // namespace cl::scene
