// Whether there is room for a scene's normal maps, asked before they are made.
#pragma once
#include <functional>

#include "host/frame/shading_options.h"
#include "host/ocl/device.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Holds what the scene's maps and the textures of its methods will take against free memory and
/// the device's longest buffer. Of a map its size is enough. `truth`: of the ground truth, not of a
/// frame. `device` is asked where a buffer is large. Throws Error naming map and method, what they
/// need, and which size or method would do.
void requireRoomForMaps(const Scene& scene, const ShadingOptions& options, bool truth,
                        const std::function<DeviceInfo()>& device);

}  // namespace glintmark
