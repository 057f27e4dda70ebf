// Hard cases, each by name: nothing may be NaN, infinite or negative, and where the reference has
// an answer the kernel has the same.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/glint/pixel_harness.h"
#include "tests/glint/random_pixels.h"
#include "tests/tolerances.h"

namespace glintmark {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class HardCase : public testing::TestWithParam<GlintMethod> {
 protected:
  static HandMadeFrame plainFrame(std::size_t count = 1) {
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

  static KernelConfig config() {
    KernelConfig c;
    c.width = 16;
    c.method = GetParam();
    c.count_cells = true;
    return c;
  }

  // Shades, and checks that every value is one.
  static ShadedPixels shadeSanely(const HandMadeFrame& frame, KernelConfig c = config()) {
    const ShadedPixels shaded = shadePixels(frame, c);
    for (std::size_t i = 0; i < shaded.radiance.size(); ++i)
      for (int channel = 0; channel < 3; ++channel) {
        const float value = shaded.radiance[i][channel];
        EXPECT_TRUE(std::isfinite(value) && value >= 0) << "pixel " << i << ": " << value;
      }
    return shaded;
  }

  // The same, and compares with the reference: counts, and radiance but for the lobe's fit.
  static void expectReference(const HandMadeFrame& frame, double flipped_share = kFlippedPixelShare,
                              KernelConfig c = config()) {
    const ShadedPixels shaded = shadeSanely(frame, c);
    reference::GlintMethodOptions options;
    options.exact = c.method == GlintMethod::kExact;
    options.ka = c.ka;
    options.stretch = deviceStretch(frame.material);
    const auto lights = referenceLights(frame);
    int flipped = 0, different_counts = 0;
    for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
      const reference::PixelResult want =
          reference::evaluatePixel(referencePixel(frame, frame.pixels[i]),
                                   referenceGlints(frame.material, c.groove), lights, options);
      // In proportion: a pixel of thousands of cells may touch one more or less.
      const double tolerated = options.exact ? 1e-3 * want.cells : 0;
      different_counts += std::abs(static_cast<double>(shaded.cells[i]) - want.cells) > tolerated;
      if (want.tied) continue;
      const double error = std::abs(shaded.radiance[i].x - want.radiance.x);
      const double bound =
          kLobeTolerance * want.radiance.x + (kShareTolerance + 2 * want.rounding) * want.smooth.x;
      if (error > bound && ++flipped <= 3)
        std::printf("  pixel %zu: %.6g, reference %.6g (smooth %.6g)\n", i, shaded.radiance[i].x,
                    want.radiance.x, want.smooth.x);
    }
    EXPECT_LE(flipped, flipped_share * static_cast<double>(frame.pixels.size()));
    EXPECT_LE(
        different_counts,
        options.exact ? kThresholdCountShare * static_cast<double>(frame.pixels.size()) : 0.0);
  }
};

TEST_P(HardCase, SingularDerivatives) {
  HandMadeFrame frame = plainFrame(64);
  for (std::size_t i = 0; i < 64; ++i) {
    const double s = 1e-3 * static_cast<double>(1 + i % 7);
    auto& f = frame.pixels[i].footprint;
    f.duv_dx = i % 4 == 0 ? glm::dvec2(0) : glm::dvec2(s, 0.5 * s);
    f.duv_dy = i % 4 == 1   ? glm::dvec2(0)
               : i % 4 == 2 ? glm::dvec2(-s, -0.5 * s)
                            : glm::dvec2(0.25 * s, 0.125 * s);
  }
  expectReference(frame);
}

TEST_P(HardCase, ZeroDerivatives) {
  HandMadeFrame frame = plainFrame(16);
  for (auto& pixel : frame.pixels) pixel.footprint.duv_dx = pixel.footprint.duv_dy = {0, 0};
  shadeSanely(frame);
}

TEST_P(HardCase, TinyDerivatives) {
  HandMadeFrame frame = plainFrame(64);
  frame.material.density = 1e16f;
  for (std::size_t i = 0; i < 64; ++i) {
    const double s = std::ldexp(1.0, -16 - static_cast<int>(i % 8));
    frame.pixels[i].footprint.duv_dx = {s, 0};
    frame.pixels[i].footprint.duv_dy = {0.3 * s, s};
  }
  shadeSanely(frame);
  for (auto& pixel : frame.pixels) pixel.footprint.duv_dx = {1e-30, 1e-38};
  shadeSanely(frame);
}

TEST_P(HardCase, HugeDerivatives) {
  HandMadeFrame frame = plainFrame(24);
  for (std::size_t i = 0; i < 24; ++i) {
    const double s = std::ldexp(1.0, 6 + static_cast<int>(i));
    frame.pixels[i].footprint.duv_dx = {s, 0.1 * s};
    frame.pixels[i].footprint.duv_dy = {-0.1 * s, s};
  }
  frame.material.density = 1e-6f;
  shadeSanely(frame);
}

TEST_P(HardCase, DerivativesThatAreNoNumbers) {
  HandMadeFrame frame = plainFrame(16);
  const float bad[] = {kNan, kInfinity, -kInfinity, 3e38f};
  for (std::size_t i = 0; i < 16; ++i) {
    auto& f = frame.pixels[i].footprint;
    (i % 4 == 0   ? f.duv_dx.x
     : i % 4 == 1 ? f.duv_dx.y
     : i % 4 == 2 ? f.duv_dy.x
                  : f.duv_dy.y) = bad[i / 4];
  }
  shadeSanely(frame);
  for (auto& pixel : frame.pixels) pixel.footprint.duv_dx = pixel.footprint.duv_dy = {kNan, kNan};
  shadeSanely(frame);
}

TEST_P(HardCase, GrazingViews) {
  for (const double angle_deg : {1.0, 0.1}) {
    HandMadeFrame frame = plainFrame(256);
    const double elevation = angle_deg * kDegree;
    frame.ray_origin = {std::cos(elevation), 0, -std::sin(elevation)};
    frame.lights = {coneLight({1, 0.05, 0.3})};
    // The footprint of a pixel at that angle: 57 : 1 and 573 : 1.
    for (auto& pixel : frame.pixels) {
      pixel.footprint.duv_dx = {0, 1e-4};
      pixel.footprint.duv_dy = {1e-4 / std::sin(elevation), 0};
    }
    expectReference(frame, 0.05);
  }
}

TEST_P(HardCase, OnePixelCoversABillionMicrodetailCells) {
  HandMadeFrame frame = plainFrame(64);
  frame.material.density = 1e9f;
  for (auto& pixel : frame.pixels) {
    pixel.footprint.duv_dx = {1.0, 0.2};
    pixel.footprint.duv_dy = {-0.1, 1.1};
  }
  expectReference(frame);
}

TEST_P(HardCase, OneLongPixelCoversManyCells) {
  // 4000 : 1, as far as method exact follows it.
  HandMadeFrame frame = plainFrame(32);
  for (auto& pixel : frame.pixels) {
    pixel.footprint.duv_dx = {1e-4, 0};
    pixel.footprint.duv_dy = {0.4, 0.1};
  }
  expectReference(frame, 0.1);
}

TEST_P(HardCase, OneMicrodetailCoversTheScreen) {
  HandMadeFrame frame = plainFrame(256);
  frame.material.density = 1e-3f;
  shadeSanely(frame);
  expectReference(frame);
}

TEST_P(HardCase, FarTextureCoordinatesWithFineCells) {
  HandMadeFrame frame = plainFrame(256);
  frame.material.density = 0x1p40f;
  for (std::size_t i = 0; i < 256; ++i) {
    auto& f = frame.pixels[i].footprint;
    const double sign = i % 2 == 0 ? 1 : -1;
    f.u = {static_cast<std::int32_t>(sign * (1000000 - static_cast<int>(i))),
           static_cast<std::uint32_t>(i * 16777619u * 997u)};
    f.v = {static_cast<std::int32_t>(-sign * (999983 + static_cast<int>(i))),
           static_cast<std::uint32_t>(i * 2654435761u)};
    f.duv_dx = {0x1p-20, 0x1p-22};
    f.duv_dy = {-0x1p-22, 0x1.8p-20};
  }
  expectReference(frame);
}

TEST_P(HardCase, NegativeTextureCoordinates) {
  HandMadeFrame frame;
  frame.pixels = randomPixels(512, {1e-3, 1e-2, 8, 3});
  for (auto& pixel : frame.pixels) {
    pixel.footprint.u.integer -= 1237;  // around the protocol's own origin as well
    pixel.footprint.v.integer -= 2011;
  }
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.05f, 0.05f}, 1e6f);
  frame.lights = {coneLight({-0.3, 0.2, 0.9})};
  setRandomRays(frame);
  expectReference(frame, 0.01);
}

