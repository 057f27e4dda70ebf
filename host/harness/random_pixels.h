// Reproducible random pixels for the kernel tests.
#pragma once
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "host/harness/pixel_harness.h"

namespace glintmark {

/// Sizes of random footprints, uv per pixel, and how elongated they get.
struct FootprintRange {
  double least_size = 1e-4, most_size = 1e-2;  // of the short side
  double most_aspect = 20;
  double most_uv = 10;
};

/// Footprints of random size, aspect, rotation and shear at random places, with random frames that
/// face +z more or less.
inline std::vector<HandMadePixel> randomPixels(int count, const FootprintRange& range,
                                               unsigned seed = 1) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random);
  };
  std::vector<HandMadePixel> pixels(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    HandMadePixel& pixel = pixels[i];
    const double size = std::exp(uniform(std::log(range.least_size), std::log(range.most_size)));
    const double aspect = std::exp(uniform(0, std::log(range.most_aspect)));
    const double angle = uniform(0, 2 * std::numbers::pi), skew = uniform(-1, 1);
    // A third of the footprints is axis-aligned: ties and exact zeros live there.
    const double turn = i % 3 == 0 ? std::floor(angle) * std::numbers::pi / 2 : angle;
    const glm::dvec2 along(std::cos(turn), std::sin(turn));
    const glm::dvec2 across(-along.y, along.x);
    pixel.footprint.duv_dx = along * (size * aspect);
    pixel.footprint.duv_dy = across * size + along * (i % 2 == 0 ? 0.0 : skew * size * aspect);
    pixel.footprint.u = fixedCoordinate(uniform(-range.most_uv, range.most_uv));
    pixel.footprint.v = fixedCoordinate(uniform(-range.most_uv, range.most_uv));
    pixel.frame = packFrame({uniform(-0.4, 0.4), uniform(-0.4, 0.4), 1},
                            {std::cos(2.1 * angle), std::sin(2.1 * angle), 0}, i % 5 == 0);
    pixel.x = static_cast<std::uint32_t>(i % 64);
    pixel.y = static_cast<std::uint32_t>(i / 64 % 64);
  }
  return pixels;
}

/// Rays of a pinhole camera that looks down at the plane z = 0, 64 x 64 pixels.
inline void setRandomRays(HandMadeFrame& frame) {
  frame.ray_origin = {-0.4, 0.3, -1};
  frame.ray_dx = {0.011, 0.001, 0.002};
  frame.ray_dy = {0.002, -0.012, 0.003};
}

}  // namespace glintmark
