#include "core/large_pages.h"

#ifdef __linux__
#include <memory>
#include <sys/mman.h>
#endif

namespace cl {

void ask_for_large_pages(void* begin, size_t bytes) noexcept {
#ifdef __linux__
    constexpr size_t kPage = size_t{2} << 20;
    if (std::align(kPage, kPage, begin, bytes)) { // the part from the first whole page on
        static_cast<void>(madvise(begin, bytes / kPage * kPage, MADV_HUGEPAGE)); // advice: it may be refused
    }
#else
    static_cast<void>(begin);
    static_cast<void>(bytes);
#endif
}

} // namespace cl
