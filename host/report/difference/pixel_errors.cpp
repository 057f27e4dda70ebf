#include "host/report/difference/pixel_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

// The mean of error(a, r) over a pixel's colours, at most three.
template <typename Error>
Image colourMeans(const Image& image, const Image& reference, Error error) {
  Image map(image.width, image.height, 1);
  const int colours = std::min(3, image.channels);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      double sum = 0;
      for (int c = 0; c < colours; ++c) sum += error(image.at(x, y)[c], reference.at(x, y)[c]);
      map.at(x, y)[0] = static_cast<float>(sum / colours);
    }
  return map;
}

}  // namespace

Image relativeSquareErrors(const Image& image, const Image& reference) {
  return colourMeans(image, reference, relativeSquareError);
}

Image relativeErrors(const Image& image, const Image& reference) {
  return colourMeans(image, reference, [](double a, double r) {
    return std::abs(a - r) / (std::abs(r) + kRelativeEpsilon);
  });
}

Image luminances(const Image& image) {
  Image map(image.width, image.height, 1);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const auto c = image.at(x, y);
      map.at(x, y)[0] = luminance(c[0], c[1], c[2]);
    }
  return map;
}

Image absoluteErrors(const Image& image, const Image& reference) {
  return colourMeans(image, reference, [](double a, double r) { return std::abs(a - r); });
}

std::vector<bool> notBlack(const Image& image, const Image& reference) {
  std::vector<bool> lit(static_cast<std::size_t>(image.width) * image.height);
  const auto isLit = [](float v) { return v != 0; };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      lit[static_cast<std::size_t>(y) * image.width + x] =
          std::ranges::any_of(image.at(x, y).first(3), isLit) ||
          std::ranges::any_of(reference.at(x, y).first(3), isLit);
  return lit;
}

std::vector<float> sortedValues(const Image& map, const std::vector<bool>& where) {
  std::vector<float> values;
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    if ((where.empty() || where[i]) && !std::isnan(map.pixels[i])) values.push_back(map.pixels[i]);
  std::ranges::sort(values);
  return values;
}

double meanOf(std::span<const float> sorted) {
  return trimmedMean(sorted, 0);
}

double trimmedMean(std::span<const float> sorted, double share) {
  if (sorted.empty()) return kNoValue;
  const auto dropped = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  const auto kept = sorted.first(sorted.size() - dropped);
  double sum = 0;
  for (const float value : kept) sum += value;
  return sum / static_cast<double>(kept.size());
}

double quantileOf(std::span<const float> sorted, double share) {
  if (sorted.empty()) return kNoValue;
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(static_cast<double>(sorted[below]), static_cast<double>(sorted[above]),
                   at - static_cast<double>(below));
}

LuminanceRatios luminanceRatios(const Image& luminance, const Image& reference_luminance) {
  LuminanceRatios ratios;
  for (int y = 0; y < luminance.height; ++y)
    for (int x = 0; x < luminance.width; ++x) {
      const double a = luminance.at(x, y)[0], r = reference_luminance.at(x, y)[0];
      ratios.only_image += a > 0 && !(r > 0);
      ratios.only_reference += r > 0 && !(a > 0);
      if (!(a > 0 && r > 0)) continue;
      const double ratio = std::max(a / r, r / a);
      if (!ratios.largest || ratio > ratios.largest->ratio)
        ratios.largest = PixelRatio{.ratio = ratio, .x = x, .y = y, .value = a, .reference = r};
    }
  return ratios;
}

}  // namespace glintmark
