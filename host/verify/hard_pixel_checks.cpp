// Footprints, materials and lights at their limits, each by name.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "host/harness/tolerances.h"
#include "host/ocl/switches.h"
#include "host/verify/check_groups.h"
#include "host/verify/hard_case.h"

namespace glintmark {
namespace {

// Diffuse radiance: some ten roundings of a number below 1.
constexpr double kRadianceTolerance = 1e-6;

}  // namespace

HandMadeFrame plainFrame(std::size_t count) {
  HandMadeFrame frame;
  frame.pixels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    frame.pixels[i].frame = flatFrame();
    frame.pixels[i].footprint.u = fixedCoordinate(0.371 + 0.0137 * static_cast<double>(i));
    frame.pixels[i].footprint.v = fixedCoordinate(0.113 - 0.0071 * static_cast<double>(i));
    // No round numbers: cells must not begin exactly where footprints end.
    frame.pixels[i].footprint.duv_dx = {3.0137e-3, 1.0071e-3};
    frame.pixels[i].footprint.duv_dy = {-1.0193e-3, 4.0239e-3};
  }
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.05f, 0.05f}, 1e6f);
  frame.lights = {coneLight({0.3, 0.2, 0.9})};
  frame.ray_origin = {0.1, 0.2, -1};
  return frame;
}

KernelConfig HardCase::config() const {
  KernelConfig c;
  c.width = context.lanes;
  c.method = method;
  c.count_cells = true;
  return c;
}

ShadedPixels HardCase::shadeSanely(const HandMadeFrame& frame, const KernelConfig& c) {
  ShadedPixels shaded = shadePixels(context.bench, frame, c);
  double bad = 0;
  for (const glm::vec3& radiance : shaded.radiance) {
    bool sane = true;
    for (int channel = 0; channel < 3; ++channel)
      sane = sane && std::isfinite(radiance[channel]) && radiance[channel] >= 0;
    bad += !sane;
  }
  finding.require(bad == 0, fmt::format("{} pixels are NaN, infinite or negative", bad));
  return shaded;
}

void HardCase::expectReference(const HandMadeFrame& frame) {
  const ShadedPixels shaded = shadeSanely(frame);
  reference::GlintMethodOptions options;
  options.method = referenceRule(method);
  const auto lights = referenceLights(frame);
  double flipped = 0, different_counts = 0;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const reference::PixelResult want = reference::evaluatePixel(
        referencePixel(frame, frame.pixels[i]), referenceGlints(frame.material), lights, options);
    // In proportion: a pixel of thousands of cells may touch one more or less.
    const double tolerated = method == GlintMethod::kExact ? 1e-3 * want.cells : 0;
    different_counts += std::abs(static_cast<double>(shaded.cells[i]) - want.cells) > tolerated;
    if (want.tied) continue;
    const double error = std::abs(shaded.radiance[i].x - want.radiance.x);
    const double bound =
        kLobeTolerance * want.radiance.x + (kShareTolerance + 2 * want.rounding) * want.smooth.x;
    flipped += !(error <= bound);
  }
  const auto count = static_cast<double>(frame.pixels.size());
  finding.add(flipped / count);
  finding.require(
      different_counts <= (method == GlintMethod::kExact ? kThresholdCountShare * count : 0),
      fmt::format("{} pixels visit other cells", different_counts));
}

void HardCase::expectRadiance(const ShadedPixels& shaded, double wanted) {
  double different = 0;
  for (const glm::vec3& radiance : shaded.radiance)
    different += !(std::abs(radiance.x - wanted) <= kRadianceTolerance * wanted);
  finding.require(different == 0, fmt::format("{} pixels are not {}", different, wanted));
}

std::vector<Check> hardPixelChecks() {
  std::vector<Check> checks;
  const auto add = [&](GlintMethod method, const NamedHardCase& c) {
    checks.push_back(
        {fmt::format("hard_{}/{}", choiceName(method), c.name),
         c.flipped_share > 0 ? "share of pixels with other draws" : "finite, not negative",
         [method, &c](const CheckContext& context) {
           HardCase hard{context, method, Finding(c.flipped_share)};
           c.run(hard);
           return hard.finding;
         }});
  };
  for (const GlintMethod method :
       {GlintMethod::kZk16, GlintMethod::kExact, GlintMethod::kDistributed}) {
    for (const NamedHardCase& c : hardFootprints()) add(method, c);
    for (const NamedHardCase& c : hardSurfaces()) add(method, c);
  }
  return checks;
}

}  // namespace glintmark
