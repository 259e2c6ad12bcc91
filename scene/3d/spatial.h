#pragma once

#include "scene/main/node.h"

#include "core/math/transform.h"
#include "core/ref.h"

#include <glm/vec3.hpp>

#include <vector>

namespace cl {
class VisualServer;
}

namespace cl::scene {

class Mesh;
class World;

/// Geometry that a node adds to a GI bake.
struct BakeMesh {
    Transform local; ///< node from mesh
    Ref<Mesh> mesh;
};

/// A node with a place in space. Its global transform is that of the nearest Spatial parent times its own; a
/// parent of another class breaks the chain. Right-handed, +Y up, looks along -Z, metres.
class Spatial : public Node {
public:
    static constexpr std::string_view kClassName = "Spatial";
    static void bind(ClassBuilder<Spatial>& c);

    /// Parent from this node.
    [[nodiscard]] const Transform& transform() const noexcept { return transform_; }
    void set_transform(const Transform& parent_from_local);

    [[nodiscard]] glm::vec3 translation() const noexcept { return transform_.origin; } ///< [m]
    void set_translation(const glm::vec3& position_m);
    /// Euler angles about x, y and z, applied in the order Z, X, Y (R = Ry * Rx * Rz). Angles that were set
    /// are kept as they are; those of a transform that was set lie in (-180, 180].
    [[nodiscard]] glm::vec3 rotation_degrees() const;
    void set_rotation_degrees(const glm::vec3& euler_deg);
    /// Along the local axes: basis = rotation * scale. All negative for a mirroring transform that was set.
    [[nodiscard]] glm::vec3 scale() const;
    void set_scale(const glm::vec3& factors);

    /// World from this node; orthonormal for cameras, lights and probes, which have no scale. Cached.
    [[nodiscard]] const Transform& global_transform() const;
    /// Refused (and left alone) if the parent's global transform is singular.
    SetResult set_global_transform(const Transform& world_from_local);
    /// Turns -Z towards a point [m, world], +Y as near to `up` as that allows, and keeps position and scale.
    /// No effect if the point is where the node is or in the direction of `up`.
    void look_at(const glm::vec3& target_m, const glm::vec3& up = {0.0f, 1.0f, 0.0f});

    [[nodiscard]] bool is_visible() const noexcept { return visible_; }
    void set_visible(bool visible);
    /// False if this node or one of the Spatial parents directly chained above it is hidden.
    [[nodiscard]] bool is_visible_in_tree() const noexcept;

    /// The parent if it is a Spatial, else nullptr.
    [[nodiscard]] Spatial* parent_spatial() const noexcept;

    /// Meshes that a GI bake plots besides those of MeshInstances (spec gi-bake section 2b): for nodes that
    /// build their geometry, such as grid maps.
    [[nodiscard]] virtual std::vector<BakeMesh> bake_meshes() const;

protected:
    /// For classes whose own and inherited scale has no effect. Call from the constructor.
    void ignore_scale() noexcept { scale_ignored_ = true; }
    void notification(Notification what) override;
    /// The server that the tree draws with; nullptr outside a tree and in a tree without one.
    [[nodiscard]] VisualServer* server() const noexcept;

private:
    friend class World;
    void transform_changed();
    void tell_transform_changed();
    void tell_visibility_changed();
    void update_pose() const;
    void set_pose(const glm::vec3& euler_rad, const glm::vec3& scale);

    Transform transform_;
    mutable Transform global_;
    mutable bool global_valid_ = false; // if not, neither is that of any Spatial chained below
    bool transform_queued_ = false;     // to be told TransformChanged
    bool visible_ = true;
    bool scale_ignored_ = false;
    // Rotation and scale as they were set, which the basis alone cannot give back.
    mutable bool pose_valid_ = true;
    mutable glm::vec3 euler_rad_{0.0f};
    mutable glm::vec3 scale_{1.0f};
};

} // namespace cl::scene
