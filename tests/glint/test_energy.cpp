// Glints on average are the smooth lobe, and become it pixel by pixel as they get denser.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "tests/glint/pixel_harness.h"
#include "tests/glint/random_pixels.h"

namespace glintmark {
namespace {

// [issue 2] the mean over many cells equals the smooth lobe within 1 %.
constexpr double kEnergyTolerance = 0.01;

// Pixels of one view and light, all over a large surface: every one has cells of its own.
HandMadeFrame spreadPixels(std::size_t count, double size, double aspect) {
  HandMadeFrame frame;
  frame.pixels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    HandMadePixel& pixel = frame.pixels[i];
    const double x = static_cast<double>(i % 512), y = static_cast<double>(i / 512);
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
Moments ratioMoments(const HandMadeFrame& frame, KernelConfig config, int c = 0) {
  const ShadedPixels glints = shadePixels(frame, config);
  KernelConfig smooth_config = config;
  smooth_config.glint = smooth_config.groove = smooth_config.glint_colour = false;
  HandMadeFrame one = frame;
  one.pixels.resize(1);
  const double smooth = shadePixels(one, smooth_config).radiance[0][c];
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

struct EnergyCase {
  const char* name;
  GlintMethod method;
  bool groove, colour;
};

void PrintTo(const EnergyCase& c, std::ostream* out) {
  *out << c.name;
}

class Energy : public testing::TestWithParam<EnergyCase> {
 protected:
  KernelConfig config(float variation) const {
    KernelConfig c;
    c.width = 16;
    c.method = GetParam().method;
    c.groove = GetParam().groove;
    c.glint_colour = GetParam().colour;
    c.size_variation = variation > 0;
    return c;
  }
};

TEST_P(Energy, MeanIsTheSmoothLobeForEverySizeVariation) {
  for (const float variation : {0.f, 1.f, 3.f, 10.f, 100.f})
    for (const double slope : {0.0, 0.3, 0.6}) {  // p from its peak down by e^-4
      HandMadeFrame frame = spreadPixels(1 << 16, 3e-3, 3);
      // Cells of about 1e-5 uv^2: 1000 microdetails before variation.
      frame.material = simpleMaterial({0.3f, 0.3f}, {0.15f, 0.15f}, 1e8f, variation);
      frame.lights = {coneLight(lightForSlope(slope, 0.7))};
      const Moments m = ratioMoments(frame, config(variation));
      EXPECT_NEAR(m.mean, 1, kEnergyTolerance) << "variation " << variation << " slope " << slope;
      EXPECT_LT(m.standard_error, kEnergyTolerance / 4) << "too few pixels to tell";
    }
}

TEST_P(Energy, MeanIsTheSmoothLobeWhereCellsAreNearlyEmpty) {
  // 0.3 microdetails per cell and less: N is 0 or 1 most of the time.
  HandMadeFrame frame = spreadPixels(1 << 18, 3e-3, 3);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.25f, 0.25f}, 3e4f, 0);
  frame.lights = {coneLight(lightForSlope(0.1, 0.3))};
  const Moments m = ratioMoments(frame, config(0));
  EXPECT_NEAR(m.mean, 1, kEnergyTolerance);
  EXPECT_LT(m.standard_error, kEnergyTolerance / 4);
}

TEST_P(Energy, MeanIsTheSmoothLobeForSmallProbabilities) {
  // p about 1e-5, N about 1e6 per cell.
  HandMadeFrame frame = spreadPixels(1 << 16, 3e-3, 3);
  frame.material = simpleMaterial({0.3f, 0.3f}, {1e-3f, 1e-3f}, 1e11f, 1);
  frame.lights = {coneLight(lightForSlope(0.1, 0.3))};
  const Moments m = ratioMoments(frame, config(1));
  EXPECT_NEAR(m.mean, 1, kEnergyTolerance);
  EXPECT_LT(m.standard_error, kEnergyTolerance / 4);
}

TEST_P(Energy, AnisotropicStretchKeepsTheMean) {
  HandMadeFrame frame = spreadPixels(1 << 16, 1e-3, 3);
  frame.material = simpleMaterial({0.5f, 0.1f}, {0.2f, 0.05f}, 1e7f, 1);
  frame.lights = {coneLight(lightForSlope(0.1, 1.3))};
  const Moments m = ratioMoments(frame, config(1));
  // Stretched cells span many pixels, which are then no independent samples; the mean over fewer
  // cells keeps the same bound.
  EXPECT_NEAR(m.mean, 1, kEnergyTolerance);
}

TEST_P(Energy, DensityToInfinityConvergesInEveryPixel) {
  double previous = 1e9;
  for (const float density : {1e9f, 1e11f, 1e13f}) {
    HandMadeFrame frame;
    frame.pixels = randomPixels(2000, {1e-3, 1e-2, 16});
    frame.material = simpleMaterial({0.3f, 0.3f}, {0.2f, 0.2f}, density, 0);
    frame.lights = {coneLight({-0.3, 0.2, 0.9})};
    setRandomRays(frame);
    const ShadedPixels glints = shadePixels(frame, config(0));
    KernelConfig smooth_config;
    smooth_config.width = 16;
    smooth_config.glint = false;
    const ShadedPixels smooth = shadePixels(frame, smooth_config);
    double worst = 0;
    for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
      // The lobe's far tail has few microdetails at any density.
      if (smooth.radiance[i].x < 0.01) continue;
      worst = std::max(worst, std::abs(glints.radiance[i].x / smooth.radiance[i].x - 1.0));
    }
    std::printf("%s density %g: worst pixel off by %.3g\n", GetParam().name, density, worst);
    EXPECT_LT(worst, previous / 3) << density;
    previous = worst;
  }
  EXPECT_LT(previous, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Energy,
                         testing::Values(EnergyCase{"zk16", GlintMethod::kZk16, false, false},
                                         EnergyCase{"exact", GlintMethod::kExact, false, false},
                                         EnergyCase{"zk16_groove", GlintMethod::kZk16, true, false},
                                         EnergyCase{"zk16_colour", GlintMethod::kZk16, false,
                                                    true}),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(ColouredGlints, PaletteMeanAndChannelsKeepTheirEnergy) {
  HandMadeFrame frame = spreadPixels(1 << 16, 3e-3, 3);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.15f, 0.15f}, 1e7f, 0);
  frame.material.palette_count = 3;
  frame.material.palette[0] = {0.9f, 0.1f, 0.2f, 0};
  frame.material.palette[1] = {0.1f, 0.8f, 0.3f, 0};
  frame.material.palette[2] = {0.2f, 0.3f, 0.7f, 0};
  frame.lights = {coneLight(lightForSlope(0.2, 0.3))};
  KernelConfig config;
  config.width = 16;
  config.size_variation = false;
  config.glint_colour = true;
  const double mean_colour[3] = {1.2 / 3, 1.2 / 3, 1.2 / 3};
  for (int c = 0; c < 3; ++c) {
    const Moments m = ratioMoments(frame, config, c);
    EXPECT_NEAR(m.mean, mean_colour[c], kEnergyTolerance * mean_colour[c]) << "channel " << c;
  }
}

}  // namespace
}  // namespace glintmark
