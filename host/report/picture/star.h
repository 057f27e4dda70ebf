// Star-shaped glare, "a simple star-shaped posteffect to better convey the dynamic range of the
// sparkles". [ZK16] Sect. 5, Fig. 10
#pragma once
#include "host/core/image.h"

namespace glintmark {

/// The paper gives no parameters; these are ours.
struct StarOptions {
  double threshold = 1;   // luminance above which a pixel glares, > 0
  double fraction = 0.5;  // share of the excess light that goes into the rays, [0, 1]
  int rays = 6;           // at least 1
  double first_ray_deg = 90;
  double length = 0.05;  // of a ray, in image heights, at least one pixel
};

/// Moves a share of the light above the threshold of every bright pixel into rays that fade
/// exponentially. Adds exactly what it removes: what would leave the image stays in the source
/// pixel, so the sum over the image is kept. Works on the first three channels; pixels that are not
/// finite are left alone and spread nothing.
void applyStar(Image& radiance, const StarOptions& options);

}  // namespace glintmark
