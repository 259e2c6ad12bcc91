#pragma once

#include <string_view>

namespace cl {

/// Prints `file:line: what` on stderr and aborts. For our own broken invariants only; the world's mistakes
/// (files, shaders, missing GL features) are returned as Error.
[[noreturn]] void assert_failed(const char* file, int line, const char* condition, std::string_view what);

} // namespace cl

#define CL_ASSERT(condition, what)                                                                           \
    ((condition) ? static_cast<void>(0) : ::cl::assert_failed(__FILE__, __LINE__, #condition, what))