TEST_P(HardCase, TextureCoordinatesAtTheEndsOfTheirRange) {
  HandMadeFrame frame = plainFrame(4);
  frame.pixels[0].footprint.u = {std::numeric_limits<std::int32_t>::max(), 0xFFFFFFFFu};
  frame.pixels[1].footprint.u = {std::numeric_limits<std::int32_t>::min(), 0};
  frame.pixels[2].footprint.v = {std::numeric_limits<std::int32_t>::max(), 0};
  frame.pixels[3].footprint.v = {std::numeric_limits<std::int32_t>::min(), 0xFFFFFFFFu};
  shadeSanely(frame);
}

TEST_P(HardCase, SeamsAndMirroredCharts) {
  HandMadeFrame frame = plainFrame(128);
  for (std::size_t i = 0; i < 128; ++i) {
    auto& pixel = frame.pixels[i];
    // A derivative that jumps across a chart, and charts of both hands.
    if (i % 3 == 0) pixel.footprint.duv_dx = {0.97, -0.45};
    if (i % 2 == 0) {
      pixel.footprint.duv_dx.x = -pixel.footprint.duv_dx.x;
      pixel.frame = packFrame({0, 0, 1}, {-1, 0, 0}, true);
    }
  }
  expectReference(frame, 0.02);
}

