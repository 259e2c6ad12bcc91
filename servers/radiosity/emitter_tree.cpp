#include "servers/radiosity/emitter_tree.h"

#include "servers/radiosity/fragments.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cl::radiosity {
namespace {

constexpr float kInversePi = 1.0f / std::numbers::pi_v<float>;
constexpr size_t kMostPieces = 8000;
constexpr float kAfar = 8.0f;           // radii from which a branch is one point: off by a hundredth at most
constexpr float kAfarAtHorizon = 16.0f; // where part of it is below the horizon
constexpr float kRaysPerAngle = 640.0f; // over (radius / distance)^2: 10 at the least distance

/// The triangles of a scene that shine, with its surfaces.
StillScene shining_part(const StillScene& scene) {
    StillScene part;
    part.surfaces = scene.surfaces;
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
        const Surface& s = scene.surfaces[scene.surface_of[t]];
        if (s.emission == glm::vec3(0.0f) && !s.emission_map) {
            continue;
        }
        const uint32_t first = uint32_t(part.positions.size());
        for (int i = 0; i < 3; ++i) {
            part.positions.push_back(scene.positions[scene.triangles[t][i]]);
            part.uvs.push_back(scene.uvs[scene.triangles[t][i]]);
        }
        part.triangles.emplace_back(first, first + 1, first + 2);
        part.surface_of.push_back(scene.surface_of[t]);
    }
    return part;
}

int facing_of(const glm::vec3& normal) noexcept {
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return axis * 2 + (normal[axis] < 0.0f ? 1 : 0);
}

/// Form factor from the origin, normal along z, to a polygon above z = 0.
float form_factor(const Polygon& polygon) noexcept {
    float sum = 0.0f;
    for (size_t i = 0; i < polygon.count; ++i) {
        const glm::vec3 a = glm::normalize(polygon.corners[i]),
                        b = glm::normalize(polygon.corners[i + 1 == polygon.count ? 0 : i + 1]);
        const glm::vec3 across = glm::cross(a, b);
        const float sine = glm::length(across);
        if (sine > 1e-7f) {
            sum += std::atan2(sine, glm::dot(a, b)) * across.z / sine;
        }
    }
    return std::min(std::abs(sum) * 0.5f * kInversePi, 1.0f);
}

/// Calls f with small triangles that make up a polygon: four for each of its edges.
template <typename F>
void for_each_part(const Polygon& polygon, const glm::vec3& centroid, const F& f) {
    for (size_t i = 0; i < polygon.count; ++i) {
        const glm::vec3 a = polygon.corners[i], b = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
        const glm::vec3 ab = 0.5f * (a + b), ac = 0.5f * (a + centroid), bc = 0.5f * (b + centroid);
        const std::array<glm::vec3, 3> parts[] = {{a, ab, ac}, {ab, b, bc}, {ac, bc, centroid}, {ab, bc, ac}};
        for (const std::array<glm::vec3, 3>& corners : parts) {
            Polygon part;
            for (const glm::vec3& corner : corners) {
                part.add(corner);
            }
            f(part);
        }
    }
}

} // namespace

/// A point that light is sent to.
struct EmitterTree::Receiver {
    const RayScene& rays;
    glm::vec3 position, normal; ///< of the surface itself: a lift counts beside a thin strip of light
    glm::vec3 ray_origin;
    glm::mat3 world_from_local; ///< normal along z
    float lift_m, start;

    Receiver(const RayScene& scene, const glm::vec3& at, const glm::vec3& n, float lift, float first) noexcept
        : rays(scene), position(at), normal(n), ray_origin(at + lift * n), lift_m(lift), start(first) {
        const glm::vec3 up = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const glm::vec3 s = glm::normalize(glm::cross(up, n));
        world_from_local = glm::mat3(s, glm::cross(n, s), n);
    }
    [[nodiscard]] bool sees(const glm::vec3& target, const glm::vec3& target_normal) const noexcept {
        return !rays.is_blocked(ray_origin, target + lift_m * target_normal);
    }
};

EmitterTree::EmitterTree(const StillScene& scene, const Patches& patches) {
    add_pieces(scene, patches);
    if (pieces_.size() > kMostPieces) {
        return;
    }
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
        return facing_of(a.normal) < facing_of(b.normal);
    });
    for (size_t begin = 0; begin < pieces_.size();) {
        size_t end = begin;
        while (end < pieces_.size() && facing_of(pieces_[end].normal) == facing_of(pieces_[begin].normal)) {
            ++end;
        }
        roots_.push_back(uint32_t(nodes_.size()));
        build(uint32_t(begin), uint32_t(end - begin));
        begin = end;
    }
    light_before_.push_back(0.0f);
    for (const Piece& p : pieces_) {
        const float brightest = std::max(p.emission.x, std::max(p.emission.y, p.emission.z));
        light_before_.push_back(light_before_.back() + p.area_m2 * brightest);
    }
}

void EmitterTree::add_pieces(const StillScene& scene, const Patches& patches) {
    const StillScene part = shining_part(scene);
    std::vector<CellGrid> grids;
    for (const Patches::Grid& g : patches.grids) {
        grids.push_back(g.cells);
    }
    for (const Fragment& f : cut_fragments(part, grids, 0)) { // 0: each place in one grid alone
        const CellGrid& grid = grids[f.grid];
        Piece piece;
        piece.emission = glm::max(
            part.emission(f.triangle, barycentric(part, f), part.uv_per_m(f.triangle) * grid.cell_m), 0.0f);
        if (piece.emission == glm::vec3(0.0f)) {
            continue;
        }
        piece.outline = outline(part, grid, f);
        for (size_t i = 0; i < piece.outline.count; ++i) {
            piece.outline.corners[i] = grid.world_from_cells.xform(piece.outline.corners[i]);
        }
        piece.centroid = f.centroid;
        piece.normal = radiosity::facing_of(part, f);
        piece.area_m2 = f.area_cells * grid.cell_m * grid.cell_m;
        pieces_.push_back(piece);
    }
}

