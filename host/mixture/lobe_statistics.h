// What else may be stored of a fitted mixture's lobes than round Gaussians: the means of their
// normals on the sphere, and their whole covariance.
#pragma once
#include "host/filter/mip_texels.h"
#include "host/filter/normal_map.h"
#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// Each lobe's share of the finest normals under every texel, by one E-step of the fitted mixtures
/// over them: `lobes` float4 a texel, (a x, a y, a z, a) with (x, y, z) the mean of the lobe's unit
/// normals. Its length says how far they are spread, as of a von Mises-Fisher distribution. Linear:
/// what a filter mixes is exact. `mixtures` are those of `map` with `surface`.
MipTexels sphereLobes(const NormalMap& map, const NormalMixtures& mixtures, MixtureSurface surface);

/// float4 of a texel of covarianceLobes.
inline int covarianceVectors(int lobes) {
  return lobes + (lobes + 1) / 2;
}
/// The same as first and second moments of projected normals, all three of them: float4 of each
/// lobe, (a, a x, a y, a xx), then of each pair of lobes, (a yy, a xy) of the one and the other.
MipTexels covarianceLobes(const NormalMap& map, const NormalMixtures& mixtures,
                          MixtureSurface surface);

}  // namespace glintmark
