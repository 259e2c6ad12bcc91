#pragma once

#include "scene/3d/spatial.h"
#include "scene/resources/server_rid.h"

#include <cstdint>

namespace cl::scene {

/// A node that the renderer sees: inside a tree with a server it owns an instance there, which follows its
/// transform, visibility and layers and shows the base that the derived class names.
class VisualInstance : public Spatial {
public:
    static constexpr std::string_view kClassName = "VisualInstance";
    static void bind(ClassBuilder<VisualInstance>& c);

    /// Drawn where layers & camera.cull_mask is not 0; lit where layers & light_cull_mask is not 0.
    [[nodiscard]] uint32_t layers() const noexcept { return layers_; }
    void set_layers(uint32_t mask);

    /// The null RID while there is none.
    [[nodiscard]] RID instance_rid() const noexcept { return instance_.get(); }

protected:
    void notification(Notification what) override;

    /// What the instance shows, made in `server` where needed; the null RID for nothing.
    virtual RID base_rid(VisualServer& server);
    /// Tells a fresh instance all that the derived class knows. Overrides call the base class's first.
    virtual void describe_instance(VisualServer& server, RID instance);
    /// False hides the instance.
    [[nodiscard]] virtual bool is_shown() const;
    void show_or_hide();
    /// Asks base_rid() again and tells the server if it is another one. True if it was.
    bool update_base();
    /// As update_base(), but the instance starts over even if the base is the same.
    void restart_base();

private:
    ServerRID instance_;
    RID base_;
    uint32_t layers_ = 1;
};

} // namespace cl::scene
