// Colours of transparent pixels at an image's opaque edges.
#include "core/image/alpha_border.h"

#include <algorithm>
#include <limits>

namespace cl {

namespace {

constexpr int kReach = 4;            ///< pixels
constexpr uint8_t kLeastOpaque = 20; ///< of 255

/// Place of the nearest opaque pixel, the first of equals in rows from the top; -1 if there is none within
/// reach.
int nearest_opaque(const Image& image, const glm::ivec2& at) {
    int best = -1;
    int best_distance = std::numeric_limits<int>::max();
    for (int y = std::max(at.y - kReach, 0); y <= std::min(at.y + kReach, image.size.y - 1); ++y) {
        for (int x = std::max(at.x - kReach, 0); x <= std::min(at.x + kReach, image.size.x - 1); ++x) {
            const int place = y * image.size.x + x;
            const int distance = (x - at.x) * (x - at.x) + (y - at.y) * (y - at.y);
            if (distance < best_distance && image.data[size_t(place) * 4 + 3] >= kLeastOpaque) {
                best = place;
                best_distance = distance;
            }
        }
    }
    return best;
}

} // namespace

Image with_fixed_alpha_border(const Image& image) {
    Image fixed = image;
    if (image.format != PixelFormat::RGBA8) {
        return fixed;
    }
    for (int y = 0; y < image.size.y; ++y) {
        for (int x = 0; x < image.size.x; ++x) {
            const size_t to = (size_t(y) * size_t(image.size.x) + size_t(x)) * 4;
            if (image.data[to + 3] >= kLeastOpaque) {
                continue;
            }
            if (const int from = nearest_opaque(image, {x, y}); from >= 0) {
                std::copy_n(image.data.begin() + std::ptrdiff_t(from) * 4, 3,
                            fixed.data.begin() + std::ptrdiff_t(to));
            }
        }
    }
    return fixed;
}

} // namespace cl
