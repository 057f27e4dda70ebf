#include "host/report/difference/ssim.h"

#include <algorithm>
#include <limits>

#include "host/report/difference/plane_filter.h"

namespace glintmark {
namespace {

constexpr double kSsimSigma_px = 1.5;
constexpr double kSsimC1 = 0.01 * 0.01, kSsimC2 = 0.03 * 0.03;

// SSIM of the windows around (x, y). Variances are taken about the means: flat windows lose all
// digits otherwise.
double ssimAt(const Image& image, const Image& reference, const FilterTaps& window, int x, int y) {
  const auto mean = [&](auto value) {
    double sum = 0, weights = 0;
    for (int j = 0; j < static_cast<int>(window.size()); ++j)
      for (int i = 0; i < static_cast<int>(window.size()); ++i) {
        const int at_x = x + i - kSsimRadius_px, at_y = y + j - kSsimRadius_px;
        const double weight = static_cast<double>(window[static_cast<std::size_t>(i)]) *
                              window[static_cast<std::size_t>(j)];
        sum += weight * value(image.at(at_x, at_y)[0], reference.at(at_x, at_y)[0]);
        weights += weight;
      }
    return sum / weights;
  };
  const double a = mean([](double v, double) { return v; });
  const double r = mean([](double, double v) { return v; });
  const double variances =
      mean([&](double v, double w) { return (v - a) * (v - a) + (w - r) * (w - r); });
  const double covariance = mean([&](double v, double w) { return (v - a) * (w - r); });
  return (2 * a * r + kSsimC1) * (2 * covariance + kSsimC2) /
         ((a * a + r * r + kSsimC1) * (variances + kSsimC2));
}

}  // namespace

Image ssimMap(const Image& image, const Image& reference) {
  const FilterTaps window = gaussianTaps(kSsimSigma_px, kSsimRadius_px);
  Image ssim(image.width, image.height, 1);
  std::ranges::fill(ssim.pixels, std::numeric_limits<float>::quiet_NaN());
  forEachRow(ssim.height, [&](int y) {
    if (y < kSsimRadius_px || y >= ssim.height - kSsimRadius_px) return;
    for (int x = kSsimRadius_px; x < ssim.width - kSsimRadius_px; ++x)
      ssim.at(x, y)[0] = static_cast<float>(ssimAt(image, reference, window, x, y));
  });
  return ssim;
}

}  // namespace glintmark
