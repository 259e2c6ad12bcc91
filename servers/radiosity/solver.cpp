#include "servers/radiosity/solver.h"

#include "servers/radiosity/for_all.h"
#include "servers/radiosity/gather.h"

namespace cl::radiosity {

Solution solve(const Transport& t, const Lighting& lighting, const std::atomic<bool>& stop,
               LightMemory* memory) {
    LightMemory fresh;
    LightMemory& known = memory ? *memory : fresh;
    const DirectLight direct = known.direct(t, lighting.sources);
    const LightMemory::Bounced bounced = known.bounced(t, lighting, direct, stop);
    Solution s;
    if (stop) {
        return s;
    }
    s.bounces = bounced.steps;
    s.arriving.resize(t.patches.size());
    s.leaving.resize(t.patches.size());
    for_all(t.patches.size(), [&](size_t p) {
        const Rgb4 seen = at_patch(t, bounced.arriving, t.records.emitted_detail, p);
        s.arriving[p] = rgb(seen);
        s.leaving[p] = rgb4(t.patches.albedo[p]) * (direct.at(p) + seen) + rgb4(t.patches.emission[p]);
    });
    return s;
}

} // namespace cl::radiosity
