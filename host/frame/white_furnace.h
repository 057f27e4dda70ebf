// White furnace: what the shading kernels make of a material under light of radiance 1 from
// everywhere.
#pragma once
#include <vector>

#include "host/ocl/device.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Radiance of a plane of the material towards directions of cosine `view_cosine` from its normal,
/// in (0, 1]. Its red channel; 1 where nothing is lost. The light comes as 4096 point lights: their
/// directions are spread evenly over the quantiles of the specular lobe, and over the hemisphere
/// for what the surface reflects beside it. `lanes`: 0, as the device prefers.
double whiteFurnace(Device& device, const Material& material, double view_cosine, int lanes = 0);

}  // namespace glintmark
