#include "servers/radiosity/links.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

using namespace cl::radiosity;

TEST_SUITE("servers/radiosity/links") {
    TEST_CASE("patches are sorted as std::sort does, however many there are to choose from") {
        for (const size_t patch_count : {1u, 2u, 3u, 255u, 256u, 257u, 100'000u, 5'000'000u}) {
            for (const size_t length : {0u, 1u, 7u, 1000u}) {
                CAPTURE(patch_count);
                CAPTURE(length);
                std::vector<uint32_t> patches;
                for (uint64_t i = 0; i < length; ++i) {
                    patches.push_back(uint32_t(i * 2654435761u % 4294967291u % patch_count));
                }
                std::vector<uint32_t> expected = patches;
                std::sort(expected.begin(), expected.end());
                sort_patches(patches, patch_count);
                CHECK(patches == expected);
            }
        }
    }
}
