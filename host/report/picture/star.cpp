#include "host/report/picture/star.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/core/error.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

struct Tap {
  int dx = 0, dy = 0;
  float weight = 0;  // all taps sum to 1
};

// exp(-kFade) is left at the tip of a ray.
constexpr double kFade = 4;

// Bilinear footprints of points one pixel apart along every ray.
std::vector<Tap> starTaps(const StarOptions& options, int height_px) {
  const int steps = std::max(1, static_cast<int>(std::lround(options.length * height_px)));
  std::vector<Tap> taps;
  double sum = 0;
  for (int ray = 0; ray < options.rays; ++ray) {
    const double angle =
        (options.first_ray_deg / 180 + 2.0 * ray / options.rays) * std::numbers::pi;
    for (int step = 1; step <= steps; ++step) {
      const double x = step * std::cos(angle), y = -step * std::sin(angle);
      const double fx = x - std::floor(x), fy = y - std::floor(y);
      const double light = std::exp(-kFade * step / steps);
      for (int corner = 0; corner < 4; ++corner) {
        const int cx = corner & 1, cy = corner >> 1;
        const double weight = light * (cx ? fx : 1 - fx) * (cy ? fy : 1 - fy);
        if (weight <= 0) continue;
        taps.push_back({static_cast<int>(std::floor(x)) + cx, static_cast<int>(std::floor(y)) + cy,
                        static_cast<float>(weight)});
        sum += weight;
      }
    }
  }
  for (Tap& tap : taps) tap.weight = static_cast<float>(tap.weight / sum);
  return taps;
}

}  // namespace

void applyStar(Image& radiance, const StarOptions& options) {
  if (radiance.channels < 3) throw Error("the star effect needs an image of red, green and blue");
  const std::vector<Tap> taps = starTaps(options, radiance.height);
  const Image source = radiance;
  for (int y = 0; y < source.height; ++y) {
    for (int x = 0; x < source.width; ++x) {
      const auto in = source.at(x, y);
      const float bright = luminance(in[0], in[1], in[2]);
      if (!(bright > options.threshold) || !std::isfinite(bright)) continue;
      const auto share = static_cast<float>(options.fraction * (1 - options.threshold / bright));
      float moved = 0;
      for (const Tap& tap : taps) {
        const int tx = x + tap.dx, ty = y + tap.dy;
        if (tx < 0 || ty < 0 || tx >= source.width || ty >= source.height) continue;
        const auto out = radiance.at(tx, ty);
        for (int c = 0; c < 3; ++c) out[c] += in[c] * share * tap.weight;
        moved += tap.weight;
      }
      const auto out = radiance.at(x, y);
      for (int c = 0; c < 3; ++c) out[c] -= in[c] * share * moved;
    }
  }
}

}  // namespace glintmark
