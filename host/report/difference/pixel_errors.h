// Errors of single pixels as maps of one channel, and what is said of many.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// Mean over the colours of (a - r)^2 / (r^2 + kRelMseEpsilon).
Image relativeSquareErrors(const Image& image, const Image& reference);

/// What keeps pixels that are black in the reference from dominating relative errors.
inline constexpr double kRelativeEpsilon = 0.01;

/// Mean over the colours of |a - r| / (|r| + kRelativeEpsilon).
Image relativeErrors(const Image& image, const Image& reference);

/// Rec. 709 luminance of the first three channels.
Image luminances(const Image& image);

/// |a - r|.
Image absoluteErrors(const Image& image, const Image& reference);

/// 1 where a colour of either image is not 0.
std::vector<bool> notBlack(const Image& image, const Image& reference);

/// The values of a map where `where` is set (all if it is empty), NaN left out, ascending.
std::vector<float> sortedValues(const Image& map, const std::vector<bool>& where = {});

/// Of ascending values; NaN without any.
double meanOf(std::span<const float> sorted);
/// The mean without the largest `share` of them, in [0, 1).
double trimmedMean(std::span<const float> sorted, double share);
/// Linear between order statistics; `share` in [0, 1].
double quantileOf(std::span<const float> sorted, double share);

/// The pixel whose luminances are farthest apart as a ratio, of those above 0 in both.
struct PixelRatio {
  double ratio = 1;  // the larger by the smaller
  int x = 0, y = 0;
  double value = 0, reference = 0;
};
struct LuminanceRatios {
  std::optional<PixelRatio> largest{};             // nothing if no pixel is above 0 in both
  std::size_t only_image = 0, only_reference = 0;  // pixels above 0 in one alone
};
LuminanceRatios luminanceRatios(const Image& luminance, const Image& reference_luminance);

}  // namespace glintmark
