#pragma once

#include "servers/gi/relight.h"
#include "servers/visual/version_clock.h"

#include "core/expected.h"
#include "core/math/aabb.h"
#include "core/rid.h"

#include <cstdint>
#include <memory>

namespace cl {

/// What a GI probe holds whether or not it stands in a world. Its life in one is a ProbeMachine's.
struct GIProbe {
    std::shared_ptr<const gi::CellLayout> layout; ///< null: never baked, or not valid
    bool has_data = false;                        ///< data was given, baked or not: it pairs by its bounds
    uint64_t data_version = 0;                    ///< another for each assignment
    gi::TexelCoding coding = gi::TexelCoding::Plain;
    AABB bounds; ///< true box, probe-local [m]
    Transform cells_from_local;
    glm::vec3 bounds_cells{0.0f}; ///< size of the true box [cells]
    // Read each frame.
    float energy = 1.0f;
    float bias_cells = 1.5f;
    float normal_bias_m = 0.0f;
    float propagation = 0.7f;
    bool interior = false;
    int dynamic_range = 4;
};

/// Replaces a probe's data by a resource's; keeps the layout of the cells, not the blob.
/// @return ParseError if a number or the blob is not valid; the probe then has no data.
Status set_probe_data(GIProbe& probe, const gi::ProbeData& data, VersionClock& clock);

} // namespace cl
