#pragma once

#include "scene/3d/visual_instance.h"

#include "servers/render_types.h"

namespace cl::scene {

/// A light, as far as all kinds have it in common. Its parameters are those of LightDesc:
///     lamp.edit([](LightDesc& d) { d.energy = 2.0f; });
/// Scale has no effect on it. Abstract.
class Light : public VisualInstance {
public:
    static constexpr std::string_view kClassName = "Light";
    static void bind(ClassBuilder<Light>& c);

    [[nodiscard]] const LightDesc& desc() const noexcept { return desc_; }
    /// The kind of light stays what it is.
    void set_desc(const LightDesc& desc);
    /// Changes parameters: `change` is called with a copy of desc(), which is then set.
    template <typename Change>
    void edit(Change&& change) {
        LightDesc desc = desc_;
        change(desc);
        set_desc(desc);
    }

    /// Lights nothing in a running program.
    [[nodiscard]] bool is_editor_only() const noexcept { return editor_only_; }
    void set_editor_only(bool on);

    /// The light in the tree's server; null outside a tree or without a server.
    [[nodiscard]] RID light_rid() const noexcept { return rid_.get(); }

protected:
    explicit Light(LightType type);
    void notification(Notification what) override;
    RID base_rid(VisualServer& server) override;
    [[nodiscard]] bool is_shown() const override;

private:
    LightDesc desc_;
    bool editor_only_ = false;
    ServerRID rid_;
};

} // namespace cl::scene
