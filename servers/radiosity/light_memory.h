#pragma once

#include "servers/radiosity/direct_light.h"
#include "servers/radiosity/kept.h"
#include "servers/radiosity/light_parts.h"

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace cl::radiosity {

/// Light of one transport, taken apart and kept, so that a change costs what it changes: that of a lamp's
/// colour or energy only sums. They run in the order of the lighting: the same numbers whatever was kept.
class LightMemory {
public:
    /// Light that has bounced.
    struct Bounced {
        std::vector<Rgb4> arriving; ///< one a record
        int steps = 0;
    };

    /// Forgets what the lighting before this one had and this one has not, and light that bounced in it.
    /// @param transport  the same in each call
    /// @return valid until the next call
    [[nodiscard]] DirectLight direct(const Transport& transport, std::span<const Source> sources);
    /// @param direct  of the lighting's sources. @param stop  gives up early with an unusable result
    [[nodiscard]] Bounced bounced(const Transport& transport, const Lighting& lighting,
                                  const DirectLight& direct, const std::atomic<bool>& stop);

private:
    /// Memory is 4 bytes a patch and lamp; of further lamps only the sum is kept.
    static constexpr size_t kMostKept = 32;
    Kept<Source, std::vector<float>> unit_lights_;
    Kept<std::vector<Source>, std::vector<Rgb4>> rest_;
    Kept<Lighting, Bounced> parts_;
};

} // namespace cl::radiosity
