// Rasterized planes as an image for looking at.
#pragma once
#include "host/core/image.h"
#include "host/core/planes.h"

namespace glintmark {

/// Scatters every plane from list order to the screen, one named channel per plane ("dudx",
/// "Z", ...) plus "material"; "pixel" is left out. Integer planes are written as numbers (the
/// fractions in [0, 1)), and their sums as "uv.X" and "uv.Y"; the packed frame becomes its normal
/// and tangent, "N.X" ... and "T.X" .... Pixels that no material covers are 0, and -1 in
/// "material".
Image planesToImage(const PixelPlanes& planes);

/// Throws Error if there is no memory for all planes of so many pixels and for their image, with a
/// matte, which is copied as that joins it.
void requireMemoryForPlanes(int width_px, int height_px);

}  // namespace glintmark
