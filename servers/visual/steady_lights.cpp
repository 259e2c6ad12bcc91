#include "servers/visual/steady_lights.h"

#include <algorithm>
#include <utility>

namespace cl {

void SteadyLights::mark(radiosity::Lighting& lighting, uint64_t step, Rest rest) {
    const bool at_once = rest == Rest::AtOnce || std::exchange(is_first_, false);
    bool may_settle = true;
    const auto update = [&](auto& seen) {
        if (at_once) {
            seen.steady = true;
        } else if (!seen.steady && may_settle && step >= seen.since + kRestSteps) {
            seen.steady = true;
            may_settle = false;
        }
        return seen.steady;
    };
    std::vector<Seen<radiosity::Source>> lamps;
    for (radiosity::Source& source : lighting.sources) {
        const radiosity::Source unit = source.unit();
        const auto known =
            std::find_if(lamps_.begin(), lamps_.end(), [&](const auto& s) { return s.what == unit; });
        lamps.push_back(known != lamps_.end() ? *known : Seen<radiosity::Source>{unit, step, false});
        source.steady = update(lamps.back());
    }
    lamps_ = std::move(lamps);
    if (!sky_ || sky_->what != lighting.sky) {
        sky_ = {lighting.sky, step, false};
    }
    lighting.sky_steady = update(*sky_);
    const auto moving = std::count_if(lighting.sources.begin(), lighting.sources.end(),
                                      [](const radiosity::Source& source) { return !source.steady; });
    if (moving + (lighting.sky_steady ? 0 : 1) == 1) {
        lighting.sky_steady = true;
        for (radiosity::Source& source : lighting.sources) {
            source.steady = true;
        }
    }
}

} // namespace cl
