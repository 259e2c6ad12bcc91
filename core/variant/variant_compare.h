#pragma once

#include "core/variant/variant.h"

namespace cl {

/// Equality of dictionary keys: as operator==, but NaN equals NaN, so that a key is always found again.
[[nodiscard]] bool same_key(const Variant& a, const Variant& b) noexcept;
/// Equal for values that are same_key().
[[nodiscard]] size_t hash_key(const Variant& key) noexcept;
/// hash_key(Variant(text)) without making the Variant.
[[nodiscard]] size_t hash_key(std::string_view text) noexcept;

/// The order in which a writer sorts dictionary keys: by type number, then false < true, numbers by
/// size, strings byte-wise, vectors by x, y, z, arrays by length; keys of other types are all alike and stay
/// in insertion order under a stable sort. A strict weak order (NaN comes before every number).
[[nodiscard]] bool key_less(const Variant& a, const Variant& b) noexcept;

} // namespace cl
