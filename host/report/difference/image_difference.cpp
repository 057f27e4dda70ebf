#include "host/report/difference/image_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/report/difference/flip.h"
#include "host/report/difference/ssim.h"
#include "host/report/metrics.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

void requireComparable(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw Error(fmt::format("the pictures have {}x{} and {}x{} pixels, expected two of one size",
                            image.width, image.height, reference.width, reference.height));
  if ((image.step > 0) != (reference.step > 0))
    throw Error(
        fmt::format("the {} picture holds display values, the other radiance; expected two "
                    ".png, or two .exr",
                    image.step > 0 ? "first" : "second"));
}

// Every value of the first three channels by `f`.
template <typename Function>
Image mapped(const Image& image, Function f) {
  Image out(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::ranges::transform(image.at(x, y).first(3), out.at(x, y).begin(), f);
  return out;
}

// One picture in the three lights that metrics are taken in.
struct Lights {
  Image scene;    // linear: what relative errors are taken of
  Image display;  // sRGB encoded, in [0, 1]
  Image screen;   // the linear light of a display that shows it

  Lights(const Image& image, double exposure) {
    const bool is_radiance = image.step == 0;
    scene = mapped(image, [&](float v) { return is_radiance ? v : decodeSrgb(v); });
    display = is_radiance ? toneMap(image, {.exposure = exposure}) : mapped(image, std::identity());
    screen = mapped(display, decodeSrgb);
  }
};

MetricPair pairOf(const std::string& name, const std::string& meaning, const Image& map,
                  const std::vector<bool>& lit, double trim = 0) {
  return {name, meaning, trimmedMean(sortedValues(map), trim),
          trimmedMean(sortedValues(map, lit), trim)};
}

ErrorQuantiles quantilesOf(const std::string& name, const Image& map,
                           const std::vector<bool>& lit) {
  ErrorQuantiles quantiles{.name = name};
  const std::vector<float> sorted = sortedValues(map, lit);
  for (const double share : kQuantiles) quantiles.values.push_back(quantileOf(sorted, share));
  return quantiles;
}

}  // namespace

const MetricPair& ImageDifference::metric(const std::string& name) const {
  const auto found = std::ranges::find(metrics, name, &MetricPair::name);
  if (found == metrics.end()) throw Error(fmt::format("no metric is called '{}'", name));
  return *found;
}

ImageDifference differenceOf(const Image& image, const Image& reference,
                             const DifferenceOptions& options) {
  requireComparable(image, reference);
  const Lights a(image, options.exposure), r(reference, options.exposure);
  ImageDifference d{.width = image.width, .height = image.height, .is_radiance = image.step == 0};
  const double bias = relativeBias(a.scene, r.scene);  // refuses values that are not finite
  const std::vector<bool> lit = notBlack(a.scene, r.scene);
  d.lit_share =
      static_cast<double>(std::ranges::count(lit, true)) / static_cast<double>(lit.size());
  const Image luminance_a = luminances(a.scene), luminance_r = luminances(r.scene);
  d.absolute = absoluteErrors(luminance_a, luminance_r);
  d.relative = relativeErrors(a.scene, r.scene);
  d.ssim = ssimMap(luminances(a.display), luminances(r.display));
  d.flip = flipMap(a.screen, r.screen, options.pixels_per_degree);
  d.ratios = luminanceRatios(luminance_a, luminance_r);

  const Image squares = relativeSquareErrors(a.scene, r.scene);
  // Black pixels add nothing to either mean.
  d.metrics = {{"bias", "mean / mean of the reference - 1", bias, bias},
               pairOf("mape", "mean of |a - r| / (|r| + 0.01)", d.relative, lit),
               pairOf("relmse", "mean of (a - r)^2 / (r^2 + 0.01)", squares, lit),
               pairOf("relmse_trimmed",
                      fmt::format("without the worst {:.3g} % of pixels", 100 * options.trim),
                      squares, lit, options.trim),
               pairOf("ssim", "1 for alike, of display values", d.ssim, lit),
               pairOf("flip", "0 for alike, 1 at most, as displayed", d.flip, lit)};
  d.quantiles = {quantilesOf("absolute", d.absolute, lit), quantilesOf("relative", d.relative, lit),
                 quantilesOf("flip", d.flip, lit)};
  if (d.is_radiance && options.hdr_flip) {
    const std::optional<ExposureRange> exposures = exposureRange(r.scene);
    // A reference that is black has no exposures of its own.
    const ExposureRange range = exposures.value_or(ExposureRange{.first = 0, .last = 0});
    d.hdr_flip = hdrFlipMap(a.scene, r.scene, range, options.pixels_per_degree);
    d.metrics.push_back(pairOf("hdr_flip",
                               fmt::format("largest FLIP of {} exposures, {:+.1f} to {:+.1f} stops",
                                           range.count, range.first, range.last),
                               *d.hdr_flip, lit));
    d.quantiles.push_back(quantilesOf("hdr_flip", *d.hdr_flip, lit));
  }
  return d;
}

}  // namespace glintmark
