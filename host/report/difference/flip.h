// What an eye sees that flips between two pictures. [ANAM20] Andersson, Nilsson, Akenine-Moeller,
// Oskarsson, Astroem, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", 2020;
// [ANSA21] Andersson, Nilsson, Shirley, Akenine-Moeller, "Visualizing Errors in Rendered High
// Dynamic Range Images", 2021
#pragma once
#include <optional>

#include "host/core/image.h"

namespace glintmark {

/// Pixels per degree of a screen of 0.7 m and 3840 pixels seen from 0.7 m. [ANAM20] Sect. 4
inline constexpr double kPixelsPerDegree = 67.0206;

/// FLIP of every pixel in [0, 1], one channel. Both images hold three channels of linear light of a
/// display, in [0, 1], and are of one size. [ANAM20]
Image flipMap(const Image& image, const Image& reference, double pixels_per_degree);

/// Exposures at which radiance is looked at, as powers of two.
struct ExposureRange {
  double first = 0, last = 0;
  int count = 2;
};

/// From where the brightest pixel of the reference to where its median is at 0.85 of white, at most
/// a stop apart. [ANSA21] Sect. 3. The median is taken over pixels that are not black, which alone
/// have one where most are. Nothing if all are black.
std::optional<ExposureRange> exposureRange(const Image& reference);

/// The largest FLIP of every pixel over all exposures; both images hold three channels of radiance
/// (negative values count as 0). The exposures are taken by the filmic curve of [ANSA21].
Image hdrFlipMap(const Image& image, const Image& reference, const ExposureRange& exposures,
                 double pixels_per_degree);

}  // namespace glintmark
