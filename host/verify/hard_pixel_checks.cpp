// Footprints, materials and lights at their limits, each by name: nothing may be NaN, infinite or
// negative, and where the reference has an answer the kernel has the same.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
// Diffuse radiance: some ten roundings of a number below 1.
constexpr double kRadianceTolerance = 1e-6;

HandMadeFrame plainFrame(std::size_t count = 1) {
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

// One case in the making. Errors are shares of pixels.
struct HardCase {
  GlintMethod method;
  int lanes;
  Finding finding;

  KernelConfig config() const {
    KernelConfig c;
    c.width = lanes;
    c.method = method;
    c.count_cells = true;
    return c;
  }

  // Shades, and counts pixels with a value that is no radiance.
  ShadedPixels shadeSanely(const HandMadeFrame& frame, const KernelConfig& c) {
    ShadedPixels shaded = shadePixels(frame, c);
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
  ShadedPixels shadeSanely(const HandMadeFrame& frame) { return shadeSanely(frame, config()); }

  // The same, and compares with the reference: counts, and radiance but for the lobe's fit.
  void expectReference(const HandMadeFrame& frame);

  void expectRadiance(const ShadedPixels& shaded, double wanted) {
    double different = 0;
    for (const glm::vec3& radiance : shaded.radiance)
      different += !(std::abs(radiance.x - wanted) <= kRadianceTolerance * wanted);
    finding.require(different == 0, fmt::format("{} pixels are not {}", different, wanted));
  }
};

void HardCase::expectReference(const HandMadeFrame& frame) {
  const ShadedPixels shaded = shadeSanely(frame);
  reference::GlintMethodOptions options;
  options.exact = method == GlintMethod::kExact;
  options.stretch = deviceStretch(frame.material);
  const auto lights = referenceLights(frame);
  double flipped = 0, different_counts = 0;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const reference::PixelResult want = reference::evaluatePixel(
        referencePixel(frame, frame.pixels[i]), referenceGlints(frame.material), lights, options);
    // In proportion: a pixel of thousands of cells may touch one more or less.
    const double tolerated = options.exact ? 1e-3 * want.cells : 0;
    different_counts += std::abs(static_cast<double>(shaded.cells[i]) - want.cells) > tolerated;
    if (want.tied) continue;
    const double error = std::abs(shaded.radiance[i].x - want.radiance.x);
    const double bound =
        kLobeTolerance * want.radiance.x + (kShareTolerance + 2 * want.rounding) * want.smooth.x;
    flipped += !(error <= bound);
  }
  const auto count = static_cast<double>(frame.pixels.size());
  finding.add(flipped / count);
  finding.require(different_counts <= (options.exact ? kThresholdCountShare * count : 0),
                  fmt::format("{} pixels visit other cells", different_counts));
}

void singularDerivatives(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  for (std::size_t i = 0; i < 64; ++i) {
    const double s = 1e-3 * static_cast<double>(1 + i % 7);
    auto& f = frame.pixels[i].footprint;
    f.duv_dx = i % 4 == 0 ? glm::dvec2(0) : glm::dvec2(s, 0.5 * s);
    f.duv_dy = i % 4 == 1   ? glm::dvec2(0)
               : i % 4 == 2 ? glm::dvec2(-s, -0.5 * s)
                            : glm::dvec2(0.25 * s, 0.125 * s);
  }
  hard.expectReference(frame);
}

void zeroDerivatives(HardCase& hard) {
  HandMadeFrame frame = plainFrame(16);
  for (auto& pixel : frame.pixels) pixel.footprint.duv_dx = pixel.footprint.duv_dy = {0, 0};
  hard.shadeSanely(frame);
}

void tinyDerivatives(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.material.glints.density = 1e16f;
  for (std::size_t i = 0; i < 64; ++i) {
    const double s = std::ldexp(1.0, -16 - static_cast<int>(i % 8));
    frame.pixels[i].footprint.duv_dx = {s, 0};
    frame.pixels[i].footprint.duv_dy = {0.3 * s, s};
  }
  hard.shadeSanely(frame);
  for (auto& pixel : frame.pixels) pixel.footprint.duv_dx = {1e-30, 1e-38};
  hard.shadeSanely(frame);
}

void hugeDerivatives(HardCase& hard) {
  HandMadeFrame frame = plainFrame(24);
  for (std::size_t i = 0; i < 24; ++i) {
    const double s = std::ldexp(1.0, 6 + static_cast<int>(i));
    frame.pixels[i].footprint.duv_dx = {s, 0.1 * s};
    frame.pixels[i].footprint.duv_dy = {-0.1 * s, s};
  }
  frame.material.glints.density = 1e-6f;
  hard.shadeSanely(frame);
}

void derivativesThatAreNoNumbers(HardCase& hard) {
  HandMadeFrame frame = plainFrame(16);
  const float bad[] = {kNan, kInfinity, -kInfinity, 3e38f};
  for (std::size_t i = 0; i < 16; ++i) {
    auto& f = frame.pixels[i].footprint;
    (i % 4 == 0   ? f.duv_dx.x
     : i % 4 == 1 ? f.duv_dx.y
     : i % 4 == 2 ? f.duv_dy.x
                  : f.duv_dy.y) = bad[i / 4];
  }
  hard.shadeSanely(frame);
  for (auto& pixel : frame.pixels) pixel.footprint.duv_dx = pixel.footprint.duv_dy = {kNan, kNan};
  hard.shadeSanely(frame);
}

void grazingViews(HardCase& hard) {
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
    hard.expectReference(frame);
  }
}

