// A normal map as it is seen close up: interpolated between its texels.
#pragma once
#include "host/filter/normal_map.h"

namespace glintmark {

/// The map at `factor` (>= 1) times the resolution: every texel's normal is what bilinear
/// interpolation, repeated at the borders and made unit, gives at its centre. Normals that cancel
/// are replaced by (0, 0, 1).
NormalMap interpolatedNormals(const NormalMap& map, int factor);

/// `count` rows of that from row `first` on; the same numbers.
NormalMap interpolatedRows(const NormalMap& map, int factor, int first, int count);

/// Samples of the interpolated map per side of a texel that stand for the surface in filters.
inline constexpr int kSurfaceSamples = 2;

/// Whether so many samples of the map are no more than a map may have texels; a larger one is
/// filtered as its texels.
bool canInterpolate(const NormalMap& map);
bool canInterpolate(int width_px, int height_px);

}  // namespace glintmark
