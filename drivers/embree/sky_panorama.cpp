#include "drivers/embree/sky_panorama.h"

#include "drivers/embree/warp.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cl::embree {

namespace {

glm::vec2 panorama_uv(const glm::vec3& d) noexcept {
    const float turn = std::atan2(d.x, -d.z) / (2.0f * kPi);
    return {turn < 0.0f ? turn + 1.0f : turn, std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi};
}

glm::vec3 direction_of(const glm::vec2& uv) noexcept {
    const float turn = 2.0f * kPi * uv.x;
    const float tilt = kPi * uv.y;
    const float sine = std::sin(tilt);
    return {sine * std::sin(turn), std::cos(tilt), -sine * std::cos(turn)};
}

/// A number below 1 that may have been rounded up to it still falls in the last of `count` cells.
int cell_of(float x, int count) noexcept {
    return std::clamp(static_cast<int>(x * static_cast<float>(count)), 0, count - 1);
}

} // namespace

SkyPanorama::SkyPanorama(const SkyDesc& desc) : size_(desc.size) {
    texels_.resize(desc.radiance.size() / 3);
    for (size_t i = 0; i < texels_.size() * 3; ++i) {
        const float v = desc.radiance[i];
        texels_[i / 3][static_cast<glm::length_t>(i % 3)] = std::isfinite(v) ? v : 0.0f;
    }
    weights_.reserve(texels_.size());
    columns_.reserve(texels_.size());
    rows_.reserve(static_cast<size_t>(size_.y));
    for (int y = 0; y < size_.y; ++y) {
        float sum = 0.0f;
        for (int x = 0; x < size_.x; ++x) {
            weights_.push_back(weight_of(x, y));
            sum += weights_.back();
            columns_.push_back(sum);
        }
        total_ += sum;
        rows_.push_back(total_);
    }
}

const glm::vec3& SkyPanorama::texel(int x, int y) const noexcept {
    const int column = ((x % size_.x) + size_.x) % size_.x;
    const int row = std::clamp(y, 0, size_.y - 1);
    return texels_[static_cast<size_t>(row) * static_cast<size_t>(size_.x) + static_cast<size_t>(column)];
}

float SkyPanorama::weight_of(int x, int y) const noexcept {
    constexpr float kShares[3] = {1.0f / 8.0f, 6.0f / 8.0f,
                                  1.0f / 8.0f}; // of a row's texels in the middle one's mean
    glm::vec3 mean(0.0f);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            mean += kShares[i] * kShares[j] * texel(x + i - 1, y + j - 1);
        }
    }
    return std::max(0.0f, glm::dot(mean, glm::vec3(0.2126f, 0.7152f, 0.0722f))) *
           std::sin(kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(size_.y));
}

glm::vec3 SkyPanorama::radiance(const glm::vec3& direction) const noexcept {
    const glm::vec2 at = panorama_uv(direction) * glm::vec2(size_) - 0.5f;
    const glm::vec2 corner = glm::floor(at);
    const glm::vec2 f = at - corner;
    const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x), f.y);
}

SkyPanorama::Sample SkyPanorama::sample(const glm::vec2& u) const noexcept {
    const auto row = std::upper_bound(rows_.begin(), rows_.end(), u.y * total_);
    const int y = std::min(static_cast<int>(row - rows_.begin()), size_.y - 1);
    const double below = y > 0 ? rows_[static_cast<size_t>(y) - 1] : 0.0;
    const double row_sum = rows_[static_cast<size_t>(y)] - below;
    const auto first = columns_.begin() + static_cast<std::ptrdiff_t>(y) * size_.x;
    const float wanted = u.x * first[size_.x - 1];
    const auto column = std::upper_bound(first, first + size_.x, wanted);
    const int x = std::min(static_cast<int>(column - first), size_.x - 1);
    const float left = x > 0 ? first[x - 1] : 0.0f;
    // Where in the texel the two numbers point.
    const float in_column = first[x] > left ? (wanted - left) / (first[x] - left) : 0.5f;
    const float in_row = row_sum > 0.0 ? static_cast<float>((u.y * total_ - below) / row_sum) : 0.5f;
    const glm::vec2 uv =
        (glm::vec2(x, y) + glm::clamp(glm::vec2(in_column, in_row), 0.0f, 1.0f)) / glm::vec2(size_);
    return {direction_of(uv), pdf_of_texel(x, y, uv.y)};
}

float SkyPanorama::pdf(const glm::vec3& direction) const noexcept {
    const glm::vec2 uv = panorama_uv(direction);
    return pdf_of_texel(cell_of(uv.x, size_.x), cell_of(uv.y, size_.y), uv.y);
}

float SkyPanorama::pdf_of_texel(int x, int y, float v) const noexcept {
    const float sine = std::sin(kPi * v);
    if (is_black() || !(sine > 0.0f)) {
        return 0.0f;
    }
    const float weight =
        weights_[static_cast<size_t>(y) * static_cast<size_t>(size_.x) + static_cast<size_t>(x)];
    const double share = weight / total_ * static_cast<double>(size_.x) * static_cast<double>(size_.y);
    return static_cast<float>(share / (2.0 * kPi * kPi * sine));
}

} // namespace cl::embree
