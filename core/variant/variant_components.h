#pragma once

#include "core/variant/variant.h"

#include <array>
#include <span>

namespace cl {

/// The numbers of a mathematical value in the order in which the text format writes them: Basis and Transform
/// row by row and then the origin, Transform2D column by column, Quat x y z w.
struct Components {
    std::array<float, 12> values{};
    int count = 0; ///< 0 for types that are not made of a fixed number of floats
    [[nodiscard]] std::span<const float> span() const noexcept {
        return {values.data(), static_cast<size_t>(count)};
    }
};

/// Vector2 2, Vector3 3, Rect2 Plane Quat Color 4, AABB Transform2D 6, Basis 9, Transform 12; other types 0.
[[nodiscard]] int component_count(Variant::Type type) noexcept;
[[nodiscard]] Components components_of(const Variant& value) noexcept;
/// Inverse of components_of(): `numbers` holds component_count(type) of them. Nil for a type that has none.
[[nodiscard]] Variant from_components(Variant::Type type, std::span<const float> numbers);

} // namespace cl
