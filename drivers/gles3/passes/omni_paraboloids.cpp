#include "drivers/gles3/passes/omni_paraboloids.h"

#include "drivers/gles3/light_sets.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <utility>

namespace cl::gles3 {

namespace {

/// Edge of the faces that are folded into a map [texels].
int face_size(int slot_size) noexcept {
    constexpr int kLeast = 16;
    constexpr int kMost = 512;
    return std::clamp(slot_size / 2, kLeast, kMost);
}

/// View matrix of a cube's face, as GL lays cube maps out.
Transform face_from_light(gl::CubeFace face) noexcept {
    static const glm::vec3 kForward[6] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                          {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    static const glm::vec3 kUp[6] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    const auto i = static_cast<size_t>(face);
    const glm::mat4 m = glm::lookAt(glm::vec3(0.0f), kForward[i], kUp[i]);
    return {glm::mat3(m), glm::vec3(m[3])};
}

glm::mat4 clip_from_face(float range_m) noexcept {
    CameraDesc camera;
    camera.fov_deg = 90.0f;
    camera.near_m = local_shadow_near_m(ShadowFit::AsSet, range_m);
    camera.far_m = range_m;
    return projection_matrix(camera, glm::ivec2(1));
}

} // namespace

Expected<const OmniParaboloids::Cube*> OmniParaboloids::cube_of(int size) {
    if (const auto found = cubes_.find(size); found != cubes_.end()) {
        return static_cast<const Cube*>(&found->second);
    }
    Expected<gl::TextureCube> texture = gl::TextureCube::create({.size = size,
                                                                 .format = gl::Format::Depth24,
                                                                 .sampler = {.filter = gl::Filter::Nearest},
                                                                 .label = "omni shadow faces"});
    if (!texture) {
        return texture.error();
    }
    Cube cube{*std::move(texture), {}};
    for (int face = 0; face < 6; ++face) {
        Expected<gl::Framebuffer> f =
            gl::Framebuffer::create({.depth = {&cube.texture, 0, face}, .label = "omni shadow face"});
        if (!f) {
            return f.error();
        }
        cube.faces.push_back(*std::move(f));
    }
    return static_cast<const Cube*>(&cubes_.emplace(size, std::move(cube)).first->second);
}

Status OmniParaboloids::draw(const gl::Framebuffer& atlas, const gl::Rect& slot, const LightItem& light,
                             float bias_m, const Resources& resources, CasterDraw& casters) {
    using S = shaders::OmniParaboloid;
    const Expected<const Cube*> cube = cube_of(face_size(slot.size.x));
    if (!cube) {
        return cube.error();
    }
    const Transform light_from_world = light.world_from_light.inverse();
    for (size_t face = 0; face < 6; ++face) {
        gl::Pass pass(
            {.label = "omni shadow face", .target = &(*cube)->faces[face], .depth = gl::Load::Clear});
        // The bias is added to the distance when the faces are folded.
        const CasterView view{face_from_light(static_cast<gl::CubeFace>(face)) * light_from_world,
                              clip_from_face(light.desc->range_m)};
        if (Status s = casters.draw(pass, light, view, resources); !s) {
            return s;
        }
    }
    const auto program = folds_.get(0);
    if (!program) {
        return program.error();
    }
    (*program)->set(S::near_far, glm::vec2(local_shadow_near_m(ShadowFit::AsSet, light.desc->range_m),
                                           light.desc->range_m));
    (*program)->set(S::bias, bias_m);
    (*program)->set(S::range, light.desc->range_m);
    (*program)->bind(S::faces, (*cube)->texture);
    gl::Pass pass({.label = "omni shadow", .target = &atlas, .viewport = slot});
    constexpr gl::DrawState kDepthOnly{gl::DepthTest::Always, gl::WriteMask::Depth, gl::Cull::Off};
    pass.draw_fullscreen(**program, resources.no_vertices, kDepthOnly);
    return {};
}

} // namespace cl::gles3
