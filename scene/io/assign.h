#pragma once

#include "core/diagnostics.h"
#include "core/expected.h"
#include "core/object/object.h"
#include "core/variant/variant_parser.h"

#include <string>
#include <string_view>

namespace cl::scene {

/// Assigns a value from a file to a property and judges what became of it:
///   unknown property        kept for saving; a warning, once for the class and property
///   value of a wrong type   an error; a warning if it is null or a resource of a class that we do not have
///   value out of range      an error if the object says why (ExplainsRefusal), else a warning
/// An object that stands in for a class that we do not have takes everything in silence, as does one with a
/// script.
/// @param assignment  gives the key and the places; its value is not looked at
/// @param value       with references resolved
[[nodiscard]] Status assign(Object& object, const TextAssignment& assignment, const Variant& value,
                            Diagnostics& diagnostics);

/// Keys that any node or resource may have and that mean nothing to us: `script`, `__meta__`, `_import_path`.
[[nodiscard]] bool is_bookkeeping(std::string_view key) noexcept;

// Each is said once for its class, or class and property.
void warn_unknown_property(const Object& object, const TextAssignment& assignment, Diagnostics& diagnostics);
void warn_unknown_node_class(const std::string& type, const SourceLocation& where, Diagnostics& diagnostics);
void warn_unknown_resource_class(const std::string& type, const SourceLocation& where,
                                 Diagnostics& diagnostics);

} // namespace cl::scene
