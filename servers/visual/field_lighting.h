#pragma once

#include "servers/radiosity/lighting.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/storage.h"

namespace cl {

/// What lights a scenario: its visible lights that are not kept out of GI, and its environment as rays see it
/// that leave the scene. `interior` is left empty.
[[nodiscard]] radiosity::Lighting lighting_of(const Storage& storage, InstanceStorage& instances,
                                              RID scenario);

} // namespace cl