void onePixelCoversABillionMicrodetailCells(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.material.glints.density = 1e9f;
  for (auto& pixel : frame.pixels) {
    pixel.footprint.duv_dx = {1.0, 0.2};
    pixel.footprint.duv_dy = {-0.1, 1.1};
  }
  hard.expectReference(frame);
}

void oneLongPixelCoversManyCells(HardCase& hard) {
  // 4000 : 1, as far as method exact follows it.
  HandMadeFrame frame = plainFrame(32);
  for (auto& pixel : frame.pixels) {
    pixel.footprint.duv_dx = {1e-4, 0};
    pixel.footprint.duv_dy = {0.4, 0.1};
  }
  hard.expectReference(frame);
}

void oneMicrodetailCoversTheScreen(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material.glints.density = 1e-3f;
  hard.shadeSanely(frame);
  hard.expectReference(frame);
}

void farTextureCoordinatesWithFineCells(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material.glints.density = 0x1p40f;
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
  hard.expectReference(frame);
}

void negativeTextureCoordinates(HardCase& hard) {
  HandMadeFrame frame;
  frame.pixels = randomPixels(512, {1e-3, 1e-2, 8, 3});
  for (auto& pixel : frame.pixels) {
    pixel.footprint.u.integer -= 1237;  // around the protocol's own origin as well
    pixel.footprint.v.integer -= 2011;
  }
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.05f, 0.05f}, 1e6f);
  frame.lights = {coneLight({-0.3, 0.2, 0.9})};
  setRandomRays(frame);
  hard.expectReference(frame);
}

void textureCoordinatesAtTheEndsOfTheirRange(HardCase& hard) {
  HandMadeFrame frame = plainFrame(4);
  frame.pixels[0].footprint.u = {std::numeric_limits<std::int32_t>::max(), 0xFFFFFFFFu};
  frame.pixels[1].footprint.u = {std::numeric_limits<std::int32_t>::min(), 0};
  frame.pixels[2].footprint.v = {std::numeric_limits<std::int32_t>::max(), 0};
  frame.pixels[3].footprint.v = {std::numeric_limits<std::int32_t>::min(), 0xFFFFFFFFu};
  hard.shadeSanely(frame);
}

void seamsAndMirroredCharts(HardCase& hard) {
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
  hard.expectReference(frame);
}

void microRoughnessEqualsGlobalRoughness(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material.glints.alpha_l = frame.material.surface.alpha_g;
  hard.expectReference(frame);
}

void roughnessNearZero(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material = simpleMaterial({1e-4f, 1e-4f}, {1e-4f, 1e-4f}, 1e6f);
  hard.shadeSanely(frame);
  frame.ray_origin = {-0.3 * 0.9, -0.2 * 0.9, -0.81};  // about the mirror direction
  hard.shadeSanely(frame);
  frame.material.glints.alpha_l = {1e-5f, 1e-5f};
  hard.shadeSanely(frame);
}

void roughnessOfOneAxisAThousandTimesTheOther(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material = simpleMaterial({0.5f, 5e-4f}, {5e-4f, 4e-4f}, 1e6f);
  frame.lights = {coneLight({0.3, 0.0, 0.9})};
  frame.ray_origin = {0.1, 0, -1};
  hard.shadeSanely(frame);
  KernelConfig groove = hard.config();
  groove.groove = true;
  hard.shadeSanely(frame, groove);
}

void probabilityNearZeroAndOne(HardCase& hard) {
  HandMadeFrame frame = plainFrame(512);
  frame.material = simpleMaterial({0.5f, 0.5f}, {1e-4f, 1e-4f}, 1e10f);  // p = 4e-8 at its peak
  hard.expectReference(frame);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.29999f, 0.29999f}, 1e6f);
  frame.lights = {coneLight({0.1, 0.2, 1})};
  frame.ray_origin = {0.1, 0.2, -1};  // p = 0.9999...
  hard.expectReference(frame);
}

void numberOfMicrodetailsFromNothingToABillion(HardCase& hard) {
  for (const float density : {1e-9f, 1e-3f, 1.f, 1e4f, 1e8f, 1e12f, 1e14f, 3e38f}) {
    HandMadeFrame frame = plainFrame(128);
    frame.material.glints.density = density;
    for (const float variation : {0.f, 100.f}) {
      frame.material.glints.size_variation = variation;
      hard.shadeSanely(frame);
    }
  }
}

