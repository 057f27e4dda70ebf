// Glints on average are the smooth lobe, and become it pixel by pixel as they get denser.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

// Pixels of one view and light, all over a large surface: every one has cells of its own.
HandMadeFrame spreadPixels(std::size_t count, double size, double aspect) {
  HandMadeFrame frame;
  frame.pixels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    HandMadePixel& pixel = frame.pixels[i];
    const std::size_t column = i % 512, row = i / 512;
    const auto x = static_cast<double>(column), y = static_cast<double>(row);
    // Steps of odd fractions keep the pixels at all places within their cells.
    pixel.footprint.u = fixedCoordinate(size * aspect * 2.37 * x - 3);
    pixel.footprint.v = fixedCoordinate(size * aspect * 2.61 * y + 5);
    pixel.footprint.duv_dx = {size * aspect, 0.1 * size};
    pixel.footprint.duv_dy = {-0.2 * size, size};
    pixel.frame = flatFrame();
  }
  return frame;
}

// A light whose half vector with the view along +z has slope (tan, 0) turned by `turn`.
glm::dvec3 lightForSlope(double slope, double turn) {
  const double angle = 2 * std::atan(slope);
  return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)};
}

struct Moments {
  double mean = 0, standard_error = 0;
};

// Of radiance relative to the smooth lobe, over pixels and channel `c`.
Moments ratioMoments(const CheckContext& context, const HandMadeFrame& frame, KernelConfig config,
                     int c = 0) {
  const ShadedPixels glints = shadePixels(context.bench, frame, config);
  KernelConfig smooth_config = config;
  smooth_config.glint = smooth_config.groove = smooth_config.glint_colour = false;
  HandMadeFrame one = frame;
  one.pixels.resize(1);
  const double smooth = shadePixels(context.bench, one, smooth_config).radiance[0][c];
  double sum = 0, squares = 0;
  for (const glm::vec3& radiance : glints.radiance) {
    const double ratio = radiance[c] / smooth;
    sum += ratio;
    squares += ratio * ratio;
  }
  const auto n = static_cast<double>(frame.pixels.size());
  Moments m;
  m.mean = sum / n;
  m.standard_error = std::sqrt(std::max(squares / n - m.mean * m.mean, 0.0) / n);
  return m;
}

void addMean(Finding& finding, const Moments& m, bool is_precise = true) {
  finding.add(std::abs(m.mean - 1));
  finding.require(!is_precise || m.standard_error < kEnergyTolerance / 4,
                  "too few pixels to tell the mean");
}

struct GlintKind {
  const char* name;
  GlintMethod method;
  bool groove, colour;
};
constexpr GlintKind kKinds[] = {{"zk16", GlintMethod::kZk16, false, false},
                                {"exact", GlintMethod::kExact, false, false},
                                {"distributed", GlintMethod::kDistributed, false, false},
                                {"zk16_groove", GlintMethod::kZk16, true, false},
                                {"zk16_colour", GlintMethod::kZk16, false, true}};

KernelConfig configOf(const CheckContext& context, const GlintKind& kind, float variation) {
  KernelConfig c;
  c.width = context.lanes;
  c.method = kind.method;
  c.groove = kind.groove;
  c.glint_colour = kind.colour;
  c.size_variation = variation > 0;
  return c;
}

Finding meanForEverySizeVariation(const CheckContext& context, const GlintKind& kind) {
  Finding finding(kEnergyTolerance);
  for (const float variation : {0.f, 1.f, 3.f, 10.f, 100.f})
    for (const double slope : {0.0, 0.3, 0.6}) {  // p from its peak down by e^-4
      HandMadeFrame frame = spreadPixels(1 << 16, 3e-3, 3);
      // Cells of about 1e-5 uv^2: 1000 microdetails before variation.
      frame.material = simpleMaterial({0.3f, 0.3f}, {0.15f, 0.15f}, 1e8f, variation);
      frame.lights = {coneLight(lightForSlope(slope, 0.7))};
      addMean(finding, ratioMoments(context, frame, configOf(context, kind, variation)));
    }
  return finding;
}

// 0.3 microdetails per cell and less: N is 0 or 1 most of the time.
Finding meanOfNearlyEmptyCells(const CheckContext& context, const GlintKind& kind) {
  Finding finding(kEnergyTolerance);
  HandMadeFrame frame = spreadPixels(1 << 18, 3e-3, 3);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.25f, 0.25f}, 3e4f, 0);
  frame.lights = {coneLight(lightForSlope(0.1, 0.3))};
  addMean(finding, ratioMoments(context, frame, configOf(context, kind, 0)));
  return finding;
}

