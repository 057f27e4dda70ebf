// Hard footprints: derivatives and texture coordinates at their limits.
#include <cmath>
#include <limits>

#include "host/core/angles.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/verify/hard_case.h"

namespace glintmark {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

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

constexpr NamedHardCase kFootprintCases[] = {
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
};

}  // namespace

std::span<const NamedHardCase> hardFootprints() {
  return kFootprintCases;
}

}  // namespace glintmark
