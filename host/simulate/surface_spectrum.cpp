#include "host/simulate/surface_spectrum.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "host/core/error.h"
#include "host/simulate/heightfield_types.h"

namespace glintmark {
namespace {

constexpr double kShortest = 1.5, kLongest = 8;
constexpr double kSlopeVariance = 0.5;  // of alpha = 1: alpha^2 / 2

// A wave's wave vector [rad per texel].
struct Wave {
  double x = 0, y = 0;
};

// One of two waves (i, j) and (-i, -j), which are the same.
void forEachWave(const std::function<void(std::size_t index, Wave wave)>& visit) {
  const double unit = 2 * std::numbers::pi / HF_TILE;
  const int most = static_cast<int>(HF_MODES) - 1;
  for (int i = 0; i <= most; ++i)
    for (int j = -most; j <= most; ++j)
      if (i > 0 || j > 0)
        visit(static_cast<std::size_t>(i) * HF_MODE_ROWS + static_cast<std::size_t>(j + most),
              {unit * i, unit * j});
}

// Power of a wave for a correlation length and the correction of the correlation's axes.
double power(Wave wave, double length, double shear) {
  return std::exp(-0.5 * length * length *
                  (wave.x * wave.x + wave.y * wave.y + 2 * shear * wave.x * wave.y));
}

// Covariance of a triangle's slopes along x and along y; both kinds of triangles have the same.
double slopeCovariance(double length, double shear) {
  double sum = 0;
  forEachWave([&](std::size_t, Wave k) {
    sum +=
        0.5 * power(k, length, shear) * (std::cos(k.x) + std::cos(k.y) - 1 - std::cos(k.x + k.y));
  });
  return sum;
}

// The correction that makes the covariance vanish, by bisection: it falls as the shear grows.
double findShear(double length) {
  double low = -0.5, high = 0.5;
  const bool rising = slopeCovariance(length, high) > slopeCovariance(length, low);
  for (int step = 0; step < 48; ++step) {
    const double middle = (low + high) / 2;
    ((slopeCovariance(length, middle) > 0) == rising ? high : low) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

SurfaceSpectrum makeSurfaceSpectrum(double correlation_texels) {
  if (!(correlation_texels >= kShortest && correlation_texels <= kLongest))
    throw Error(fmt::format("correlation length {} is not from {} to {} texels", correlation_texels,
                            kShortest, kLongest));
  const double shear = findShear(correlation_texels);
  double variance = 0, fourth = 0, heights = 0;
  forEachWave([&](std::size_t, Wave k) {
    const double p = power(k, correlation_texels, shear);
    const double slope = p * (1 - std::cos(k.x));
    variance += slope;
    fourth += slope * slope;
    heights += 0.5 * p;
  });
  const double scale = kSlopeVariance / variance;
  SurfaceSpectrum spectrum;
  spectrum.amplitudes.assign(std::size_t{HF_MODES} * HF_MODE_ROWS, 0.0f);
  forEachWave([&](std::size_t index, Wave k) {
    spectrum.amplitudes[index] =
        static_cast<float>(std::sqrt(scale * power(k, correlation_texels, shear)));
  });
  spectrum.height_deviation = std::sqrt(scale * heights);
  // A sum of independent cosines: their fourth cumulants add up, -3/8 a^4 each.
  spectrum.kurtosis_excess = -1.5 * fourth / (variance * variance);
  return spectrum;
}

}  // namespace glintmark
