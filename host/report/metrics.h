// Error metrics and what they are taken over, defined once for the whole project.
#pragma once
#include <cstddef>
#include <string>

#include "host/core/image.h"

namespace glintmark {

/// All metrics compare the first min(3, channels) channels of two images of equal size, ignore
/// nothing, and throw Error if sizes or channels differ or a value is not finite.

/// Relative bias of the mean: mean(image) / mean(reference) - 1, over all values. 0 for two black
/// images, infinite if only the reference is black.
double relativeBias(const Image& image, const Image& reference);

/// Relative mean squared error: mean over all values of (a - r)^2 / (r^2 + kRelMseEpsilon).
double relMse(const Image& image, const Image& reference);
inline constexpr double kRelMseEpsilon = 1e-2;  // keeps black pixels from dominating
/// One value's share of it.
inline double relativeSquareError(double a, double r) {
  return (a - r) * (a - r) / (r * r + kRelMseEpsilon);
}

/// Normalised Euclidean colour error per pixel of [TAN05] Figs. 4, 7 and 8, which give no formula.
/// We take display colours clamped to [0, 1], their Euclidean distance over that of black and white
/// (square root of the channel count), and its mean over the pixels: 0 alike, 1 black against
/// white. The images hold display values already.
double colourError(const Image& image, const Image& reference);

/// Frame-to-frame error: how far the change from one frame to the next is from the reference's
/// change, as a colour error of the changes. All images hold display values.
double changeError(const Image& before, const Image& after, const Image& reference_before,
                   const Image& reference_after);

/// Values that are negative or not finite, which no radiance may be.
std::size_t badValueCount(const Image& image);
bool isSane(const Image& image);

/// Is some colour (RGB first) not 0?
bool hasLight(const Image& radiance);

/// Why a frame's radiance (RGB first) is not to be measured: "3 radiance values are negative or not
/// finite", or it is 0 everywhere. Empty: it may be.
std::string radianceFault(const Image& radiance);

/// The RGB channels of `image` where `coverage` covers (alpha above 0), in one row; sizes equal.
Image coveredPixels(const Image& image, const Image& coverage);
/// The same of an image that says itself where it covers.
Image coveredPixels(const Image& image);

}  // namespace glintmark
