#include "servers/cones/gather.h"

#include "servers/cones/kernel.h"

#include "core/assert.h"
#include "core/threads.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cl::cones {

namespace {

constexpr float kPi = 3.14159265359f;
/// Edge of the squares that workers take [pixels]; lanes are blocks of 4 x 2 in it.
constexpr int kTile = 16;

/// A set's probes as the kernel takes them, with what they point at.
struct PreparedSet {
    std::array<Probe, 2> probes;
    std::array<std::vector<Step>, 2> steps;
};

/// Where a cone takes samples of a volume (spec gi-shading section 4.1).
std::vector<Step> steps_of(const Volume& volume, float tan_half, float first, float reach) {
    std::vector<Step> steps;
    const float last_lod = float(volume.level_count() - 1);
    float distance = first;
    while (distance < reach) {
        const float diameter = std::max(1.0f, 2.0f * tan_half * distance);
        const float lod = std::min(std::log2(diameter), last_lod);
        const int low = int(lod);
        const auto share = int32_t((lod - float(low)) * 256.0f);
        steps.push_back({distance, &volume.level(low), &volume.level(share > 0 ? low + 1 : low), share});
        distance += 0.5f * diameter;
    }
    return steps;
}

Probe prepare(const ConeSettings& settings, const ConeProbe& p, std::vector<Step>& steps) {
    Probe out;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            out.cells_from_view[column][row] = p.cells_from_view[column][row];
        }
    }
    for (int i = 0; i < 3; ++i) {
        out.bounds[i] = p.bounds[i];
        out.uv_from_cells[i] = p.uv_from_cells[i];
    }
    out.multiplier = p.multiplier;
    out.bias = p.bias;
    out.normal_bias = p.normal_bias;
    out.reach = p.reach * settings.reach;
    out.blend_ambient = p.blend_ambient;
    steps = steps_of(*p.volume, settings.tan_half_aperture, p.bias, out.reach);
    out.steps = steps.data();
    out.step_count = int(steps.size());
    out.levels = &p.volume->level(0);
    out.level_count = p.volume->level_count();
    return out;
}

std::vector<PreparedSet> prepare(const ConeSettings& settings, std::span<const ConeSet> sets) {
    std::vector<PreparedSet> out(sets.size());
    for (size_t i = 0; i < sets.size(); ++i) {
        for (size_t k = 0; k < 2; ++k) {
            if (sets[i].probes[k].volume) {
                out[i].probes[k] = prepare(settings, sets[i].probes[k], out[i].steps[k]);
            }
        }
    }
    return out;
}

Quality quality_of(const ConeSettings& settings) {
    CL_ASSERT(settings.cones.size() <= size_t(kMaxCones), "at most six cones");
    Quality quality;
    quality.cone_count = int(settings.cones.size());
    for (size_t i = 0; i < settings.cones.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            quality.cones[i][c] = settings.cones[i][c];
        }
    }
    return quality;
}

/// One tile after the other, by one worker.
class Tiles {
public:
    Tiles(const ConeSettings& settings, std::span<const PreparedSet> sets, const ConePicture& picture)
        : least_tan_(settings.specular_least_tan), quality_(quality_of(settings)), sets_(sets),
          picture_(picture) {}

    void run(const glm::ivec2& corner) {
        const glm::ivec2 end{std::min(corner.x + kTile, picture_.size.x),
                             std::min(corner.y + kTile, picture_.size.y)};
        for (int y = corner.y; y < end.y; y += 2) {
            for (int x = corner.x; x < end.x; x += 4) {
                for (int i = 0; i < kLanes; ++i) {
                    const glm::ivec2 at{x + i % 4, y + i / 4};
                    if (at.x < end.x && at.y < end.y) {
                        take(size_t(at.y) * size_t(picture_.size.x) + size_t(at.x));
                    }
                }
            }
        }
        flush();
    }

private:
    void gather([[maybe_unused]] const std::array<Probe, 2>& probes, [[maybe_unused]] const Points& points,
                [[maybe_unused]] Sums& sums) const {
#if defined(__x86_64__)
        gather_avx2(quality_, probes.data(), int(probes.size()), points, sums);
#else
        CL_ASSERT(false, "can_gather()");
#endif
    }

    /// Lanes are of one set; what another set interrupts goes as it is.
    void take(size_t pixel) {
        const float number = picture_.places[pixel].w;
        if (!(number >= 1.0f) || number > float(sets_.size())) {
            return;
        }
        const size_t set = size_t(number) - 1;
        if (count_ == kLanes || (count_ > 0 && set != set_)) {
            flush();
        }
        set_ = set;
        pixels_[size_t(count_++)] = pixel;
    }

    float specular_tan(float roughness) {
        if (roughness != last_roughness_) {
            last_roughness_ = roughness;
            last_tan_ = std::max(least_tan_, std::tan(roughness * roughness * 0.5f * kPi * 0.99f));
        }
        return last_tan_;
    }

    void flush() {
        if (count_ == 0) {
            return;
        }
        Points points;
        points.count = count_;
        for (int lane = 0; lane < kLanes; ++lane) {
            const size_t pixel = pixels_[size_t(std::min(lane, count_ - 1))];
            const glm::vec4& place = picture_.places[pixel];
            const glm::vec4& shape = picture_.shapes[pixel];
            for (int c = 0; c < 3; ++c) {
                points.position[c][lane] = place[c];
                points.normal[c][lane] = shape[c];
            }
            points.specular_tan[lane] = specular_tan(shape.w);
        }
        Sums sums;
        const std::array<Probe, 2>& probes = sets_[set_].probes;
        gather(probes, points, sums);
        for (int lane = 0; lane < count_; ++lane) {
            const float scale = 1.0f / std::max(sums.weight[lane], 1e-20f);
            const float* d = sums.diffuse[lane];
            const float* s = sums.specular[lane];
            picture_.diffuse[pixels_[size_t(lane)]] = glm::vec4(d[0], d[1], d[2], d[3]) * scale;
            picture_.specular[pixels_[size_t(lane)]] = glm::vec4(s[0], s[1], s[2], s[3]) * scale;
        }
        count_ = 0;
    }

    float least_tan_;
    float last_roughness_ = -1.0f, last_tan_ = 0.0f;
    Quality quality_;
    std::span<const PreparedSet> sets_;
    const ConePicture& picture_;
    std::array<size_t, kLanes> pixels_{};
    size_t set_ = 0;
    int count_ = 0;
};

} // namespace

bool can_gather() noexcept {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

void gather_cones(const ConeSettings& settings, std::span<const ConeSet> sets, const ConePicture& picture) {
    const size_t pixels = size_t(picture.size.x) * size_t(picture.size.y);
    CL_ASSERT(picture.places.size() == pixels && picture.shapes.size() == pixels &&
                  picture.diffuse.size() == pixels && picture.specular.size() == pixels,
              "spans of the picture's size");
    const std::vector<PreparedSet> prepared = prepare(settings, sets);
    const glm::ivec2 tiles = (picture.size + kTile - 1) / kTile;
    parallel_for(size_t(tiles.x) * size_t(tiles.y), 8, [&](size_t begin, size_t end) {
        Tiles worker(settings, prepared, picture);
        for (size_t i = begin; i < end; ++i) {
            worker.run(glm::ivec2(int(i) % tiles.x, int(i) / tiles.x) * kTile);
        }
    });
}

} // namespace cl::cones
