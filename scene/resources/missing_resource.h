#pragma once

#include "core/object/resource.h"

namespace cl::scene {

/// Stands in for a resource of a class that we do not have, or a file that we do not read (a script, a
/// sound): class_name() is the class in the file, and every property is kept to be written back.
class MissingResource final : public Resource {
public:
    static constexpr std::string_view kClassName = "MissingResource";
};

} // namespace cl::scene
