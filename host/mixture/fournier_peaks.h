// Fournier's normal distributions: Phong peaks of each texel, fitted by itself. [Fou92]
#pragma once
#include <functional>

#include "host/filter/mip_texels.h"
#include "host/filter/normal_map.h"

namespace glintmark {

/// `peaks` (1 to kMaxLobes) float4 a texel: (weight, mean.x, mean.y, variance per axis) of a peak,
/// NOT premultiplied: peaks are not filtered but added, up to 8 texels' peaks a probe, each weight
/// times its texel's. A peak of direction (mean.x, mean.y, sqrt(1 - |mean|^2)) and Phong exponent
/// 1 / variance; weights of a texel add up to 1, unused peaks have weight 0.
MipTexels fournierPeaks(const NormalMap& map, int peaks, int threads = 0,
                        const std::function<void(double)>& progress = {});

}  // namespace glintmark
