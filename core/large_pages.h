#pragma once

#include <cstddef>

namespace cl {

/// Asks the system for large pages below memory that is about to be filled from end to end: a page fault for
/// every 2 MiB instead of for every 4 KiB. Takes no more memory: pages that reach beyond stay small. Nothing
/// where the system has no such pages.
void ask_for_large_pages(void* begin, size_t bytes) noexcept;

} // namespace cl
