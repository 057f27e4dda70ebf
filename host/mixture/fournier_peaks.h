// Fournier's normal distributions: seven Phong peaks a texel, each texel fitted by itself. [Fou92]
#pragma once
#include <functional>

#include "host/filter/mip_texels.h"
#include "host/filter/normal_map.h"

namespace glintmark {

inline constexpr int kFournierPeaks = 7;

/// kFournierPeaks float4 a texel: (weight, mean.x, mean.y, variance per axis) of a peak, NOT
/// premultiplied: peaks are not filtered but added, up to 8 texels' peaks a pixel, each weight
/// times its texel's. A peak of direction (mean.x, mean.y, sqrt(1 - |mean|^2)) and Phong exponent
/// 1 / variance; weights of a texel add up to 1, unused peaks have weight 0.
MipTexels fournierPeaks(const NormalMap& map, int threads = 0,
                        const std::function<void(double)>& progress = {});

}  // namespace glintmark
