#include "servers/visual/gi_probe_storage.h"

#include "servers/gi/s3tc.h"
#include "servers/visual/finite.h"

#include <fmt/format.h>
#include <glm/vector_relational.hpp>

#include <cmath>

namespace cl {
namespace {

Status check_numbers(const gi::ProbeData& data) {
    const auto wrong = [](std::string message) {
        return Error{ErrorCode::ParseError, std::move(message), {}};
    };
    if (!is_finite(data.bounds) || glm::any(glm::lessThan(data.bounds.size, glm::vec3(0.0f)))) {
        return wrong("GIProbeData.bounds: expected finite numbers and a size that is not negative");
    }
    if (!std::isfinite(data.cell_size_m) || data.cell_size_m <= 0.0f) {
        return wrong(
            fmt::format("GIProbeData.cell_size: expected a positive number, found {}", data.cell_size_m));
    }
    if (!is_finite(data.cells_from_local)) {
        return wrong("GIProbeData.to_cell_xform: expected finite numbers");
    }
    if (data.dynamic_range < 1) {
        return wrong(
            fmt::format("GIProbeData.dynamic_range: expected at least 1, found {}", data.dynamic_range));
    }
    for (float number : {data.energy, data.bias_cells, data.normal_bias_m, data.propagation}) {
        if (!std::isfinite(number)) {
            return wrong(fmt::format("GIProbeData: expected finite parameters, found {}", number));
        }
    }
    return {};
}

} // namespace

Status set_probe_data(GIProbe& probe, const gi::ProbeData& data, VersionClock& clock) {
    probe.layout.reset();
    probe.has_data = false;
    probe.data_version = clock.tick();
    if (Status numbers = check_numbers(data); !numbers) {
        return numbers;
    }
    gi::GridScale scale{data.cell_size_m, data.cells_from_local};
    if (!data.dynamic_data.empty()) {
        const Expected<gi::Octree> octree = gi::decode_octree(data.dynamic_data);
        if (!octree) {
            return octree.error();
        }
        probe.layout = std::make_shared<const gi::CellLayout>(gi::make_layout(*octree));
        scale = gi::grid_scale(data, octree->levels);
    }
    probe.coding = data.compress && probe.layout && gi::block_mip_count(probe.layout->dims) > 0
                       ? gi::TexelCoding::Dxt5
                       : gi::TexelCoding::Plain;
    probe.has_data = true;
    probe.bounds = data.bounds;
    probe.cells_from_local = scale.cells_from_local;
    probe.bounds_cells = data.bounds.size / scale.cell_size_m;
    probe.energy = data.energy;
    probe.bias_cells = data.bias_cells;
    probe.normal_bias_m = data.normal_bias_m;
    probe.propagation = data.propagation;
    probe.interior = data.interior;
    probe.dynamic_range = data.dynamic_range;
    return {};
}

} // namespace cl
