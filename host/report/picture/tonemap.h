// From linear radiance to display values.
#pragma once
#include "host/core/image.h"

namespace glintmark {

/// The curve is Reinhard's extended operator per channel, y = x (1 + x / white^2) / (1 + x): nearly
/// linear for dark values, and `white` is the exposed radiance that first reaches display white.
struct ToneMapOptions {
  double exposure = 1;  // linear scale, > 0
  double white = 8;     // exposed radiance, > 0
};

/// Display value of linear `x` in [0, 1] by the sRGB transfer function, IEC 61966-2-1.
float encodeSrgb(float x);
/// Its inverse.
float decodeSrgb(float x);

/// Exposes, compresses and sRGB-encodes the first three channels (or the only one, as grey) of a
/// linear image into an RGB image in [0, 1]. Negative values and NaN become black, infinity white.
Image toneMap(const Image& radiance, const ToneMapOptions& options);

/// Rec. 709 luminance of linear RGB.
inline float luminance(float r, float g, float b) {
  return 0.2126f * r + 0.7152f * g + 0.0722f * b;
}

}  // namespace glintmark
