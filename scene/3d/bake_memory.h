#pragma once

#include "servers/gi/rebake.h"

#include "core/digest.h"
#include "core/image.h"

#include <memory>
#include <vector>

namespace cl::scene {

/// A captured material, and what it was made of.
struct KeptCapture {
    gi::CaptureInput input; ///< its textures may be gone: compared, never followed
    std::weak_ptr<const Image> albedo_image, emission_image;
    std::shared_ptr<const gi::MaterialCapture> capture;
    Digest digest; ///< of the capture
};

/// What a probe keeps of its last bake so that the next one plots only what changed: 100 bytes a surface, 8
/// KiB, and 67 KiB for each texture that materials in its box show to a bake. The cells themselves are in its
/// data.
struct BakeMemory {
    gi::BakeMemory bricks;
    std::vector<KeptCapture> captures; ///< with texels; one colour is made again sooner
};

} // namespace cl::scene
