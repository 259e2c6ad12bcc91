#include "servers/radiosity/gather.h"

#include "core/threads.h"

#include <algorithm>

namespace cl::radiosity {
namespace {

template <typename F>
void for_all(size_t count, const F& f) {
    parallel_for(count, 512, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            f(i);
        }
    });
}

bool sky_reaches(const Transport& t, const Lighting& lighting, uint32_t patch) noexcept {
    const uint8_t grid = t.patches.grid[patch];
    return grid >= lighting.interior.size() || !lighting.interior[grid];
}

constexpr size_t kSomeLinks = 256;

/// Sum over targets, some of them standing for all.
glm::vec3 sum_over(std::span<const uint32_t> targets, std::span<const glm::vec3> radiance,
                   Detail detail) noexcept {
    const size_t stride = detail == Detail::All ? 1 : (targets.size() + kSomeLinks - 1) / kSomeLinks;
    glm::vec3 sum(0.0f);
    size_t count = 0;
    for (size_t i = 0; i < targets.size(); i += std::max<size_t>(stride, 1), ++count) {
        sum += radiance[targets[i]];
    }
    return count > 0 ? sum * (float(targets.size()) / float(count)) : sum;
}

} // namespace

std::vector<glm::vec3> gather_records(const Transport& t, const Lighting& lighting,
                                      std::span<const glm::vec3> leaving, Detail detail) {
    std::vector<glm::vec3> arriving(t.records.patch.size());
    for_all(arriving.size(), [&](size_t r) {
        const Links::Point& point = t.records.links.points[r];
        glm::vec3 sum = sum_over(t.records.links.patches_of(point), leaving, detail);
        if (sky_reaches(t, lighting, t.records.patch[r])) {
            sum += sum_over(t.records.links.skies_of(point), lighting.sky, detail);
        }
        arriving[r] = t.records.emitted[r] + (point.ray_count > 0 ? sum / float(point.ray_count) : sum);
    });
    return arriving;
}

void step_bounce(const Transport& t, std::span<const glm::vec3> first, std::span<const gi::float4> now,
                 std::span<gi::float4> next) {
    for_all(next.size(), [&](size_t r) {
        gi::float4 sum{first[r].x, first[r].y, first[r].z, 0.0f};
        for (uint32_t e = t.exchange_first[r]; e < t.exchange_first[r + 1]; ++e) {
            const Transport::Exchange& x = t.exchanges[e];
            sum += gi::float4{x.albedo.x, x.albedo.y, x.albedo.z, 0.0f} * now[x.record];
        }
        next[r] = sum;
    });
}

std::vector<glm::vec3> at_patches(const Transport& t, std::span<const glm::vec3> at_records) {
    std::vector<glm::vec3> out(t.patches.size());
    const std::vector<glm::vec3>& detail = t.records.emitted_detail;
    for_all(out.size(), [&](size_t p) {
        glm::vec3 sum = detail.empty() ? glm::vec3(0.0f) : detail[p];
        for (const Records::Share& s : t.records.of_patch(uint32_t(p))) {
            sum += s.weight * at_records[s.record];
        }
        out[p] = sum;
    });
    return out;
}

} // namespace cl::radiosity
