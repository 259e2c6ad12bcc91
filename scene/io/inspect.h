#pragma once

#include "core/diagnostics.h"
#include "core/expected.h"
#include "core/math/aabb.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cl::scene {

// What `conelight inspect` shows: plain data, in file order, and only what the file itself says.

/// Name and value, the value as the writer would save it; lists of more than kMaxShownText characters become
/// "<PoolByteArray, 52340 elements>".
using ShownProperties = std::vector<std::pair<std::string, std::string>>;
inline constexpr size_t kMaxShownText = 4096;

struct InspectedNode {
    std::string path;                ///< ".", "./Ball"
    std::optional<std::string> type; ///< none: an instance or an override
    std::vector<std::string> groups;
    std::optional<std::string> instance; ///< path of the scene
    std::optional<int64_t> index;
    ShownProperties properties;
};

struct InspectedConnection {
    std::string from, signal, to, method;
    int64_t flags = 2;
    std::string binds; ///< "[  ]"
};

struct InspectedResource {
    enum class Kind { Sub, Ext };
    Kind kind = Kind::Sub;
    int64_t id = 0;
    std::string type;
    std::optional<std::string> path; ///< of an ext resource
    ShownProperties properties;
};

struct InspectedProbe {
    glm::ivec3 size{0}; ///< [cells]
    uint32_t cells = 0, leaves = 0;
    int levels = 0;
    AABB bounds;        ///< [m]
    uint64_t bytes = 0; ///< of the cell data
};

struct Inspection {
    enum class Kind { Scene, Resource };
    Kind kind = Kind::Scene;
    std::string file;
    std::string type; ///< of a resource
    std::vector<Warning> warnings;
    std::vector<InspectedNode> nodes;
    std::vector<InspectedConnection> connections;
    std::vector<InspectedResource> resources;
    ShownProperties properties; ///< of a resource
    std::optional<InspectedProbe> probe;
};

/// Reads a text scene or resource. Other files that it refers to are not opened.
/// @return the error of reading it; ParseError if a node's parent cannot be, or if it is probe data that is
/// not valid.
[[nodiscard]] Expected<Inspection> inspect_file(const std::filesystem::path& file);

} // namespace cl::scene
