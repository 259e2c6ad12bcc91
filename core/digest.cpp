#include "core/digest.h"

#include "core/assert.h"

#include <xxhash.h>

namespace cl {

void Digester::Free::operator()(XXH3_state_s* state) const {
    XXH3_freeState(state);
}

Digester::Digester() : state_(XXH3_createState()) {
    CL_ASSERT(state_, "memory for half a kilobyte");
    XXH3_128bits_reset(state_.get());
}

void Digester::add_bytes(std::span<const std::byte> bytes) {
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

Digest Digester::digest() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    return {hash.low64, hash.high64};
}

} // namespace cl
