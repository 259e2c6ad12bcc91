#pragma once

#include "drivers/gles3/gl/capabilities.h"

#include <span>
#include <string_view>

namespace cl::gles3::gl {

/// One place where a driver differs from GLES 3.0, and what we do about it.
struct Workaround {
    std::string_view name;
    std::string_view reason;
    bool (*applies)(const Capabilities&);
    void (*apply)(); ///< once a context, with that context current
};

/// All of them; each has a test in tests/drivers/gles3/test_workarounds.cpp.
[[nodiscard]] std::span<const Workaround> workarounds() noexcept;

void apply_workarounds(const Capabilities& capabilities);

} // namespace cl::gles3::gl