TEST_P(HardCase, MicroRoughnessEqualsGlobalRoughness) {
  HandMadeFrame frame = plainFrame(256);
  frame.material.alpha_l = frame.material.alpha_g;
  expectReference(frame);
}

TEST_P(HardCase, RoughnessNearZero) {
  HandMadeFrame frame = plainFrame(256);
  frame.material = simpleMaterial({1e-4f, 1e-4f}, {1e-4f, 1e-4f}, 1e6f);
  shadeSanely(frame);
  frame.ray_origin = {-0.3 * 0.9, -0.2 * 0.9, -0.81};  // about the mirror direction
  shadeSanely(frame);
  frame.material.alpha_l = {1e-5f, 1e-5f};
  shadeSanely(frame);
}

TEST_P(HardCase, RoughnessOfOneAxisAThousandTimesTheOther) {
  HandMadeFrame frame = plainFrame(256);
  frame.material = simpleMaterial({0.5f, 5e-4f}, {5e-4f, 4e-4f}, 1e6f);
  frame.lights = {coneLight({0.3, 0.0, 0.9})};
  frame.ray_origin = {0.1, 0, -1};
  shadeSanely(frame);
  KernelConfig groove = config();
  groove.groove = true;
  shadeSanely(frame, groove);
}

TEST_P(HardCase, ProbabilityNearZeroAndOne) {
  HandMadeFrame frame = plainFrame(512);
  frame.material = simpleMaterial({0.5f, 0.5f}, {1e-4f, 1e-4f}, 1e10f);  // p = 4e-8 at its peak
  expectReference(frame);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.29999f, 0.29999f}, 1e6f);
  frame.lights = {coneLight({0.1, 0.2, 1})};
  frame.ray_origin = {0.1, 0.2, -1};  // p = 0.9999...
  expectReference(frame);
}

TEST_P(HardCase, NumberOfMicrodetailsFromNothingToABillion) {
  for (const float density : {1e-9f, 1e-3f, 1.f, 1e4f, 1e8f, 1e12f, 1e14f, 3e38f}) {
    HandMadeFrame frame = plainFrame(128);
    frame.material.density = density;
    for (const float variation : {0.f, 100.f}) {
      frame.material.size_variation = variation;
      shadeSanely(frame);
    }
  }
}

TEST_P(HardCase, HalfVectorAtTheHorizon) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({1, 0, 1e-7}), coneLight({1, 0, 1e-3}), coneLight({0, 1, 0})};
  frame.ray_origin = {1, 0, -1e-7};
  shadeSanely(frame);
}

TEST_P(HardCase, ViewAlongTheNormal) {
  HandMadeFrame frame = plainFrame(256);
  frame.ray_origin = {0, 0, -1};
  frame.lights = {coneLight({0, 0, 1}), coneLight({0, 0, 1}, 0.1)};
  KernelConfig c = config();
  c.light_cone = true;
  shadeSanely(frame, c);
  frame.lights.pop_back();
  expectReference(frame);
}

TEST_P(HardCase, ViewFromBehindTheShadingNormal) {
  HandMadeFrame frame = plainFrame(16);
  frame.ray_origin = {0.3, 0.2, 1};
  shadeSanely(frame);
}

TEST_P(HardCase, LightBelowTheHorizon) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({0.3, 0.2, -0.9}), coneLight({1, 0, -1e-6})};
  for (const glm::vec3& radiance : shadeSanely(frame).radiance) EXPECT_EQ(radiance, glm::vec3(0));
  for (const std::uint32_t cells : shadeSanely(frame).cells) EXPECT_EQ(cells, 0u);
}

TEST_P(HardCase, AlbedoZeroAndOne) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({0, 0, 1})};
  frame.material.intensity = 0;
  KernelConfig c = config();
  c.diffuse = true;
  for (const glm::vec3& radiance : shadeSanely(frame, c).radiance)
    EXPECT_EQ(radiance, glm::vec3(0));
  frame.material.albedo = {1, 1, 1, 0};
  for (const glm::vec3& radiance : shadeSanely(frame, c).radiance)
    EXPECT_NEAR(radiance.x, std::numbers::inv_pi, 1e-6);
}

TEST_P(HardCase, NoLights) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights.clear();
  for (const glm::vec3& radiance : shadeSanely(frame).radiance) EXPECT_EQ(radiance, glm::vec3(0));
}

TEST_P(HardCase, ManyLights) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights.clear();
  for (int i = 0; i < 100; ++i)
    frame.lights.push_back(
        coneLight({std::cos(i * 0.7), std::sin(i * 0.7), 0.2 + 0.03 * i}, 0, 0.01));
  expectReference(frame, 0.02);
}

TEST_P(HardCase, OnePixel) {
  for (const std::size_t count : {1u, 15u, 17u}) expectReference(plainFrame(count));
}

INSTANTIATE_TEST_SUITE_P(Methods, HardCase,
                         testing::Values(GlintMethod::kZk16, GlintMethod::kExact),
                         [](const auto& method) {
                           return method.param == GlintMethod::kZk16 ? "zk16" : "exact";
                         });

}  // namespace
}  // namespace glintmark
