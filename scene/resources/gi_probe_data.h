#pragma once

#include "scene/resources/explains_refusal.h"
#include "scene/resources/server_rid.h"

#include "servers/gi/probe_data.h"

#include "core/object/resource.h"
#include "core/variant/variant.h"

#include <cstdint>
#include <string>

namespace cl::scene {

/// What a GI bake made, and how it is shown (spec gi-probe-data section 2).
class GIProbeData final : public Resource, public ExplainsRefusal {
public:
    static constexpr std::string_view kClassName = "GIProbeData";
    static void bind(ClassBuilder<GIProbeData>& c);

    [[nodiscard]] const gi::ProbeData& data() const noexcept { return data_; }
    /// Replaces everything; probes that show it start over.
    void set_data(gi::ProbeData data);

    /// New whenever the cells are assigned, and then of no other object or time: the same number, the same
    /// cells.
    [[nodiscard]] uint64_t cells_version() const noexcept { return cells_version_; }

    /// Replaces the cells after checking them: Refused, with refusal() saying why, if they are not valid.
    SetResult set_dynamic_data(const PoolIntArray& cells);
    [[nodiscard]] const std::string& refusal() const noexcept override { return refusal_; }

    // Read live by the renderer, without starting over.
    void set_energy(float energy);
    void set_bias(float bias_cells);
    void set_normal_bias(float normal_bias_m);
    void set_propagation(float propagation);
    void set_interior(bool interior);
    void set_dynamic_range(int dynamic_range);
    /// Probes that show it start over.
    void set_compress(bool compress);

    /// The probe in `server`, made on the first call. It keeps its RID; changes are passed on.
    [[nodiscard]] RID rid(VisualServer& server) const;

private:
    /// Sends all data to the server again and tells the users.
    void data_changed();

    void cells_changed();

    gi::ProbeData data_;
    uint64_t cells_version_ = 0; ///< 0: none yet
    std::string refusal_;
    mutable ServerRID rid_;
};

} // namespace cl::scene
