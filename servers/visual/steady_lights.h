#pragma once

#include "servers/radiosity/lighting.h"
#include "servers/visual/rest.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cl {

/// Tells light of a scenario that keeps its place from light that moves: the first is worth solving apart.
class SteadyLights {
public:
    /// Says so in the lighting. What was there first is steady at once, all else kRestSteps after it came or
    /// moved; one lamp a call then, so that what changes next waits for one solution only. One thing that
    /// moves alone is as good as steady: it costs one solution either way, and coming to rest changes
    /// nothing.
    /// @param step  does not fall from call to call
    void mark(radiosity::Lighting& lighting, uint64_t step, Rest rest);

private:
    template <typename What>
    struct Seen {
        What what;
        uint64_t since = 0;
        bool steady = true;
    };
    std::vector<Seen<radiosity::Source>> lamps_; ///< without their radiance
    std::optional<Seen<std::vector<glm::vec3>>> sky_;
    bool is_first_ = true;
};

} // namespace cl
