#pragma once

#include "servers/radiosity/links.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <unordered_map>

namespace cl::radiosity {

/// Links of points that see nothing but sky. What they see depends on where they face alone: points that face
/// the same way share one list, which therefore may be long: smooth where lists of their own would be
/// mottled, and read from the cache.
class OpenSkies {
public:
    explicit OpenSkies(Links& links) : links_(links) {}
    /// Appends a point that faces along `normal`. @param rays  number that its own list would have
    void append_point(const glm::vec3& normal, uint32_t rays);

private:
    Links& links_;
    std::unordered_map<uint32_t, Links::Point> shared_; ///< by packed normal
};

} // namespace cl::radiosity
