// Structural similarity. [WBSS04] Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From
// Error Visibility to Structural Similarity", 2004, Sect. III-B
#pragma once
#include "host/core/image.h"

namespace glintmark {

/// Half the side of SSIM's window less half a pixel: pixels nearer to an edge have no value.
inline constexpr int kSsimRadius_px = 5;

/// SSIM of every pixel, in [-1, 1], 1 for equal surroundings, one channel; NaN nearer than
/// kSsimRadius_px to an edge. Both images hold one channel of display values in [0, 1] and are of
/// one size. The window is a Gaussian of 1.5 px; K1 = 0.01, K2 = 0.03.
Image ssimMap(const Image& image, const Image& reference);

}  // namespace glintmark
