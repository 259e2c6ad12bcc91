#pragma once

#include "scene/resources/server_rid.h"
#include "scene/resources/texture.h"
#include "scene/resources/watched_ref.h"

#include "servers/render_types.h"

#include "core/math/color.h"
#include "core/object/resource.h"

namespace cl::scene {

/// Light from far away in every direction. Abstract.
class Sky : public Resource {
public:
    static constexpr std::string_view kClassName = "Sky";
    static void bind(ClassBuilder<Sky>& c);

    /// Edge of the reflection map as an exponent: 32 * 2^n texels, n in 0..6.
    [[nodiscard]] int radiance_size() const noexcept { return radiance_size_; }
    SetResult set_radiance_size(int exponent);

    /// The sky as a panorama of linear radiance; size 0 if there is nothing to show.
    [[nodiscard]] virtual SkyDesc describe() const = 0;
    /// The sky in `server`, made on the first call; null RID if there is nothing to show. A change makes a
    /// new RID: users ask again when on_changed() calls them.
    [[nodiscard]] RID rid(VisualServer& server) const;

protected:
    void sky_changed();

private:
    int radiance_size_ = 2;
    mutable ServerRID rid_;
};

/// A panorama image as a sky. 8-bit images are decoded from sRGB.
class PanoramaSky final : public Sky {
public:
    static constexpr std::string_view kClassName = "PanoramaSky";
    static void bind(ClassBuilder<PanoramaSky>& c);
    PanoramaSky();

    [[nodiscard]] const Ref<Texture>& panorama() const noexcept { return panorama_.get(); }
    void set_panorama(Ref<Texture> texture);
    [[nodiscard]] SkyDesc describe() const override;

private:
    WatchedRef<Texture> panorama_;
};

/// Parameters of a ProceduralSky (spec scene-classes section 14.4), with its defaults.
struct ProceduralSkyParams {
    Color sky_top_color{0.647059f, 0.839216f, 0.945098f, 1.0f};
    Color sky_horizon_color{0.839216f, 0.917647f, 0.980392f, 1.0f};
    float sky_curve = 0.09f;
    float sky_energy = 1.0f;
    Color ground_bottom_color{0.156863f, 0.184314f, 0.211765f, 1.0f};
    Color ground_horizon_color{0.423529f, 0.396078f, 0.372549f, 1.0f};
    float ground_curve = 0.02f;
    float ground_energy = 1.0f;
    Color sun_color{1.0f, 1.0f, 1.0f, 1.0f};
    float sun_latitude_deg = 35.0f;
    float sun_longitude_deg = 0.0f;
    float sun_angle_min_deg = 1.0f;
    float sun_angle_max_deg = 100.0f;
    float sun_curve = 0.05f;
    float sun_energy = 1.0f;
    int texture_size = 2; ///< exponent: 256 * 2^n texels wide, half as high; n in 0..4
};

/// The panorama of a procedural sky: linear radiance, row 0 at the zenith, rounded to RGB9E5 as Godot stores
/// it. Gradient colours are linearised, the sun's is not (spec section 14.4). Runs on all worker threads.
[[nodiscard]] SkyDesc make_procedural_panorama(const ProceduralSkyParams& params);

/// Gradients above and below the horizon and a sun with a halo.
class ProceduralSky final : public Sky {
public:
    static constexpr std::string_view kClassName = "ProceduralSky";
    static void bind(ClassBuilder<ProceduralSky>& c);

    [[nodiscard]] const ProceduralSkyParams& params() const noexcept { return params_; }
    void set_params(const ProceduralSkyParams& params);
    [[nodiscard]] SkyDesc describe() const override;

private:
    ProceduralSkyParams params_;
};

} // namespace cl::scene
