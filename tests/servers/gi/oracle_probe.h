#pragma once

#include "servers/gi/probe_data.h"
#include "servers/gi/voxelizer.h"
#include "servers/mesh_surface.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cl::tests {

/// A probe of an oracle scene with what it bakes: read by a small reader of our own, since this layer knows
/// no scene file. It understands what those scenes hold: cubes, spheres, plain colours, no parents but the
/// root.
struct OracleProbe {
    gi::Grid grid;
    std::vector<gi::PlotSurface> surfaces; ///< into the members below
    std::vector<std::unique_ptr<gi::MaterialCapture>> materials;
    SurfaceArrays cube;
    SurfaceArrays sphere;
};
std::unique_ptr<OracleProbe> load_oracle_probe(const std::filesystem::path& scene, const std::string& probe,
                                               int subdivision = 128);

/// The dynamic_data of a GIProbeData file compressed with xz; empty if it cannot be read.
std::vector<int32_t> load_dynamic_data(const std::filesystem::path& tres_xz);

} // namespace cl::tests
