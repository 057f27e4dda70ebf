// Pictures of fitted mixtures: whether lobes of one index belong together.
#pragma once
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// Lobes of one level side by side, `label` and the lobe's number above each: a lobe's mean as a
/// colour, (n + 1) / 2, over black by its weight, the heaviest of a texel at full strength. Texels
/// are squares of `texel_px` pixels.
Image mixturePicture(const NormalMixtures& mixtures, int level, int texel_px,
                     const std::string& label);

/// The finest level whose lobes fit side by side into `width_px` pixels, one pixel a texel or more.
int pictureLevel(const NormalMixtures& mixtures, int width_px);

}  // namespace glintmark
