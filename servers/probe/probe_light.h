#pragma once

#include "servers/gi/relight.h"
#include "servers/render_types.h"

#include "core/rid.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cl {

/// Why a light that a probe could receive is, or is not, in its volume.
enum class LightPresence : uint8_t { Lit, Hidden, BakeDisabled };

/// A candidate light of a probe (spec gi-update section 4).
struct ProbeLight {
    RID key; ///< the light's instance
    LightPresence presence = LightPresence::Lit;
    Transform world_from_light; ///< orthonormal
    gi::CachedLight light;      ///< its `visible` follows `presence`
};

/// What the relight reads of a light. @param cells_from_world  the probe's; finite
[[nodiscard]] ProbeLight make_probe_light(RID key, const LightDesc& desc, bool visible,
                                          const Transform& world_from_light,
                                          const Transform& cells_from_world);

/// Reasons to light a probe again; several may hold at once.
enum class ProbeCause : uint32_t {
    NeverLit = 1u << 0, ///< just set up
    PropagationChanged = 1u << 1,
    DynamicRangeChanged = 1u << 2,
    ProbeMoved = 1u << 3,
    LightAdded = 1u << 4,
    LightRemoved = 1u << 5, ///< freed, left the world, or left the probe's box
    LightHidden = 1u << 6,
    LightShown = 1u << 7,
    LightRemoded = 1u << 8, ///< bake mode from or to "disabled"; "indirect" and "all" are the same to a probe
    LightRetyped = 1u << 9,
    LightMoved = 1u << 10,
    LightRecoloured = 1u << 11,
    LightReenergised = 1u << 12,
    LightReshaped = 1u << 13, ///< range, attenuation or spot
};

class ProbeCauses {
public:
    void add(ProbeCause cause) noexcept { bits_ |= static_cast<uint32_t>(cause); }
    [[nodiscard]] bool has(ProbeCause cause) const noexcept {
        return (bits_ & static_cast<uint32_t>(cause)) != 0;
    }
    [[nodiscard]] bool any() const noexcept { return bits_ != 0; }
    /// "light moved, light recoloured", in the order of ProbeCause.
    [[nodiscard]] std::string to_string() const;
    ProbeCauses& operator|=(const ProbeCauses& other) noexcept {
        bits_ |= other.bits_;
        return *this;
    }
    friend bool operator==(const ProbeCauses&, const ProbeCauses&) = default;

private:
    uint32_t bits_ = 0;
};

/// One light to take out of (sign -1) or put into (sign +1) a probe's leaves.
struct LightEdit {
    gi::CachedLight light;
    int sign = 1;
};

struct LightChanges {
    ProbeCauses causes;
    std::vector<LightEdit> edits; ///< none for lights that lit nothing before and light nothing now
};

/// How the candidates differ from those a probe was last lit with. Both sorted by key.
[[nodiscard]] LightChanges compare_lights(std::span<const ProbeLight> before,
                                          std::span<const ProbeLight> now);

} // namespace cl