// p about 1e-5, N about 1e6 per cell.
Finding meanOfSmallProbabilities(const CheckContext& context, const GlintKind& kind) {
  Finding finding(kEnergyTolerance);
  HandMadeFrame frame = spreadPixels(1 << 16, 3e-3, 3);
  frame.material = simpleMaterial({0.3f, 0.3f}, {1e-3f, 1e-3f}, 1e11f, 1);
  frame.lights = {coneLight(lightForSlope(0.1, 0.3))};
  addMean(finding, ratioMoments(context, frame, configOf(context, kind, 1)));
  return finding;
}

// Stretched cells span many pixels, which are then no independent samples; the mean over fewer
// cells keeps the same bound.
Finding meanOfStretchedCells(const CheckContext& context, const GlintKind& kind) {
  Finding finding(kEnergyTolerance);
  HandMadeFrame frame = spreadPixels(1 << 16, 1e-3, 3);
  frame.material = simpleMaterial({0.5f, 0.1f}, {0.2f, 0.05f}, 1e7f, 1);
  frame.lights = {coneLight(lightForSlope(0.1, 1.3))};
  addMean(finding, ratioMoments(context, frame, configOf(context, kind, 1)), false);
  return finding;
}

Finding densityToInfinity(const CheckContext& context, const GlintKind& kind) {
  Finding finding(kEnergyTolerance);
  double previous = std::numeric_limits<double>::max();
  for (const float density : {1e9f, 1e11f, 1e13f}) {
    HandMadeFrame frame;
    frame.pixels = randomPixels(2000, {1e-3, 1e-2, 16});
    frame.material = simpleMaterial({0.3f, 0.3f}, {0.2f, 0.2f}, density, 0);
    frame.lights = {coneLight({-0.3, 0.2, 0.9})};
    setRandomRays(frame);
    const ShadedPixels glints = shadePixels(context.bench, frame, configOf(context, kind, 0));
    KernelConfig smooth_config;
    smooth_config.width = context.lanes;
    smooth_config.glint = false;
    const ShadedPixels smooth = shadePixels(context.bench, frame, smooth_config);
    double worst = 0;
    for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
      // The lobe's far tail has few microdetails at any density.
      if (smooth.radiance[i].x < 0.01) continue;
      worst = std::max(worst, std::abs(glints.radiance[i].x / smooth.radiance[i].x - 1.0));
    }
    finding.require(worst < previous / 3, fmt::format("density {} brings {}", density, worst));
    previous = worst;
  }
  finding.add(previous);
  return finding;
}

// Each channel of a palette on average.
Finding palette(const CheckContext& context) {
  HandMadeFrame frame = spreadPixels(1 << 16, 3e-3, 3);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.15f, 0.15f}, 1e7f, 0);
  frame.material.glints.palette_count = 3;
  frame.material.glints.palette[0] = {0.9f, 0.1f, 0.2f, 0};
  frame.material.glints.palette[1] = {0.1f, 0.8f, 0.3f, 0};
  frame.material.glints.palette[2] = {0.2f, 0.3f, 0.7f, 0};
  frame.lights = {coneLight(lightForSlope(0.2, 0.3))};
  KernelConfig config;
  config.width = context.lanes;
  config.size_variation = false;
  config.glint_colour = true;
  Finding finding(kEnergyTolerance);
  for (int c = 0; c < 3; ++c)
    finding.add(std::abs(ratioMoments(context, frame, config, c).mean / 0.4 - 1));
  return finding;
}

}  // namespace

std::vector<Check> energyChecks() {
  std::vector<Check> checks;
  const auto add = [&](const std::string& name, const char* measure, auto run, auto parameter) {
    checks.push_back({name, measure, [run, parameter](const CheckContext& context) {
                        return run(context, parameter);
                      }});
  };
  for (const GlintKind& kind : kKinds) {
    const std::string group = std::string("energy/") + kind.name;
    add(group + "_varied", "mean over the smooth lobe - 1", meanForEverySizeVariation, kind);
    add(group + "_empty", "mean over the smooth lobe - 1", meanOfNearlyEmptyCells, kind);
    add(group + "_small_p", "mean over the smooth lobe - 1", meanOfSmallProbabilities, kind);
    add(group + "_stretched", "mean over the smooth lobe - 1", meanOfStretchedCells, kind);
    add(group + "_dense", "worst pixel at density 1e13", densityToInfinity, kind);
  }
  checks.push_back({"energy/palette", "mean over the palette's - 1", palette});
  return checks;
}

}  // namespace glintmark
