#pragma once

#include "servers/radiosity/air_points.h"
#include "servers/radiosity/field_map.h"
#include "servers/radiosity/radiance_volume.h"
#include "servers/radiosity/solver.h"
#include "servers/radiosity/transport.h"
#include "servers/render_types.h"
#include "servers/visual/still_items.h"

#include "core/math/aabb.h"
#include "core/math/transform.h"
#include "core/rid.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cl {

/// What a GI field is made of.
struct FieldGeometry {
    struct Probe {
        RID instance;
        Transform world_from_probe;
        AABB box;
        friend bool operator==(const Probe& a, const Probe& b) {
            return a.instance == b.instance && a.world_from_probe == b.world_from_probe &&
                   a.box.position == b.box.position && a.box.size == b.box.size;
        }
    };
    /// A still instance and the newest version of its looks.
    struct Item {
        RID instance;
        uint64_t look = 0;
        friend bool operator==(const Item&, const Item&) = default;
    };
    std::vector<Probe> probes;
    std::vector<Item> items;
    Quality quality = Quality::High;
    friend bool operator==(const FieldGeometry&, const FieldGeometry&) = default;
};

/// What reads a field's light besides the pixels of still surfaces, and costs work of its own.
struct FieldReaders {
    bool glossy = false; ///< reflections
    radiosity::AirUse air = radiosity::AirUse::Gaps;

    /// True if what was made for these will do for `others`.
    [[nodiscard]] bool include(const FieldReaders& others) const noexcept {
        return glossy == others.glossy && air >= others.air;
    }
};

/// What stays of a field while light changes. Made by one job, read by those after it.
struct FieldParts {
    std::shared_ptr<const radiosity::Transport> transport;
    std::shared_ptr<const radiosity::FieldMap> map;
    std::shared_ptr<const std::vector<radiosity::AirPoints>> air;
    std::shared_ptr<radiosity::LightMemory> memory; ///< of the transport; the job's while there is one
};

/// Work for the worker and what comes of it. Shared, so that neither side waits when the other goes.
struct FieldJob {
    // Given.
    FieldGeometry geometry;
    radiosity::Lighting lighting;
    FieldReaders readers;
    std::vector<StillItem> items; ///< of a new transport; else empty
    bool is_new = false;          ///< transport and map are to be made
    FieldParts parts;             ///< what is missing is made
    // Made.
    std::vector<uint32_t> light;
    std::vector<uint16_t> air;
    std::vector<radiosity::RadianceVolume> volumes;
    std::string error;
    int bounces = 0;
    double bake_ms = 0.0, solve_ms = 0.0;
    std::atomic<bool> done{false};
    std::atomic<bool> stop{false}; ///< not wanted any more

    void run();

private:
    [[nodiscard]] bool make_parts();
    void solve();
};

} // namespace cl
