#include "core/assert.h"

#include <cstdio>
#include <cstdlib>

namespace cl {

void assert_failed(const char* file, int line, const char* condition, std::string_view what) {
    std::fprintf(stderr, "%s:%d: %.*s (%s)\n", file, line, static_cast<int>(what.size()), what.data(),
                 condition);
    std::fflush(stderr);
    std::abort();
}

} // namespace cl
