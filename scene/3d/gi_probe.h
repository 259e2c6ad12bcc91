#pragma once

#include "scene/3d/gi_probe_bake.h"
#include "scene/3d/visual_instance.h"
#include "scene/resources/gi_probe_data.h"

#include "core/expected.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>

namespace cl::scene {

/// Leaf cells along the longest axis: 64 << value.
enum class GIProbeSubdiv : uint8_t { Cells64, Cells128, Cells256, Cells512 };

/// Whether a bake keeps what makes the next one quick (BakeMemory).
enum class BakeFor : uint8_t { Edits, Once };

/// Box that receives indirect light. What it shows is `data`, made by bake(). Scale has no effect on it; its
/// rotation has. Energy, bias, normal bias, propagation, interior and compress are passed on to the data when
/// they are set; the data's values count when it is assigned (spec gi-probe-data section 1).
class GIProbe final : public VisualInstance {
public:
    static constexpr std::string_view kClassName = "GIProbe";
    static void bind(ClassBuilder<GIProbe>& c);
    GIProbe();

    [[nodiscard]] GIProbeSubdiv subdiv() const noexcept { return subdiv_; }
    SetResult set_subdiv(GIProbeSubdiv subdiv);
    /// Half size of the box [m].
    [[nodiscard]] glm::vec3 extents() const noexcept { return extents_m_; }
    void set_extents(glm::vec3 half_size_m) { extents_m_ = half_size_m; }
    /// Radiance that the brightest texel stands for; reaches the data by a bake. Refused below 1.
    [[nodiscard]] int dynamic_range() const noexcept { return dynamic_range_; }
    SetResult set_dynamic_range(int range);
    /// Factor on what the probe gives.
    [[nodiscard]] float energy() const noexcept { return energy_; }
    void set_energy(float energy);
    /// How far light keeps its strength when cells are merged, 0..1.
    [[nodiscard]] float propagation() const noexcept { return propagation_; }
    void set_propagation(float propagation);
    /// Where cones start [leaf cells].
    [[nodiscard]] float bias() const noexcept { return bias_cells_; }
    void set_bias(float bias_cells);
    /// Moves the cones' start along the normal [m].
    [[nodiscard]] float normal_bias() const noexcept { return normal_bias_m_; }
    void set_normal_bias(float normal_bias_m);
    /// True: ambient light and sky do not reach what the cones miss.
    [[nodiscard]] bool is_interior() const noexcept { return interior_; }
    void set_interior(bool interior);
    /// Passed on to the data.
    [[nodiscard]] bool is_compressed() const noexcept { return compress_; }
    void set_compress(bool compress);
    /// What was baked; null: the probe has no effect. Assigning starts the light over, even with the same
    /// object.
    [[nodiscard]] const Ref<GIProbeData>& data() const noexcept { return data_; }
    void set_data(Ref<GIProbeData> data);

    /// Voxelises what lies in the box and puts the result into `data`, which is made if there is none; needs
    /// no tree, server or graphics. Lights are no part of it. The second bake plots only what changed since
    /// the first, with the same result.
    /// @param from      the node to start from; null: this node's parent, else the node itself
    /// @param progress  share done, may cancel
    /// @return what became of it; InvalidArgument for extents that give no grid, Cancelled, OutOfMemory.
    Expected<BakeFigures> bake(const Node* from = nullptr, const gi::BakeProgress& progress = {},
                               BakeFor purpose = BakeFor::Edits);

protected:
    RID base_rid(VisualServer& server) override;
    void copy_state_from(const Node& original) override;

private:
    GIProbeSubdiv subdiv_ = GIProbeSubdiv::Cells128;
    glm::vec3 extents_m_{10.0f};
    int dynamic_range_ = 4;
    float energy_ = 1.0f;
    float propagation_ = 0.7f;
    float bias_cells_ = 1.5f;
    float normal_bias_m_ = 0.0f;
    bool interior_ = false;
    bool compress_ = false;
    Ref<GIProbeData> data_;
    std::unique_ptr<BakeMemory> memory_; ///< of the bake that made the cells of that version; null: none
    uint64_t remembered_version_ = 0;
};

} // namespace cl::scene
