#include "host/report/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/core/error.h"

namespace glintmark {
namespace {

// Calls visit(image pixel, reference pixel) for every pixel, cut to the colour channels; checks
// sizes and values. Returns the number of colour channels.
template <typename Visit>
int visitPixels(const Image& image, const Image& reference, Visit visit) {
  if (image.width != reference.width || image.height != reference.height ||
      image.channels != reference.channels || image.pixels.empty()) {
    throw Error(fmt::format("cannot compare an image of {}x{}x{} with a reference of {}x{}x{}",
                            image.width, image.height, image.channels, reference.width,
                            reference.height, reference.channels));
  }
  const int colours = std::min(3, image.channels);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto a = image.at(x, y).first(colours), r = reference.at(x, y).first(colours);
      for (int c = 0; c < colours; ++c) {
        if (!std::isfinite(a[c]) || !std::isfinite(r[c])) {
          throw Error(fmt::format("cannot compare images: pixel ({}, {}) is not finite", x, y));
        }
      }
      visit(a, r);
    }
  }
  return colours;
}

double pixelCount(const Image& image) {
  return static_cast<double>(image.width) * image.height;
}

}  // namespace

double relativeBias(const Image& image, const Image& reference) {
  double sum = 0, reference_sum = 0;
  visitPixels(image, reference, [&](auto a, auto r) {
    for (const float value : a) sum += value;
    for (const float value : r) reference_sum += value;
  });
  if (sum == reference_sum) return 0;
  if (reference_sum == 0) return std::copysign(std::numeric_limits<double>::infinity(), sum);
  return sum / reference_sum - 1;
}

double relMse(const Image& image, const Image& reference) {
  double sum = 0;
  const int colours = visitPixels(image, reference, [&](auto a, auto r) {
    for (std::size_t c = 0; c < a.size(); ++c) sum += relativeSquareError(a[c], r[c]);
  });
  return sum / (pixelCount(image) * colours);
}

double colourError(const Image& image, const Image& reference) {
  double sum = 0;
  const int colours = visitPixels(image, reference, [&](auto a, auto r) {
    double squares = 0;
    for (std::size_t c = 0; c < a.size(); ++c) {
      const double difference = std::clamp<double>(a[c], 0, 1) - std::clamp<double>(r[c], 0, 1);
      squares += difference * difference;
    }
    sum += std::sqrt(squares);
  });
  return sum / (pixelCount(image) * std::sqrt(static_cast<double>(colours)));
}

double changeError(const Image& before, const Image& after, const Image& reference_before,
                   const Image& reference_after) {
  // Changes are mapped to [0, 1] and their scale is given back.
  const auto change = [](const Image& a, const Image& b) {
    Image difference = a;
    for (std::size_t i = 0; i < difference.pixels.size(); ++i)
      difference.pixels[i] = 0.5f + 0.5f * (b.pixels[i] - a.pixels[i]);
    return difference;
  };
  return 2 * colourError(change(before, after), change(reference_before, reference_after));
}

std::size_t badValueCount(const Image& image) {
  return static_cast<std::size_t>(
      std::ranges::count_if(image.pixels, [](float v) { return !(std::isfinite(v) && v >= 0); }));
}

bool isSane(const Image& image) {
  return badValueCount(image) == 0;
}

bool hasLight(const Image& radiance) {
  const auto channels = static_cast<std::size_t>(radiance.channels);
  for (std::size_t i = 0; i < radiance.pixels.size(); ++i)
    if (i % channels < 3 && radiance.pixels[i] != 0) return true;
  return false;
}

std::string radianceFault(const Image& radiance) {
  if (const std::size_t bad = badValueCount(radiance); bad > 0)
    return fmt::format("{} radiance values are negative or not finite", bad);
  return hasLight(radiance) ? "" : "nothing that the view shows reflects light to it";
}

Image coveredPixels(const Image& image, const Image& coverage) {
  std::vector<float> values;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < coverage.pixels.size() / 4; ++i)
    for (std::size_t c = 0; coverage.pixels[4 * i + 3] > 0 && c < 3; ++c)
      values.push_back(image.pixels[channels * i + c]);
  Image row(static_cast<int>(values.size() / 3), 1, 3);
  row.pixels = std::move(values);
  return row;
}

Image coveredPixels(const Image& image) {
  return coveredPixels(image, image);
}

}  // namespace glintmark
