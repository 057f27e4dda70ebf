// The truth of glints against what is known of sums over independent places: their mean is the
// smooth lobe's, their variance that of a Poisson number.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/harness/pixel_harness.h"
#include "host/microdetail/microdetail_truth.h"
#include "host/reference/beckmann.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr double kPixelArea_uv = 1e-6;
constexpr double kStandardErrors = 4;  // exceeded once in 16,000 cases
const glm::dvec2 kSurfaceAlpha(0.3, 0.15), kDetailAlpha(0.08, 0.05), kHalfSlope(0.12, -0.06);

struct PlacedCase {
  double details;  // in a pixel, on average
  double aspect;
  int side_px;
  PixelFilter filter;
};

// By lobes and by chance, red.
struct PlacedMoments {
  double lobes = 0, reflecting = 0, variance = 0;
};

MicrodetailSurface surfaceOf(double details) {
  MicrodetailSurface surface;
  surface.material =
      simpleMaterial({static_cast<float>(kSurfaceAlpha.x), static_cast<float>(kSurfaceAlpha.y)},
                     {static_cast<float>(kDetailAlpha.x), static_cast<float>(kDetailAlpha.y)},
                     static_cast<float>(details / kPixelArea_uv));
  return surface;
}

MicrodetailRatios placeDetails(const CheckContext& context, const PlacedCase& c,
                               const MicrodetailSurface& surface) {
  const PixelLattice lattice =
      tiledLattice({3.1, -2.7}, kPixelArea_uv, c.aspect, 0.4, c.side_px, c.side_px);
  return MicrodetailTruth(context.bench.device, context.bench.cache, context.lanes)
      .place(lattice, surface, pointSlopes(kHalfSlope, kSurfaceAlpha, kDetailAlpha), c.filter);
}

PlacedMoments placedMomentsOf(const MicrodetailRatios& ratios, int channel) {
  PlacedMoments m;
  double squares = 0;
  const auto pixels = static_cast<double>(ratios.lobes.size());
  for (std::size_t i = 0; i < ratios.lobes.size(); ++i) {
    m.lobes += ratios.lobes[i][channel] / pixels;
    m.reflecting += ratios.reflecting[i][channel] / pixels;
    squares += ratios.reflecting[i][channel] * ratios.reflecting[i][channel] / pixels;
  }
  m.variance = squares - m.reflecting * m.reflecting;
  return m;
}

// [ZK16] Eq. 7.
double detailProbability() {
  return reference::slopeDensity(kHalfSlope, kSurfaceAlpha) /
         reference::slopeDensity({0, 0}, kDetailAlpha);
}

Finding placed(const CheckContext& context, const PlacedCase& c) {
  Finding finding(kStandardErrors);
  const PlacedMoments m = placedMomentsOf(placeDetails(context, c, surfaceOf(c.details)), 0);
  const double lambda = c.details * detailProbability(), pixels = c.side_px * c.side_px;
  // A filter of mean 1 and mean square q over its pixel's area gives variance q / lambda: the box
  // 1, the tent (2/3)^2.
  const double q = c.filter == PixelFilter::kTent ? 4.0 / 9 : 1;
  const double error = std::sqrt(1 / lambda / pixels);
  finding.add(std::abs(m.reflecting - 1) / error);
  finding.add(std::abs(m.lobes - 1) / error);
  finding.add(std::abs(m.variance * lambda / q - 1) / std::sqrt((2 + 1 / lambda) / pixels));
  return finding;
}

// Sizes that vary and a palette: each channel's mean is the palette's.
Finding marked(const CheckContext& context) {
  Finding finding(kStandardErrors);
  const PlacedCase c = {300, 1, 96, PixelFilter::kBox};
  MicrodetailSurface surface = surfaceOf(c.details);
  surface.material.glints.size_variation = 0.7f;
  surface.coloured = true;
  surface.material.glints.palette_count = 3;
  surface.material.glints.palette[0] = {1, 0.2f, 0, 0};
  surface.material.glints.palette[1] = {0.4f, 0.9f, 0.1f, 0};
  surface.material.glints.palette[2] = {0.1f, 0.4f, 0.8f, 0};
  const MicrodetailRatios ratios = placeDetails(context, c, surface);
  const double pixels = c.side_px * c.side_px;
  for (int channel = 0; channel < 3; ++channel) {
    const double want = channel == 2 ? 0.3 : 0.5;
    const PlacedMoments m = placedMomentsOf(ratios, channel);
    finding.add(std::abs(m.reflecting - want) / std::sqrt(m.variance / pixels));
    finding.add(std::abs(m.lobes - want) / std::sqrt(m.variance / pixels));
  }
  return finding;
}

}  // namespace

std::vector<Check> microdetailChecks() {
  static const std::pair<const char*, PlacedCase> cases[] = {
      {"sparse", {20, 1, 128, PixelFilter::kBox}},
      {"dense", {4000, 1, 48, PixelFilter::kBox}},
      {"slim", {400, 12, 96, PixelFilter::kBox}},
      {"tent", {100, 2, 96, PixelFilter::kTent}}};
  std::vector<Check> checks;
  for (const auto& [name, c] : cases)
    checks.push_back({std::string("microdetail/") + name, "standard errors of mean and variance",
                      [&c = c](const CheckContext& context) { return placed(context, c); }});
  checks.push_back({"microdetail/sizes_and_colours", "standard errors of the mean", marked});
  return checks;
}

}  // namespace glintmark
