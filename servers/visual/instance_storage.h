#pragma once

#include "servers/visual/instance.h"
#include "servers/visual/storage.h"

#include "core/rid.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace cl {

/// Instances and scenarios: where things stand, what overlaps what, and in which order they met.
///
/// Pairing rules (spec gi-update section 8): a mesh pairs with each local light and GI probe whose world box
/// overlaps or touches its own, whether or not the mesh or the light is visible; a hidden probe pairs with
/// nothing. Lists keep the order in which pairs came about. Changed instances are updated last-queued-first,
/// so of things that enter together the later ones pair first; a probe that is hidden and shown, or given new
/// data, moves to the end.
class InstanceStorage {
public:
    InstanceStorage(Storage& storage, Rasterizer& rasterizer);
    ~InstanceStorage();
    InstanceStorage(const InstanceStorage&) = delete;
    InstanceStorage& operator=(const InstanceStorage&) = delete;

    RID make_scenario() { return scenarios_.make({}); }
    /// Its instances go nowhere.
    bool free_scenario(RID scenario);
    [[nodiscard]] Scenario* scenario(RID rid) noexcept { return scenarios_.get(rid); }

    RID make() { return instances_.make({}); }
    bool free(RID instance);
    [[nodiscard]] Instance* get(RID instance) noexcept { return instances_.get(instance); }
    [[nodiscard]] size_t size() const noexcept { return instances_.size(); }
    [[nodiscard]] size_t scenario_count() const noexcept { return scenarios_.size(); }
    template <typename F>
    void for_each(F&& f) {
        instances_.for_each(f);
    }
    /// Those of GI probes that stand in a scenario: the ones with a machine.
    [[nodiscard]] const std::vector<RID>& probes() const noexcept { return probes_; }

    // All of these take a live instance.
    void set_base(RID instance, RID base);
    void set_scenario(RID instance, RID scenario);
    void set_transform(RID instance, const Transform& world_from_local);
    void set_visible(RID instance, bool visible);
    void set_extra_margin(RID instance, float margin_m);
    /// Its shadow changed: a material, a casting mode.
    void touch(RID instance) { instances_.get(instance)->version = storage_.clock.tick(); }

    /// A light's parameters or type, or a mesh, changed.
    void base_changed(RID base);
    /// A probe was given other data: it leaves and enters again.
    void probe_data_changed(RID probe);
    /// The base is about to be freed: its instances become empty.
    void base_freed(RID base);

    /// Brings boxes and pairs up to date with all changes since the last call.
    void update();

    /// The transform an instance stands with: lights and probes have no scale (spec scene-classes section 2).
    [[nodiscard]] static Transform placement(const Instance& instance) noexcept;
    /// Its world box were it visible; none if it has no extent.
    [[nodiscard]] std::optional<AABB> world_bounds_of(const Instance& instance) const;

private:
    [[nodiscard]] InstanceKind kind_of(RID base) const noexcept;
    void queue(RID rid, Instance& instance);
    void enter(RID rid, Instance& instance);
    void leave(RID rid, Instance& instance);
    void unpair(RID rid, Instance& instance);
    void update_one(RID rid, Instance& instance);
    void pair_mesh(Instance& mesh, Scenario& scenario);
    void pair_partner(RID rid, Instance& partner, Scenario& scenario, const std::optional<AABB>& old_bounds);

    Storage& storage_;
    Rasterizer& rasterizer_;
    RID_Owner<Scenario> scenarios_{static_cast<uint32_t>(RIDKind::Scenario)};
    RID_Owner<Instance> instances_{static_cast<uint32_t>(RIDKind::Instance)};
    std::unordered_map<RID, std::vector<RID>> instances_of_base_;
    std::vector<RID> queued_;
    std::vector<RID> probes_;
};

} // namespace cl