void halfVectorAtTheHorizon(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({1, 0, 1e-7}), coneLight({1, 0, 1e-3}), coneLight({0, 1, 0})};
  frame.ray_origin = {1, 0, -1e-7};
  hard.shadeSanely(frame);
}

void viewAlongTheNormal(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.ray_origin = {0, 0, -1};
  frame.lights = {coneLight({0, 0, 1}), coneLight({0, 0, 1}, 0.1)};
  KernelConfig c = hard.config();
  c.light_cone = true;
  hard.shadeSanely(frame, c);
  frame.lights.pop_back();
  hard.expectReference(frame);
}

void viewFromBehindTheShadingNormal(HardCase& hard) {
  HandMadeFrame frame = plainFrame(16);
  frame.ray_origin = {0.3, 0.2, 1};
  hard.shadeSanely(frame);
}

void lightBelowTheHorizon(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({0.3, 0.2, -0.9}), coneLight({1, 0, -1e-6})};
  hard.expectRadiance(hard.shadeSanely(frame), 0);
  for (const std::uint32_t cells : hard.shadeSanely(frame).cells)
    hard.finding.require(cells == 0, "a light below the horizon has cells");
}

void albedoZeroAndOne(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({0, 0, 1})};
  frame.material.surface.intensity = 0;
  KernelConfig c = hard.config();
  c.diffuse = true;
  hard.expectRadiance(hard.shadeSanely(frame, c), 0);
  frame.material.surface.albedo = {1, 1, 1, 0};
  hard.expectRadiance(hard.shadeSanely(frame, c), std::numbers::inv_pi);
}

void noLights(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights.clear();
  hard.expectRadiance(hard.shadeSanely(frame), 0);
}

void manyLights(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights.clear();
  for (int i = 0; i < 100; ++i)
    frame.lights.push_back(
        coneLight({std::cos(i * 0.7), std::sin(i * 0.7), 0.2 + 0.03 * i}, 0, 0.01));
  hard.expectReference(frame);
}

void onePixel(HardCase& hard) {
  for (const std::size_t count : {1u, 15u, 17u}) hard.expectReference(plainFrame(count));
}

struct NamedCase {
  const char* name;
  void (*run)(HardCase&);
  double flipped_share;  // of pixels that may differ from the reference: many cells, many draws
};
constexpr NamedCase kCases[] = {
    {"singular_derivatives", singularDerivatives, kFlippedPixelShare},
    {"zero_derivatives", zeroDerivatives, 0},
    {"tiny_derivatives", tinyDerivatives, 0},
    {"huge_derivatives", hugeDerivatives, 0},
    {"no_numbers", derivativesThatAreNoNumbers, 0},
    {"grazing_1_and_0.1_deg", grazingViews, 0.05},
    {"billion_microdetails", onePixelCoversABillionMicrodetailCells, kFlippedPixelShare},
    {"long_pixel", oneLongPixelCoversManyCells, 0.1},
    {"one_microdetail", oneMicrodetailCoversTheScreen, kFlippedPixelShare},
    {"far_uv", farTextureCoordinatesWithFineCells, kFlippedPixelShare},
    {"negative_uv", negativeTextureCoordinates, 0.01},
    {"end_of_uv", textureCoordinatesAtTheEndsOfTheirRange, 0},
    {"seams", seamsAndMirroredCharts, 0.02},
    {"equal_roughness", microRoughnessEqualsGlobalRoughness, kFlippedPixelShare},
    {"roughness_zero", roughnessNearZero, 0},
    {"anisotropy_1000", roughnessOfOneAxisAThousandTimesTheOther, 0},
    {"probability_0_and_1", probabilityNearZeroAndOne, kFlippedPixelShare},
    {"count_0_to_1e9", numberOfMicrodetailsFromNothingToABillion, 0},
    {"half_vector_at_horizon", halfVectorAtTheHorizon, 0},
    {"view_along_normal", viewAlongTheNormal, kFlippedPixelShare},
    {"view_from_behind", viewFromBehindTheShadingNormal, 0},
    {"light_below_horizon", lightBelowTheHorizon, 0},
    {"albedo_0_and_1", albedoZeroAndOne, 0},
    {"no_lights", noLights, 0},
    {"many_lights", manyLights, 0.02},
    {"one_pixel", onePixel, kFlippedPixelShare},
};

}  // namespace

std::vector<Check> hardPixelChecks() {
  std::vector<Check> checks;
  for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact})
    for (const NamedCase& c : kCases)
      checks.push_back(
          {std::string(method == GlintMethod::kZk16 ? "hard_zk16/" : "hard_exact/") + c.name,
           c.flipped_share > 0 ? "share of pixels with other draws" : "finite, not negative",
           [method, &c](int lanes) {
             HardCase hard{method, lanes, Finding(c.flipped_share)};
             c.run(hard);
             return hard.finding;
           }});
  return checks;
}

}  // namespace glintmark