void EmitterTree::build(uint32_t first, uint32_t count) {
    const size_t at = nodes_.size();
    nodes_.emplace_back();
    Node node;
    node.first = first;
    node.count = count;
    const auto begin = pieces_.begin() + first, end = begin + count;
    float area_m2 = 0.0f;
    glm::vec3 low = begin->centroid, high = low;
    for (auto p = begin; p != end; ++p) {
        area_m2 += p->area_m2;
        node.centroid += p->area_m2 * p->centroid;
        node.normal += p->area_m2 * p->normal;
        node.power += p->area_m2 * p->emission;
        low = glm::min(low, p->centroid);
        high = glm::max(high, p->centroid);
    }
    node.centroid /= area_m2;
    node.normal /= area_m2;
    for (auto p = begin; p != end; ++p) {
        for (size_t i = 0; i < p->outline.count; ++i) {
            node.radius_m = std::max(node.radius_m, glm::distance(p->outline.corners[i], node.centroid));
        }
    }
    if (count > 1) {
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        std::nth_element(begin, begin + count / 2, end, [axis](const Piece& a, const Piece& b) {
            return a.centroid[axis] < b.centroid[axis];
        });
        build(first, count / 2);
        node.second = uint32_t(nodes_.size());
        build(first + count / 2, count - count / 2);
    }
    nodes_[at] = node;
}

glm::vec3 EmitterTree::light_at(const RayScene& rays, const glm::vec3& position, const glm::vec3& normal,
                                float lift_m, float start) const noexcept {
    const Receiver at(rays, position, normal, lift_m, start);
    glm::vec3 sum(0.0f);
    std::array<uint32_t, 64>
        left{}; // a path down the tree holds one node a level; halves of 8000 are 13 levels
    size_t count = 0;
    for (uint32_t root : roots_) {
        left[count++] = root;
    }
    while (count > 0) {
        const uint32_t index = left[--count];
        const Node& node = nodes_[index];
        const glm::vec3 apart = node.centroid - at.position;
        const float height_m = glm::dot(apart, normal);
        if (height_m <= -node.radius_m) {
            continue; // below the horizon
        }
        const float least_m = (height_m < node.radius_m ? kAfarAtHorizon : kAfar) * node.radius_m;
        if (glm::dot(apart, apart) > least_m * least_m) {
            sum += from_afar(at, node);
        } else if (node.count == 1) {
            sum += from_nearby(at, pieces_[node.first]);
        } else {
            left[count++] = index + 1;
            left[count++] = node.second;
        }
    }
    return sum;
}

glm::vec3 EmitterTree::from_afar(const Receiver& at, const Node& node) const noexcept {
    const glm::vec3 apart = node.centroid - at.position;
    const float distance2 = glm::dot(apart, apart);
    const float cosines = glm::dot(apart, at.normal) * -glm::dot(apart, node.normal) / distance2;
    if (!(glm::dot(apart, at.normal) > 0.0f) || !(cosines > 0.0f)) {
        return glm::vec3(0.0f);
    }
    // Rays by the angle that the branch fills, to pieces chosen by their light; their order is that of the
    // tree.
    const float wanted = kRaysPerAngle * node.radius_m * node.radius_m / distance2;
    const uint32_t asked = std::clamp(uint32_t(wanted), 1u, node.count);
    const auto begin = light_before_.begin() + node.first, end = begin + node.count;
    uint32_t seen = 0;
    for (uint32_t i = 0; i < asked; ++i) {
        const float part = (float(i) + at.start) / float(asked);
        const auto after = std::upper_bound(begin + 1, end, glm::mix(*begin, *end, part));
        const Piece& piece = pieces_[size_t(after - light_before_.begin()) - 1];
        seen += at.sees(piece.centroid, piece.normal) ? 1 : 0;
    }
    return node.power * (cosines * kInversePi / distance2 * float(seen) / float(asked));
}

glm::vec3 EmitterTree::from_nearby(const Receiver& at, const Piece& piece) noexcept {
    if (glm::dot(piece.normal, at.position - piece.centroid) <= 0.0f) {
        return glm::vec3(0.0f); // its back
    }
    Polygon local = piece.outline;
    for (size_t i = 0; i < local.count; ++i) {
        local.corners[i] = (local.corners[i] - at.position) * at.world_from_local; // times the transpose
    }
    local = clip(local, 2, 0.0f, 1.0f);
    glm::vec3 centroid;
    if (local.count < 3 || local.area_and_centroid(centroid) <= 0.0f) {
        return glm::vec3(0.0f);
    }
    const auto sees = [&](const glm::vec3& target) {
        return at.sees(at.position + at.world_from_local * target, piece.normal);
    };
    size_t seen = 0;
    for (size_t i = 0; i < local.count; ++i) {
        seen += sees(glm::mix(centroid, local.corners[i], 0.8f)) ? 1 : 0;
    }
    if (seen == 0 || seen == local.count) {
        return seen == 0 ? glm::vec3(0.0f) : piece.emission * form_factor(local);
    }
    float sum = 0.0f;
    for_each_part(local, centroid, [&](const Polygon& part) {
        sum += sees((part.corners[0] + part.corners[1] + part.corners[2]) / 3.0f) ? form_factor(part) : 0.0f;
    });
    return piece.emission * sum;
}

} // namespace cl::radiosity
